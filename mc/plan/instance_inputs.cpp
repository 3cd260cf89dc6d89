#include "mc/plan/instance_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/noise.hpp"

namespace gearpod::mc {
namespace {

double angle_of(const Gearbox& gearbox, std::size_t planet) {
    return gearbox.planet_positions_rad.empty()
               ? 2.0 * std::numbers::pi * static_cast<double>(planet) / gearbox.planets
               : gearbox.planet_positions_rad[planet];
}

void move_pin(double angle, double tangential_m, double radial_m,
              dynamics::PlanetDeviations& planet) {
    const double c = std::cos(angle), s = std::sin(angle);
    planet.pin_x_m += radial_m * c - tangential_m * s;
    planet.pin_y_m += radial_m * s + tangential_m * c;
}

double of_planet(const std::vector<double>& list, std::size_t planet, double otherwise) {
    return planet < list.size() ? list[planet] : otherwise;
}

}  // namespace

Planets given_planets(const Study& study) {
    const PlanetDifferences& given = study.planets;
    Planets planets;
    for (std::size_t n = 0; n < planets.size(); ++n) {
        planets[n] = {of_planet(given.bearing_stiffness, n, 1.0),
                      of_planet(given.bearing_damping, n, 1.0), of_planet(given.mass, n, 1.0), 0.0,
                      0.0};
        if (!given.pin_tangential_m.empty() || !given.pin_radial_m.empty()) {
            move_pin(angle_of(study.gearbox, n), of_planet(given.pin_tangential_m, n, 0.0),
                     of_planet(given.pin_radial_m, n, 0.0), planets[n]);
        }
    }
    return planets;
}

void add_random_planets(const InputValues& values, std::function<double()> normal,
                        std::function<double()> normal_of_pins, Planets& planets) {
    const Study& study = values.study();
    const PlanetDifferences& drawn = study.planets;
    const double tangential_m = values.of(drawn.pin_tangential_rms_m),
                 radial_m = values.of(drawn.pin_radial_rms_m),
                 stiffness = values.of(drawn.bearing_stiffness_scatter),
                 damping = values.of(drawn.bearing_damping_scatter),
                 mass = values.of(drawn.mass_scatter);
    for (std::size_t n = 0; n < static_cast<std::size_t>(study.gearbox.planets); ++n) {
        std::array<double, 5> own{}, of_pins{};
        std::ranges::generate(own, std::ref(normal));
        std::ranges::generate(of_pins, std::ref(normal_of_pins));
        move_pin(angle_of(study.gearbox, n), tangential_m * of_pins[0], radial_m * of_pins[1],
                 planets[n]);
        planets[n].bearing_stiffness *= std::exp(stiffness * own[2]);
        planets[n].bearing_damping *= std::exp(damping * own[3]);
        planets[n].mass *= std::exp(mass * own[4]);
    }
}

namespace {

// J / r^2 from the given J / r^2 or J, else from the mass of a solid disc. For a disc with the
// pitch radius r_p, J = m r_p^2 / 2, and r_p = r_b / cos a.
double over_r2(const std::optional<double>& inertia_over_r2, const std::optional<double>& inertia,
               double radius_m, double disc_over_r2) {
    if (inertia_over_r2) {
        return *inertia_over_r2;
    }
    return inertia ? *inertia / (radius_m * radius_m) : disc_over_r2;
}

void resolve_inertias(const InputValues& values, MemberArray<BodyInstance>& bodies) {
    const Study& study = values.study();
    const bool gears = has_gears(study);
    const double cosine = std::cos(transverse_pressure_angle_rad(study.gearbox));
    const auto resolve = [&](Member member, double radius_m, double disc) {
        const MemberValues& given = study.gearbox.bodies[member];
        bodies[member].inertia_over_r2_kg =
            over_r2(values.of(given.inertia_over_r2_kg), values.of(given.inertia_kg_m2), radius_m,
                    disc * bodies[member].mass_kg);
    };
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        resolve(member, gears ? gear_of(study, member).base_radius() : 0.0,
                0.5 / (cosine * cosine));
    }
    resolve(Member::carrier, gears ? centre_distance_m(study) : 0.0, 0.5);
}

// Tooth deviations relative to grade 5: a factor of sqrt(2) for each grade.
double tooth_scale(const InputValues& values, Member member) {
    const std::optional<double> own = values.of(values.study().gearbox.bodies[member].quality);
    const std::optional<double> grade = own ? own : values.of(values.study().errors.tooth_quality);
    return grade ? std::pow(2.0, 0.5 * (*grade - 5.0)) : 0.0;
}

// Moment of inertia, by default that of a disc with the pitch radius: I = m R_p^2 / 2 (Tian, Table
// 4.1).
double inertia_or_disc(const std::optional<double>& inertia, double mass_kg, double radius_m) {
    return inertia.value_or(0.5 * mass_kg * radius_m * radius_m);
}

void resolve_fixed_shaft(const InputValues& values, InstanceInputs& inputs) {
    const Study& study = values.study();
    for (const Member member : {Member::pinion, Member::gear}) {
        BodyInstance& body = inputs.bodies[member];
        body.inertia_kg_m2 = inertia_or_disc(values.of(study.gearbox.bodies[member].inertia_kg_m2),
                                             body.mass_kg, gear_of(study, member).pitch_radius());
    }
    const FixedShaft& f = study.fixed_shaft;
    FixedShaftInstance& out = inputs.fixed_shaft;
    out.motor_inertia_kg_m2 = values.of(f.motor_inertia_kg_m2).value_or(0.0);
    out.load_inertia_kg_m2 = values.of(f.load_inertia_kg_m2).value_or(0.0);
    out.motor_coupling_stiffness_N_m_rad = values.of(f.motor_coupling_stiffness_N_m_rad);
    out.load_coupling_stiffness_N_m_rad = values.of(f.load_coupling_stiffness_N_m_rad);
    out.motor_coupling_damping_N_m_s_rad = values.of(f.motor_coupling_damping_N_m_s_rad);
    out.load_coupling_damping_N_m_s_rad = values.of(f.load_coupling_damping_N_m_s_rad);
    const double ratio =
        static_cast<double>(*teeth_of(study, Member::gear)) / *teeth_of(study, Member::pinion);
    out.load_torque_N_m = values.of(study.operation.load_torque_N_m)
                              .value_or(values.of(study.operation.torque_N_m) * ratio);
}

dynamics::DampingParameters mesh_damping(const InputValues& values) {
    dynamics::DampingParameters all{};
    const Study& study = values.study();
    std::ranges::transform(
        study.gearbox.mesh_damping[study.effects.mesh_damping], all.begin(),
        [&](const std::optional<double>& one) { return values.of(one).value_or(0.0); });
    return all;
}

FluctuationInstance fluctuations(const InputValues& values) {
    const Fluctuations& f = values.study().fluctuations;
    const auto or_0 = [&](const std::optional<double>& number) {
        return values.of(number).value_or(0.0);
    };
    return {or_0(f.torque),
            or_0(f.torque_order),
            or_0(f.torque_Hz),
            values.of(f.torque_phase_rad),
            or_0(f.torque_noise),
            or_0(f.torque_noise_Hz),
            or_0(f.speed),
            or_0(f.speed_order),
            values.of(f.speed_phase_rad),
            or_0(f.speed_noise),
            or_0(f.speed_noise_Hz)};
}

double speed(const InputValues& values) {
    const Operation& o = values.study().operation;
    for (const std::optional<double>* given :
         {&o.pinion_speed_rad_s, &o.sun_speed_rad_s, &o.ring_speed_rad_s, &o.carrier_speed_rad_s}) {
        if (const std::optional<double> value = values.of(*given)) {
            return *value;
        }
    }
    return 0.0;
}

}  // namespace

