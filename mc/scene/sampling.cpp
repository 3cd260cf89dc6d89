#include "mc/scene/sampling.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mc/study/gears.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

// The size is the only key of a fault that may be random.
bool is_fault_size(const RandomInput& input) {
    return input.key.starts_with("fault.");
}

const Key& key_of(const std::string& path) {
    const std::size_t dot = path.find('.');
    return *find_key(path.substr(0, dot), path.substr(dot + 1));
}
const Key& key_of(const RandomInput& input) {
    return key_of(input.key);
}

// Purpose of the random numbers of an input. Inputs from the columns of one table share it.
StreamPurpose purpose_of(const RandomInput& input) {
    const int table = input.distribution.rows().group;
    return table > 0 ? with_suffix(StreamPurpose::table_row, std::to_string(table))
                     : with_suffix(StreamPurpose::random_input, input.key);
}

// J / r^2 from the given J / r^2 or J, else from the mass of a solid disc. For a disc with the
// pitch radius r_p, J = m r_p^2 / 2, and r_p = r_b / cos a.
double over_r2(const std::optional<double>& inertia_over_r2, const std::optional<double>& inertia,
               double radius_m, double disc_over_r2) {
    if (inertia_over_r2) {
        return *inertia_over_r2;
    }
    return inertia ? *inertia / (radius_m * radius_m) : disc_over_r2;
}

void resolve_inertias(const Study& study, MemberArray<BodyInstance>& bodies) {
    const bool gears = has_gears(study);
    const double cosine = std::cos(transverse_pressure_angle_rad(study.gearbox));
    const auto resolve = [&](Member member, double radius_m, double disc) {
        const MemberValues& given = study.gearbox.bodies[member];
        bodies[member].inertia_over_r2_kg = over_r2(given.inertia_over_r2_kg, given.inertia_kg_m2,
                                                    radius_m, disc * bodies[member].mass_kg);
    };
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        resolve(member, gears ? gear_of(study, member).base_radius() : 0.0,
                0.5 / (cosine * cosine));
    }
    resolve(Member::carrier, gears ? centre_distance_m(study) : 0.0, 0.5);
}

// Tooth deviations relative to grade 5: a factor of sqrt(2) for each grade.
double tooth_scale(const Study& study, Member member) {
    const std::optional<double>& own = study.gearbox.bodies[member].quality;
    const std::optional<double>& grade = own ? own : study.errors.tooth_quality;
    return grade ? std::pow(2.0, 0.5 * (*grade - 5.0)) : 0.0;
}

// Moment of inertia, by default that of a disc with the pitch radius: I = m R_p^2 / 2 (Tian, Table
// 4.1).
double inertia_or_disc(const std::optional<double>& inertia, double mass_kg, double radius_m) {
    return inertia.value_or(0.5 * mass_kg * radius_m * radius_m);
}

void resolve_fixed_shaft(const Study& study, InstanceInputs& inputs) {
    for (const Member member : {Member::pinion, Member::gear}) {
        BodyInstance& body = inputs.bodies[member];
        body.inertia_kg_m2 = inertia_or_disc(study.gearbox.bodies[member].inertia_kg_m2,
                                             body.mass_kg, gear_of(study, member).pitch_radius());
    }
    const FixedShaft& f = study.fixed_shaft;
    FixedShaftInstance& out = inputs.fixed_shaft;
    out.motor_inertia_kg_m2 = f.motor_inertia_kg_m2.value_or(0.0);
    out.load_inertia_kg_m2 = f.load_inertia_kg_m2.value_or(0.0);
    out.motor_coupling_stiffness_N_m_rad = f.motor_coupling_stiffness_N_m_rad;
    out.load_coupling_stiffness_N_m_rad = f.load_coupling_stiffness_N_m_rad;
    out.motor_coupling_damping_N_m_s_rad = f.motor_coupling_damping_N_m_s_rad;
    out.load_coupling_damping_N_m_s_rad = f.load_coupling_damping_N_m_s_rad;
    const double ratio =
        static_cast<double>(*teeth_of(study, Member::gear)) / *teeth_of(study, Member::pinion);
    out.load_torque_N_m =
        study.operation.load_torque_N_m.value_or(study.operation.torque_N_m * ratio);
}

double mesh_damping(const Study& study) {
    const Gearbox& g = study.gearbox;
    switch (study.effects.mesh_damping) {
        case MeshDamping::ratio:
            return g.mesh_damping_ratio.value_or(0.0);
        case MeshDamping::proportional:
            return g.mesh_damping_time_s.value_or(0.0);
        case MeshDamping::constant:
            return g.mesh_damping_N_s_m.value_or(0.0);
    }
    return 0.0;
}

