#include "mc/plan/sampling.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

std::vector<int> dimensions(const Study& study) {
    std::vector<int> dimension;
    if (study.ensemble.sampling == SamplingKind::plain) {
        return dimension;
    }
    int next = 0;
    for (const RandomInput& input : study.random) {
        const bool continuous = input.distribution.levels().empty();
        dimension.push_back(continuous && input.distribution.has_quantile() ? next++ : -1);
    }
    return dimension;
}

std::vector<StreamPurpose> purposes(const Study& study, const std::vector<int>& dimension) {
    std::vector<StreamPurpose> all;
    for (std::size_t i = 0; i < dimension.size(); ++i) {
        if (dimension[i] >= 0) {
            all.push_back(with_suffix(StreamPurpose::sobol_scrambling, study.random[i].key));
        }
    }
    return all;
}

}  // namespace

SamplingPlan::SamplingPlan(const Study& study, std::uint64_t sizes, std::uint64_t combinations)
    : seed_(static_cast<std::uint64_t>(study.ensemble.seed)),
      sizes_(sizes),
      combinations_(combinations),
      dimension_(dimensions(study)),
      purposes_(purposes(study, dimension_)),
      sobol_(purposes_.size()) {}

SamplingPlan::SequencePoint SamplingPlan::place(Group group, std::uint64_t index) const {
    const std::uint64_t round = index / combinations_;
    if (group == Group::test) {
        return {index % combinations_, round};
    }
    // Healthy gearboxes have no fault size: those that would differ only in it belong to one
    // sequence.
    return {index % combinations_ / sizes_, round * sizes_ + index % sizes_};
}

double SamplingPlan::variate(std::size_t input, Group group, std::uint64_t index) const {
    const auto dimension = static_cast<std::size_t>(dimension_[input]);
    const StreamPurpose purpose = purposes_[dimension];
    const auto [sequence, number] = place(group, index);
    const std::uint32_t point =
        owen_scrambled(sobol_.coordinate(static_cast<std::uint32_t>(number), dimension),
                       Philox(seed_, group, sequence, purpose));
    // The bits below the 32 of the Sobol point are independent for each gearbox, from a stream
    // whose first block no scrambling tree uses.
    const std::uint64_t own = Philox(seed_, group, index, purpose)();
    constexpr double kLeast = 0x1p-53;
    return std::clamp((point + static_cast<double>(own >> 11) * 0x1p-53) * 0x1p-32, kLeast,
                      1.0 - kLeast);
}