Member speed_member(const Study& study) {
    return study.operation.pinion_speed_rad_s ? Member::pinion
           : study.operation.sun_speed_rad_s  ? Member::sun
           : study.operation.ring_speed_rad_s ? Member::ring
                                              : Member::carrier;
}

InstanceInputs instance_inputs(const InputValues& values) {
    const Study& study = values.study();
    const Gearbox& g = study.gearbox;
    InstanceInputs inputs{};
    for (const Member member : kAllMembers) {
        const MemberValues& given = g.bodies[member];
        // Masses are optional for a quasi-static gearbox, bearings for a torsional one.
        inputs.bodies[member] = {values.of(given.mass_kg).value_or(0.0),
                                 0.0,
                                 0.0,
                                 values.of(given.bearing_stiffness_N_m).value_or(0.0),
                                 values.of(given.bearing_damping_N_s_m),
                                 tooth_scale(values, member)};
    }
    if (g.kind == GearboxKind::fixed_shaft) {
        resolve_fixed_shaft(values, inputs);
    } else {
        resolve_inertias(values, inputs.bodies);
    }
    inputs.backlash_m = values.of(g.backlash_m).value_or(0.0);
    inputs.pitch_error_m = values.of(study.errors.pitch_error_m);
    inputs.index_wave_m = values.of(study.errors.index_wave_m);
    inputs.eccentricity_m = values.of(study.errors.eccentricity_m);
    inputs.profile_slope_m = values.of(study.errors.profile_slope_m);
    inputs.planets = given_planets(study);
    inputs.support_stiffness_N_m = values.of(g.support_stiffness_N_m);
    inputs.support_damping_N_s_m = values.of(g.support_damping_N_s_m);
    inputs.mesh_damping = mesh_damping(values);
    inputs.torque_N_m = values.of(study.operation.torque_N_m);
    inputs.speed_rad_s = speed(values);
    inputs.fluctuations = fluctuations(values);
    // A fixed-shaft gearbox has no transmission path weighting.
    inputs.path_exponent =
        g.kind == GearboxKind::fixed_shaft ? 0.0 : values.of(study.sensor.path_exponent);
    inputs.gain = values.of(study.sensor.gain);
    inputs.tone_level = values.of(study.sensor.tone_level);
    inputs.bearing_level = values.of(study.sensor.bearing_level);
    inputs.housing_frequency_factor = values.of(study.sensor.housing_frequency_factor);
    const SensorNoise noise = sensor_noise(
        study, {values.of(study.sensor.noise_density_m_s2_per_sqrt_Hz),
                values.of(study.sensor.noise_m_s2), values.of(study.sensor.background_level)});
    inputs.noise_m_s2 = noise.all_m_s2;
    inputs.white_noise_m_s2 = noise.white_m_s2;
    inputs.background_noise_m_s2 = noise.background_m_s2;
    inputs.low_pass_Hz = study.sensor.low_pass_Hz;
    inputs.own_sampling_Hz = 0.0;
    inputs.range_m_s2 = study.sensor.range_m_s2.value_or(std::numeric_limits<double>::infinity());
    inputs.encoder_noise_rad = values.of(study.sensor.encoder_noise_rad);
    inputs.fault_size = study.fault.kind == nullptr
                            ? 0.0
                            : values.of(study.fault.kind->size().access).value_or(0.0);
    inputs.paris_factor = values.of(study.life.paris_factor).value_or(0.0);
    inputs.paris_exponent = values.of(study.life.paris_exponent).value_or(0.0);
    inputs.curve_pace = values.of(study.life.curve_pace).value_or(1.0);
    return inputs;
}

InstanceInputs nominal_inputs(const Study& study) {
    return instance_inputs(InputValues(study));
}

}  // namespace gearpod::mc