FluctuationInstance fluctuations(const Fluctuations& f) {
    return {
        f.torque.value_or(0.0),      f.torque_order.value_or(0.0),  f.torque_Hz.value_or(0.0),
        f.torque_phase_rad,          f.torque_noise.value_or(0.0),  f.torque_noise_Hz.value_or(0.0),
        f.speed.value_or(0.0),       f.speed_order.value_or(0.0),   f.speed_phase_rad,
        f.speed_noise.value_or(0.0), f.speed_noise_Hz.value_or(0.0)};
}

double speed(const Operation& o) {
    for (const auto& given :
         {o.pinion_speed_rad_s, o.sun_speed_rad_s, o.ring_speed_rad_s, o.carrier_speed_rad_s}) {
        if (given) {
            return *given;
        }
    }
    return 0.0;
}

std::uint64_t product_or_most(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    return a > kMost / b ? kMost : a * b;
}

// Number of combinations of the values of `levels` and `grid` inputs, or of the fault sizes only.
std::uint64_t level_combinations(const std::vector<RandomInput>& inputs, bool sizes_only) {
    std::uint64_t all = 1;
    for (const RandomInput& input : inputs) {
        const std::uint64_t count = input.distribution.levels().size();
        if (count > 0 && (is_fault_size(input) || !sizes_only)) {
            all = product_or_most(all, count);
        }
    }
    return all;
}

// Place value of each random input's digit in the mixed radix: the product of the numbers of values
// of the inputs before it.
std::vector<std::uint64_t> level_strides(const std::vector<RandomInput>& inputs) {
    std::vector<std::uint64_t> lengths(inputs.size(), 1);
    std::uint64_t length = 1;
    for (const bool size : {true, false}) {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const std::uint64_t count = inputs[i].distribution.levels().size();
            if (is_fault_size(inputs[i]) == size && count > 0) {
                lengths[i] = length;
                length = product_or_most(length, count);
            }
        }
    }
    return lengths;
}

// Standard normal quantile at probability `share`.
double standard_normal_quantile(double share) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * share);
}

}  // namespace

InstanceInputs resolve_inputs(const Study& study) {
    const Gearbox& g = study.gearbox;
    InstanceInputs inputs{};
    for (const Member member : kAllMembers) {
        const MemberValues& given = g.bodies[member];
        // Masses are optional for a quasi-static gearbox, bearings for a torsional one.
        inputs.bodies[member] = {given.mass_kg.value_or(0.0),
                                 0.0,
                                 0.0,
                                 given.bearing_stiffness_N_m.value_or(0.0),
                                 given.bearing_damping_N_s_m,
                                 tooth_scale(study, member)};
    }
    if (g.kind == GearboxKind::fixed_shaft) {
        resolve_fixed_shaft(study, inputs);
    } else {
        resolve_inertias(study, inputs.bodies);
    }
    inputs.backlash_m = g.backlash_m.value_or(0.0);
    inputs.pitch_error_m = study.errors.pitch_error_m;
    inputs.index_wave_m = study.errors.index_wave_m;
    inputs.eccentricity_m = study.errors.eccentricity_m;
    inputs.profile_slope_m = study.errors.profile_slope_m;
    inputs.planets = given_planets(study);
    inputs.support_stiffness_N_m = g.support_stiffness_N_m;
    inputs.support_damping_N_s_m = g.support_damping_N_s_m;
    inputs.mesh_damping = mesh_damping(study);
    inputs.torque_N_m = study.operation.torque_N_m;
    inputs.speed_rad_s = speed(study.operation);
    inputs.fluctuations = fluctuations(study.fluctuations);
    // A fixed-shaft gearbox has no transmission path weighting.
    inputs.path_exponent = g.kind == GearboxKind::fixed_shaft ? 0.0 : study.sensor.path_exponent;
    inputs.gain = study.sensor.gain;
    inputs.tone_level = study.sensor.tone_level;
    inputs.noise_m_s2 = sensor_noise_m_s2(study);
    inputs.encoder_noise_rad = study.sensor.encoder_noise_rad;
    inputs.fault_size = fault_size(study);
    inputs.paris_factor = study.life.paris_factor.value_or(0.0);
    inputs.paris_exponent = study.life.paris_exponent.value_or(0.0);
    inputs.curve_pace = study.life.curve_pace.value_or(1.0);
    return inputs;
}

NoiseSampling threshold_noise_sampling(const Study& study) {
    return study.ensemble.uses_importance_sampling() ? NoiseSampling::towards_alarms
                                                     : NoiseSampling::plain;
}