namespace {

bool is_fault_size(const RandomInput& input) {
    return input.kind == InputKind::fault_size;
}

// Address at which the study stores the number with this key.
const void* place_of(const Study& study, const std::string& path) {
    return std::get<NumberAccess>(find_key(path)->access).place(study);
}

// Purpose of the draws from a distribution. Inputs from the columns of one table share it.
StreamPurpose purpose_of(const RandomInput& input) {
    const int table = input.distribution.rows().group;
    return table > 0 ? with_suffix(StreamPurpose::table_row, std::to_string(table))
                     : with_suffix(StreamPurpose::random_input, input.key);
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

// Record whose random numbers an input has: that of the gearbox is the test record, and that of the
// baseline's assembly the first baseline record.
GearboxId owner(GearboxId id, DrawnPer per) {
    id.record = per == DrawnPer::gearbox ? Record::test : id.record;
    id.baseline = per == DrawnPer::record ? id.baseline : 0;
    return id;
}

}  // namespace

Realization at_sensor(const Study& study, const Realization& realization, std::uint64_t sensor) {
    Realization own = realization;
    own.id.sensor = sensor;
    const AdditionalSensor& additional = study.sensor.additional[sensor - 1];
    const SensorNoise noise = noise_at(study, additional, noise_of(own.inputs));
    own.inputs.noise_m_s2 = noise.all_m_s2;
    own.inputs.white_noise_m_s2 = noise.white_m_s2;
    own.inputs.background_noise_m_s2 = noise.background_m_s2;
    own.inputs.low_pass_Hz = additional.low_pass_Hz.value_or(own.inputs.low_pass_Hz);
    own.inputs.own_sampling_Hz = additional.sampling_Hz.value_or(0.0);
    own.inputs.range_m_s2 = additional.range_m_s2.value_or(own.inputs.range_m_s2);
    return own;
}

Sampler::Sampler(const Study& study)
    : study_(study),
      draw_plan_(make_draw_plan(study)),
      copula_(study),
      plan_(study, level_combinations(study.random, true),
            level_combinations(study.random, false)) {
    const std::vector<std::uint64_t> strides = level_strides(study.random);
    for (std::size_t i = 0; i < study_.random.size(); ++i) {
        const RandomInput& input = study_.random[i];
        inputs_.push_back({&input, place_of(study_, input.key),
                           with_suffix(StreamPurpose::random_input, input.key), purpose_of(input),
                           strides[i], is_fault_size(input)});
    }
}

// Uniform variates of the correlated inputs.
std::vector<double> Sampler::uniform_variates(const GearboxId& id) const {
    return copula_.uniform_variates([&](std::size_t input) {
        if (plan_.has(input)) {
            return standard_normal_quantile(plan_.variate(input, id.group, id.index));
        }
        return Normals(draw_plan_.seed, id, inputs_[input].normal)();
    });
}

// Value of an input that is neither correlated nor sampled by the plan.
double Sampler::draw_alone(const DrawnInput& drawn, const GearboxId& id) const {
    const Distribution& distribution = drawn.input->distribution;
    const GearboxId own = owner(id, distribution.per());
    if (id.exchanged && distribution.has_quantile()) {
        return distribution.quantile(
            standard_normal_cdf(Normals::of_record(draw_plan_.seed, own, drawn.whole)()));
    }
    Philox engine = record_stream(draw_plan_.seed, own, drawn.whole);
    return distribution.draw(engine,
                             source_index(draw_plan_.seed, id, drawn.whole) / drawn.level_stride);
}

Realization Sampler::draw(const GearboxId& id, std::span<const GivenInput> given) const {
    InputValues values(study_);
    Realization realization;
    realization.id = id;
    const std::vector<double> uniform = uniform_variates(id);
    for (std::size_t i = 0, correlated = 0; i < inputs_.size(); ++i) {
        const DrawnInput& drawn = inputs_[i];
        const Distribution& distribution = drawn.input->distribution;
        // A baseline's own values are not points of the plan.
        const bool planned =
            plan_.has(i) && (id.record == Record::test || distribution.per() == DrawnPer::gearbox);
        const double value = copula_.has(i) ? distribution.quantile(uniform[correlated++])
                             : planned ? distribution.quantile(plan_.variate(i, id.group, id.index))
                                       : draw_alone(drawn, id);
        values.set(drawn.place, value);
        if (!drawn.is_size) {
            realization.random_values.push_back(value);
        }
    }
    if (id.group == Group::threshold) {
        values.set(size_defining_kind(study_).size().access.place(study_), 0.0);
    }
    for (const GivenInput& one : given) {
        values.set(place_of(study_, one.key), one.value);
    }
    InstanceInputs& inputs = realization.inputs;
    inputs = instance_inputs(values);
    if (has_random_planets(study_)) {
        const auto normals = [&](DrawnPer per) {
            return Normals::of_record(draw_plan_.seed, owner(id, per), StreamPurpose::planets);
        };
        add_random_planets(
            values, normals(DrawnPer::gearbox),
            normals(redraws(study_, "pins") ? DrawnPer::assembly : DrawnPer::gearbox),
            inputs.planets);
    }
    if (id.record == Record::baseline) {
        inputs.fault_size = 0.0;
        Normals unit = Normals::of_record(draw_plan_.seed, id, StreamPurpose::baseline_torque);
        const double share = std::exp(study_.features.baseline_torque_scatter * unit());
        inputs.torque_N_m *= share;
        inputs.fixed_shaft.load_torque_N_m *= share;
    }
    return realization;
}

}  // namespace gearpod::mc
