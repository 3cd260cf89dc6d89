#include "mc/scene/body.hpp"

#include <algorithm>
#include <utility>

#include "mc/scene/drivetrain.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/housing.hpp"

namespace gearpod::mc {
namespace {

dynamics::PlanetaryLayout planetary_layout(const Study& study) {
    dynamics::PlanetaryLayout result;
    const Gearbox& g = study.gearbox;
    result.planets = g.planets;
    result.pressure_angle_rad = g.pressure_angle_rad;
    result.helix_angle_rad = g.helix_angle_rad;
    result.positions_rad = g.planet_positions_rad;
    result.fixed = central_member(study.operation.fixed);
    result.motion = study.effects.torsional() ? dynamics::Motion::torsional
                                              : dynamics::Motion::translational_torsional;
    result.inertial_terms = study.effects.inertial_terms;
    result.mesh_damping = study.effects.mesh_damping;
    result.bearing_sources = !housing_bearings(study).empty();
    if (has_gears(study)) {
        result.carrier_radius_m = centre_distance_m(study);
        if (working_shifts(study).centre_distance_m) {
            result.sun_working_angle_rad = working_angle_rad(study, MeshKind::sun_planet);
            result.ring_working_angle_rad = working_angle_rad(study, MeshKind::ring_planet);
        }
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
    constexpr std::pair<dynamics::Body, Member> kBodies[] = {{dynamics::sun, Member::sun},
                                                             {dynamics::planet, Member::planet},
                                                             {dynamics::ring, Member::ring},
                                                             {dynamics::carrier, Member::carrier}};
    dynamics::PlanetaryInputs out;
    for (const auto& [body, member] : kBodies) {
        const BodyInstance& b = in.bodies[member];
        out.mass_kg[body] = b.mass_kg;
        out.inertia_over_r2_kg[body] = b.inertia_over_r2_kg;
        out.bearing_stiffness_N_m[body] = b.bearing_stiffness_N_m;
        out.bearing_damping_N_s_m[body] = b.bearing_damping_N_s_m;
    }
    std::ranges::copy(in.planets, out.planet_deviations);
    out.support_stiffness_N_m = in.support_stiffness_N_m;
    out.support_damping_N_s_m = in.support_damping_N_s_m;
    return out;
}

dynamics::FixedShaftInputs fixed_shaft_inputs(const InstanceInputs& in) {
    using namespace dynamics;
    FixedShaftInputs out;
    for (const auto& [which, member] :
         {std::pair{pinion, Member::pinion}, std::pair{gear, Member::gear}}) {
        const BodyInstance& b = in.bodies[member];
        out.mass_kg[which] = b.mass_kg;
        out.inertia_kg_m2[which] = b.inertia_kg_m2;
        out.bearing_stiffness_N_m[which] = b.bearing_stiffness_N_m;
        out.bearing_damping_N_s_m[which] = b.bearing_damping_N_s_m;
    }
    const FixedShaftInstance& f = in.fixed_shaft;
    out.coupling_stiffness_N_m_rad[pinion] = f.motor_coupling_stiffness_N_m_rad;
    out.coupling_stiffness_N_m_rad[gear] = f.load_coupling_stiffness_N_m_rad;
    out.coupling_damping_N_m_s_rad[pinion] = f.motor_coupling_damping_N_m_s_rad;
    out.coupling_damping_N_m_s_rad[gear] = f.load_coupling_damping_N_m_s_rad;
    out.motor_inertia_kg_m2 = f.motor_inertia_kg_m2;
    out.load_inertia_kg_m2 = f.load_inertia_kg_m2;
    return out;
}

// Sets the inputs that both kinds of gearbox have.
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
               ? with_mesh(study, instance, fixed_shaft_inputs(instance))
               : with_mesh(study, instance, planetary_inputs(instance));
}

}  // namespace gearpod::mc
