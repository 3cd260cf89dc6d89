#include "mc/scene/body.hpp"

#include "mc/scene/drive.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

dynamics::PlanetaryLayout planetary_layout(const Study& study) {
    dynamics::PlanetaryLayout result;
    const Gearbox& g = study.gearbox;
    result.planets = g.planets;
    result.pressure_angle_rad = g.pressure_angle_rad;
    result.helix_angle_rad = g.helix_angle_rad;
    result.positions_rad = g.planet_positions_rad;
    result.fixed = fixed_member(study.operation.fixed);
    result.motion = study.effects.torsional() ? dynamics::Motion::torsional
                                              : dynamics::Motion::translational_torsional;
    result.inertial_terms = study.effects.inertial_terms;
    result.mesh_damping = study.effects.mesh_damping;
    if (has_gears(study)) {
        result.carrier_radius_m = 0.5 * *g.module_m * (*g.sun_teeth + *g.planet_teeth);
    }
    return result;
}

dynamics::FixedShaftLayout fixed_shaft_layout(const Study& study) {
    dynamics::FixedShaftLayout result;
    result.base_radius_m[dynamics::pinion] = gear_of(study, Member::pinion).base_radius();
    result.base_radius_m[dynamics::gear] = gear_of(study, Member::gear).base_radius();
    result.mesh_damping = study.effects.mesh_damping;
    result.sensor = study.sensor.position == Member::gear ? dynamics::gear : dynamics::pinion;
    return result;
}

dynamics::PlanetaryInputs planetary_inputs(const InstanceInputs& in) {
    using namespace dynamics;
    PlanetaryInputs out;
    const auto set = [&](Body body, double mass, double inertia, double k, double c) {
        out.mass_kg[body] = mass;
        out.inertia_over_r2_kg[body] = inertia;
        out.bearing_stiffness_N_m[body] = k;
        out.bearing_damping_N_s_m[body] = c;
    };
    set(sun, in.sun_mass_kg, in.sun_inertia_over_r2_kg, in.sun_bearing_stiffness_N_m,
        in.sun_bearing_damping_N_s_m);
    set(planet, in.planet_mass_kg, in.planet_inertia_over_r2_kg, in.planet_bearing_stiffness_N_m,
        in.planet_bearing_damping_N_s_m);
    set(ring, in.ring_mass_kg, in.ring_inertia_over_r2_kg, in.ring_bearing_stiffness_N_m,
        in.ring_bearing_damping_N_s_m);
    set(carrier, in.carrier_mass_kg, in.carrier_inertia_over_r2_kg,
        in.carrier_bearing_stiffness_N_m, in.carrier_bearing_damping_N_s_m);
    out.support_stiffness_N_m = in.support_stiffness_N_m;
    out.support_damping_N_s_m = in.support_damping_N_s_m;
    return out;
}

dynamics::FixedShaftInputs fixed_shaft_inputs(const FixedShaftInstance& in) {
    using namespace dynamics;
    FixedShaftInputs out;
    out.mass_kg[pinion] = in.pinion_mass_kg;
    out.mass_kg[gear] = in.gear_mass_kg;
    out.inertia_kg_m2[pinion] = in.pinion_inertia_kg_m2;
    out.inertia_kg_m2[gear] = in.gear_inertia_kg_m2;
    out.bearing_stiffness_N_m[pinion] = in.pinion_bearing_stiffness_N_m;
    out.bearing_stiffness_N_m[gear] = in.gear_bearing_stiffness_N_m;
    out.bearing_damping_N_s_m[pinion] = in.pinion_bearing_damping_N_s_m;
    out.bearing_damping_N_s_m[gear] = in.gear_bearing_damping_N_s_m;
    out.coupling_stiffness_N_m_rad[pinion] = in.motor_coupling_stiffness_N_m_rad;
    out.coupling_stiffness_N_m_rad[gear] = in.load_coupling_stiffness_N_m_rad;
    out.coupling_damping_N_m_s_rad[pinion] = in.motor_coupling_damping_N_m_s_rad;
    out.coupling_damping_N_m_s_rad[gear] = in.load_coupling_damping_N_m_s_rad;
    out.motor_inertia_kg_m2 = in.motor_inertia_kg_m2;
    out.load_inertia_kg_m2 = in.load_inertia_kg_m2;
    return out;
}

// What the inputs of both kinds have.
template <class Inputs>
dynamics::GearboxInputs with_mesh(const Study& study, const InstanceInputs& instance,
                                  Inputs inputs) {
    inputs.mesh_damping = instance.mesh_damping;
    if (study.effects.separation == Separation::two_sided) {
        inputs.backlash_m = instance.backlash_m;
    }
    return inputs;
}

}  // namespace

dynamics::GearboxLayout gearbox_layout(const Study& study) {
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return fixed_shaft_layout(study);
    }
    return planetary_layout(study);
}

dynamics::GearboxInputs body_inputs(const Study& study, const InstanceInputs& instance) {
    return study.gearbox.kind == GearboxKind::fixed_shaft
               ? with_mesh(study, instance, fixed_shaft_inputs(instance.fixed_shaft))
               : with_mesh(study, instance, planetary_inputs(instance));
}

}  // namespace gearpod::mc
