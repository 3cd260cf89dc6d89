#include "mc/plan/drivetrain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "machine/contracts.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

using std::numbers::pi;

gears::PlanetaryTrain planetary_train(const Study& study) {
    const Gearbox& g = study.gearbox;
    return {teeth_of(study, Member::sun).value(), teeth_of(study, Member::planet).value(),
            teeth_of(study, Member::ring).value(), g.planets, g.planet_positions_rad};
}

namespace {

double phase_of_teeth(const Study& study, const gears::PlanetaryTrain& train,
                      gears::PlanetSense sense) {
    return gears::ring_to_sun_phase(train, gear_of(study, Member::planet),
                                    working_angle_rad(study, MeshKind::sun_planet),
                                    working_angle_rad(study, MeshKind::ring_planet), sense);
}

}  // namespace

PlanetaryDrivetrain::PlanetaryDrivetrain(const Study& study)
    : train_(planetary_train(study)),
      flow_{study.operation.fixed, study.operation.input},
      speed_of_(speed_member(study)),
      torque_on_(study.operation.torque_on),
      sense_(gears::planet_sense(speeds(1.0))),
      ring_to_sun_phase_(study.gearbox.ring_to_sun_phase ? *study.gearbox.ring_to_sun_phase
                                                         : phase_of_teeth(study, train_, sense_)),
      radius_m_{centre_distance_m(study), gear_of(study, Member::ring).base_radius(),
                gear_of(study, Member::sun).base_radius()} {}

double Drivetrain::mesh_period_s(double speed_rad_s) const {
    return 2.0 * pi / mesh_frequency_rad_s(speed_rad_s);
}

double PlanetaryDrivetrain::mesh_frequency_rad_s(double speed_rad_s) const {
    return gears::mesh_frequency(train_, speeds(speed_rad_s));
}

double PlanetaryDrivetrain::turns_per_mesh(Member member) const {
    const gears::Speeds turning = speeds(1.0);
    return std::abs(gears::speed_of(turning, member)) / gears::mesh_frequency(train_, turning);
}

double PlanetaryDrivetrain::input_turns_per_mesh() const {
    return turns_per_mesh(flow_.input);
}

double PlanetaryDrivetrain::shaft_turns_per_mesh(Member member) const {
    return turns_per_mesh(member);
}

double PlanetaryDrivetrain::frame_turns_per_mesh() const {
    return speeds(1.0).carrier / mesh_frequency_rad_s(1.0);
}

int PlanetaryDrivetrain::input_degree_of_freedom(const dynamics::GearboxLayout& layout) const {
    return std::get<dynamics::PlanetaryLayout>(layout).rotation_index(
        dynamics::body_index(flow_.input));
}

// Along rigid_rotation the carrier's displacement is 1, or the sun's if the carrier is fixed.
double PlanetaryDrivetrain::rotation_m_s(const InstanceInputs& instance) const {
    const gears::Speeds turning = speeds(instance.speed_rad_s);
    return flow_.fixed == Member::carrier ? radius_m_.sun * turning.sun
                                          : radius_m_.carrier * turning.carrier;
}

ShaftDegree PlanetaryDrivetrain::shaft_degree(const dynamics::GearboxLayout& layout,
                                              Member member) const {
    const auto& planetary = std::get<dynamics::PlanetaryLayout>(layout);
    const double radius_m = member == Member::carrier ? radius_m_.carrier
                            : member == Member::ring  ? radius_m_.ring
                                                      : radius_m_.sun;
    return {planetary.rotation_index(dynamics::body_index(member)), radius_m};
}

void PlanetaryDrivetrain::set(const InstanceInputs& instance,
                              dynamics::GearboxInputs& inputs) const {
    auto& out = std::get<dynamics::PlanetaryInputs>(inputs);
    const gears::Speeds turning = speeds(instance.speed_rad_s);
    out.carrier_speed_rad_s = turning.carrier;
    out.mesh_period_s = mesh_period_s(instance.speed_rad_s);
    const gears::CentralMembers torque =
        gears::balanced_torques(train_, torque_on_, instance.torque_N_m);
    out.force_N[dynamics::sun] = torque.sun / radius_m_.sun;
    out.force_N[dynamics::ring] = torque.ring / radius_m_.ring;
    out.force_N[dynamics::carrier] = torque.carrier / radius_m_.carrier;
    // The support's reaction balances the fixed member.
    out.force_N[dynamics::body_index(flow_.fixed)] = 0.0;
}

double PlanetaryDrivetrain::mesh_force_N(const InstanceInputs& instance) const {
    const gears::CentralMembers torque =
        gears::balanced_torques(train_, torque_on_, instance.torque_N_m);
    return torque.sun / radius_m_.sun / train_.planets;
}

std::string PlanetaryDrivetrain::pair_name(PairId pair) const {
    const int n = train_.planets;
    return pair < n ? fmt::format("sp{}", pair + 1) : fmt::format("rp{}", pair - n + 1);
}

std::string PlanetaryDrivetrain::pair_members(PairId pair) const {
    const int n = train_.planets;
    return fmt::format("{} and planet {}", pair < n ? "sun" : "ring", pair % n + 1);
}

double PlanetaryDrivetrain::pitch_phase(PairId pair) const {
    const int n = train_.planets;
    return pair < n
               ? gears::sun_mesh_phase(train_, planet_of(pair, n), sense_)
               : gears::ring_mesh_phase(train_, planet_of(pair, n), sense_) + ring_to_sun_phase_;
}