Sampler::Sampler(const Study& study)
    : study_(study),
      copula_(study),
      level_strides_(level_strides(study.random)),
      plan_(study, level_combinations(study.random, true),
            level_combinations(study.random, false)) {}

Study Sampler::draw(const GearboxId& id) const {
    Study drawn = study_;
    const std::vector<double> uniform = copula_.uniform_variates([&](std::size_t input) {
        if (plan_.has(input)) {
            return standard_normal_quantile(plan_.variate(input, id.group, id.index));
        }
        const StreamPurpose purpose =
            with_suffix(StreamPurpose::random_input, study_.random[input].key);
        return Normals(study_, id, purpose)();
    });
    const auto drawn_alone = [&](const RandomInput& input, std::uint64_t level_stride) {
        const StreamPurpose purpose = purpose_of(input);
        GearboxId own = id;
        own.record = input.distribution.per_record() ? id.record : Record::test;
        if (id.exchanged && input.distribution.has_quantile()) {
            return input.distribution.quantile(
                standard_normal_cdf(Normals::of_record(study_, own, purpose)()));
        }
        Philox engine = record_stream(study_, own, purpose);
        return input.distribution.draw(engine, source_index(study_, id, purpose) / level_stride);
    };
    for (std::size_t i = 0, correlated = 0; i < study_.random.size(); ++i) {
        const RandomInput& input = study_.random[i];
        const double value = copula_.has(i) ? input.distribution.quantile(uniform[correlated++])
                             : plan_.has(i)
                                 ? input.distribution.quantile(plan_.variate(i, id.group, id.index))
                                 : drawn_alone(input, level_strides_[i]);
        std::get<NumberAccess>(key_of(input).access).set(drawn, value * input.to_si);
    }
    if (id.group == Group::threshold) {
        set_fault_size(drawn, 0.0);
    }
    return drawn;
}

InstanceInputs Sampler::sample(Group group, std::uint64_t index) const {
    return sample(GearboxId{group, index});
}

InstanceInputs Sampler::sample(const GearboxId& id, std::span<const GivenInput> given) const {
    GearboxId test_id = id;
    test_id.record = Record::test;
    Study drawn = draw(test_id);
    for (const GivenInput& one : given) {
        std::get<NumberAccess>(key_of(one.key).access).set(drawn, one.value);
    }
    return resolve(drawn, id);
}

InstanceInputs Sampler::resolve(const Study& drawn, const GearboxId& id) const {
    InstanceInputs inputs = resolve_inputs(drawn);
    if (has_random_planets(study_)) {
        add_random_planets(drawn, Normals(study_, id, StreamPurpose::planets), inputs.planets);
    }
    return inputs;
}

InstanceInputs Sampler::sample(const GearboxId& id) const {
    InstanceInputs inputs = resolve(draw(id), id);
    if (id.record == Record::baseline) {
        inputs.fault_size = 0.0;
        Normals unit = Normals::of_record(study_, id, StreamPurpose::baseline_torque);
        const double share = std::exp(study_.features.baseline_torque_scatter * unit());
        inputs.torque_N_m *= share;
        inputs.fixed_shaft.load_torque_N_m *= share;
    }
    return inputs;
}

InstanceInputs Sampler::nominal() const {
    return resolve_inputs(study_);
}

Member Sampler::speed_member() const {
    return study_.operation.pinion_speed_rad_s ? Member::pinion
           : study_.operation.sun_speed_rad_s  ? Member::sun
           : study_.operation.ring_speed_rad_s ? Member::ring
                                               : Member::carrier;
}

std::vector<ParameterColumn> Sampler::columns() const {
    std::vector<ParameterColumn> columns;
    for (const RandomInput& input : study_.random) {
        if (is_fault_size(input)) {
            continue;
        }
        const Key& key = key_of(input);
        columns.push_back({key.column(), std::string(key.unit.si_name)});
    }
    if (study_.ensemble.uses_importance_sampling()) {
        columns.push_back({"noise_weight", "1"});
    }
    columns.push_back(
        {fault_size_column(study_), std::string(fault_size_key(study_).unit.si_name)});
    return columns;
}

std::vector<double> Sampler::row(const GearboxId& id) const {
    const Study drawn = draw(id);
    std::vector<double> row;
    for (const RandomInput& input : study_.random) {
        if (!is_fault_size(input)) {
            row.push_back(std::get<NumberAccess>(key_of(input).access).get(drawn).value_or(0.0));
        }
    }
    if (study_.ensemble.uses_importance_sampling()) {
        row.push_back(1.0);
    }
    row.push_back(fault_size(drawn));
    return row;
}

}  // namespace gearpod::mc
