#include <numbers>

#include "mc/scene/drivetrain.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

using std::numbers::pi;

// The monitored gear is the one with the fault, else the pinion.
FixedShaftDrivetrain::FixedShaftDrivetrain(const Study& study)
    : pinion_teeth_(teeth_of(study, Member::pinion).value()),
      gear_teeth_(teeth_of(study, Member::gear).value()),
      pinion_radius_m_(gear_of(study, Member::pinion).base_radius()),
      gear_radius_m_(gear_of(study, Member::gear).base_radius()),
      gear_monitored_(study.fault.member == Member::gear) {}

double FixedShaftDrivetrain::mesh_frequency_rad_s(double speed_rad_s) const {
    return pinion_teeth_ * speed_rad_s;
}

double FixedShaftDrivetrain::rotation_m_s(const InstanceInputs& instance) const {
    return pinion_radius_m_ * instance.speed_rad_s;
}

ShaftDegree FixedShaftDrivetrain::shaft_degree(const dynamics::GearboxLayout&,
                                               Member member) const {
    return member == Member::pinion ? ShaftDegree{dynamics::u_m, pinion_radius_m_}
                                    : ShaftDegree{dynamics::u_b, gear_radius_m_};
}

void FixedShaftDrivetrain::set(const InstanceInputs& instance,
                               dynamics::GearboxInputs& inputs) const {
    auto& out = std::get<dynamics::FixedShaftInputs>(inputs);
    out.mesh_period_s = 2.0 * pi / mesh_frequency_rad_s(instance.speed_rad_s);
    out.motor_torque_N_m = instance.torque_N_m;
    out.load_torque_N_m = instance.fixed_shaft.load_torque_N_m;
}

// Unbalanced torques accelerate the whole train as one rigid body. The mesh carries the motor's
// force minus the part that accelerates the motor's side.
double FixedShaftDrivetrain::mesh_force_N(const InstanceInputs& instance) const {
    const FixedShaftInstance& f = instance.fixed_shaft;
    const double motor_N = instance.torque_N_m / pinion_radius_m_;
    const double surplus_N = motor_N - f.load_torque_N_m / gear_radius_m_;
    const double input_kg =
        (f.motor_inertia_kg_m2 + instance.bodies[Member::pinion].inertia_kg_m2) /
        (pinion_radius_m_ * pinion_radius_m_);
    const double output_kg = (f.load_inertia_kg_m2 + instance.bodies[Member::gear].inertia_kg_m2) /
                             (gear_radius_m_ * gear_radius_m_);
    const double all_kg = input_kg + output_kg;
    return all_kg > 0.0 ? motor_N - surplus_N * input_kg / all_kg : motor_N;
}

// The gear's rotation is counted opposite to the pinion's, so that the pair turns without error
// while u_1 = u_2.
std::vector<double> FixedShaftDrivetrain::te_weight(const dynamics::GearboxLayout& layout) const {
    std::vector<double> weight(static_cast<std::size_t>(dynamics::degrees_of_freedom(layout)), 0.0);
    weight[dynamics::u_1] = -1.0 / gear_radius_m_;
    weight[dynamics::u_2] = 1.0 / gear_radius_m_;
    return weight;
}

// After Z_1 Z_2 mesh periods every tooth of the monitored gear has met every tooth of its mate.
signals::SpanLayout FixedShaftDrivetrain::span() const {
    return gear_monitored_ ? signals::SpanLayout{gear_teeth_, pinion_teeth_, 1}
                           : signals::SpanLayout{pinion_teeth_, gear_teeth_, 1};
}

double nominal_mesh_frequency_Hz(const Study& study, const Drivetrain& drivetrain) {
    return drivetrain.mesh_frequency_rad_s(nominal_inputs(study).speed_rad_s) /
           (2.0 * std::numbers::pi);
}

std::unique_ptr<const Drivetrain> make_drivetrain(const Study& study) {
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return std::make_unique<const FixedShaftDrivetrain>(study);
    }
    return std::make_unique<const PlanetaryDrivetrain>(study);
}

}  // namespace gearpod::mc