std::vector<double> PlanetaryDrivetrain::te_weight(const dynamics::GearboxLayout& layout) const {
    const auto& planetary = std::get<dynamics::PlanetaryLayout>(layout);
    const gears::CentralMembers rotation = gears::transmission_error_weights(train_, flow_);
    std::vector<double> weight(static_cast<std::size_t>(planetary.degrees_of_freedom()), 0.0);
    const auto set = [&](int body, double value) {
        weight[static_cast<std::size_t>(planetary.rotation_index(body))] = value;
    };
    set(dynamics::carrier, rotation.carrier / radius_m_.carrier);
    set(dynamics::ring, rotation.ring / radius_m_.ring);
    set(dynamics::sun, rotation.sun / radius_m_.sun);
    return weight;
}

// The planets' teeth are monitored: after Z_p Z_r mesh periods every planet tooth has met every
// ring tooth. With a fixed carrier the path repeats every mesh period.
signals::SpanLayout PlanetaryDrivetrain::span() const {
    return {train_.planet_teeth, train_.ring_teeth,
            gears::meshes_per_carrier_turn(train_, flow_.fixed).value_or(1)};
}

bool PlanetaryDrivetrain::carrier_turns_backwards() const {
    return speeds(1.0).carrier < 0.0;
}

namespace {

class FixedShaftDrivetrain final : public Drivetrain {
  public:
    // The monitored gear is the one with the fault, else the pinion.
    explicit FixedShaftDrivetrain(const Study& study)
        : pinion_teeth_(teeth_of(study, Member::pinion).value()),
          gear_teeth_(teeth_of(study, Member::gear).value()),
          pinion_radius_m_(gear_of(study, Member::pinion).base_radius()),
          gear_radius_m_(gear_of(study, Member::gear).base_radius()),
          gear_monitored_(study.fault.member == Member::gear) {}

    double mesh_frequency_rad_s(double speed_rad_s) const override {
        return pinion_teeth_ * speed_rad_s;
    }

    double rotation_m_s(const InstanceInputs& instance) const override {
        return pinion_radius_m_ * instance.speed_rad_s;
    }

    ShaftDegree shaft_degree(const dynamics::GearboxLayout&, Member member) const override {
        return member == Member::pinion ? ShaftDegree{dynamics::u_m, pinion_radius_m_}
                                        : ShaftDegree{dynamics::u_b, gear_radius_m_};
    }

    void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const override {
        auto& out = std::get<dynamics::FixedShaftInputs>(inputs);
        out.mesh_period_s = mesh_period_s(instance.speed_rad_s);
        out.motor_torque_N_m = instance.torque_N_m;
        out.load_torque_N_m = instance.fixed_shaft.load_torque_N_m;
    }

    // Unbalanced torques accelerate the whole train as one rigid body. The mesh carries the motor's
    // force minus the part that accelerates the motor's side.
    double mesh_force_N(const InstanceInputs& instance) const override {
        const FixedShaftInstance& f = instance.fixed_shaft;
        const double motor_N = instance.torque_N_m / pinion_radius_m_;
        const double surplus_N = motor_N - f.load_torque_N_m / gear_radius_m_;
        const double input_kg =
            (f.motor_inertia_kg_m2 + instance.bodies[Member::pinion].inertia_kg_m2) /
            (pinion_radius_m_ * pinion_radius_m_);
        const double output_kg =
            (f.load_inertia_kg_m2 + instance.bodies[Member::gear].inertia_kg_m2) /
            (gear_radius_m_ * gear_radius_m_);
        const double all_kg = input_kg + output_kg;
        return all_kg > 0.0 ? motor_N - surplus_N * input_kg / all_kg : motor_N;
    }

    // The gear's rotation is counted opposite to the pinion's, so that the pair turns without error
    // while u_1 = u_2.
    std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const override {
        std::vector<double> weight(static_cast<std::size_t>(dynamics::degrees_of_freedom(layout)),
                                   0.0);
        weight[dynamics::u_1] = -1.0 / gear_radius_m_;
        weight[dynamics::u_2] = 1.0 / gear_radius_m_;
        return weight;
    }

    // After Z_1 Z_2 mesh periods every tooth of the monitored gear has met every tooth of its mate.
    signals::SpanLayout span() const override {
        return gear_monitored_ ? signals::SpanLayout{gear_teeth_, pinion_teeth_, 1}
                               : signals::SpanLayout{pinion_teeth_, gear_teeth_, 1};
    }

    double input_turns_per_mesh() const override { return 1.0 / pinion_teeth_; }
    double frame_turns_per_mesh() const override { return 0.0; }
    double shaft_turns_per_mesh(Member member) const override {
        return 1.0 / (member == Member::pinion ? pinion_teeth_ : gear_teeth_);
    }
    int input_degree_of_freedom(const dynamics::GearboxLayout&) const override {
        return dynamics::u_m;
    }
    int pairs_per_mesh() const override { return 1; }
    std::string pair_name(PairId) const override { return "m1"; }
    std::string pair_members(PairId) const override { return "both gears"; }
    double pitch_phase(PairId) const override { return 0.0; }
    bool reversed() const override { return false; }

  private:
    int pinion_teeth_, gear_teeth_;
    double pinion_radius_m_, gear_radius_m_;  // base circle radii
    bool gear_monitored_;
};

}  // namespace

double nominal_mesh_frequency_Hz(const Study& study, const Drivetrain& drivetrain) {
    return drivetrain.mesh_frequency_rad_s(nominal_inputs(study).speed_rad_s) /
           (2.0 * std::numbers::pi);
}

std::unique_ptr<const Drivetrain> make_drivetrain(const Study& study) {
    EXPECTS(has_gears(study));
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return std::make_unique<const FixedShaftDrivetrain>(study);
    }
    return std::make_unique<const PlanetaryDrivetrain>(study);
}

}  // namespace gearpod::mc
