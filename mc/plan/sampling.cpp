#include "mc/plan/sampling.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/keys/key.hpp"

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
            all.push_back(
                with_suffix(StreamPurpose::sobol_scrambling, flat_path(study.random[i].key)));
        }
    }
    return all;
}

bool is_fault_size(const RandomInput& input) {
    return input.kind == InputKind::fault_size;
}

// Purpose of the draws from a distribution. Inputs from the columns of one table share it.
StreamPurpose purpose_of(const RandomInput& input) {
    const int table = input.distribution.rows().group;
    return table > 0 ? with_suffix(StreamPurpose::table_row, std::to_string(table))
                     : with_suffix(StreamPurpose::random_input, flat_path(input.key));
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

std::vector<DrawnInput> drawn_inputs(const Study& study) {
    const std::vector<std::uint64_t> strides = level_strides(study.random);
    std::vector<DrawnInput> inputs;
    for (std::size_t i = 0; i < strides.size(); ++i) {
        const RandomInput& input = study.random[i];
        inputs.push_back({input_id(input.key), input.kind, input.distribution,
                          with_suffix(StreamPurpose::random_input, flat_path(input.key)),
                          purpose_of(input), strides[i]});
    }
    return inputs;
}

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

SamplingPlan::SamplingPlan(const Study& study)
    : seed_(static_cast<std::uint64_t>(study.ensemble.seed)),
      sizes_(level_combinations(study.random, true)),
      combinations_(level_combinations(study.random, false)),
      dimension_(dimensions(study)),
      purposes_(purposes(study, dimension_)),
      sobol_(purposes_.size()) {}

SamplingPlan::SequencePoint SamplingPlan::point_of(Group group, std::uint64_t index) const {
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
    const auto [sequence, number] = point_of(group, index);
    const std::uint32_t point =
        owen_scrambled(sobol_.coordinate(static_cast<std::uint32_t>(number), dimension),
                       Philox(seed_, group, sequence, purpose));
    // The bits below the 32 of the Sobol point are independent for each gearbox, from a stream
    // whose first block no scrambling tree uses.
    const std::uint64_t lower_bits = Philox(seed_, group, index, purpose)();
    constexpr double kLeast = 0x1p-53;
    return std::clamp((point + static_cast<double>(lower_bits >> 11) * 0x1p-53) * 0x1p-32, kLeast,
                      1.0 - kLeast);
}

DrawPlan::DrawPlan(const Study& study)
    : seed(static_cast<std::uint64_t>(study.ensemble.seed)),
      rows(study.ensemble),
      inputs(drawn_inputs(study)),
      copula(study),
      sampling(study),
      recipe(study),
      fault_size(input_id("fault." + std::string(size_defining_kind(study).size().name))),
      baseline_torque_scatter(study.features.baseline_torque_scatter),
      redraws_teeth(redraws(study, "teeth")) {
    if (has_random_planets(study)) {
        planets.emplace(study.gearbox,
                        redraws(study, "pins") ? DrawnPer::assembly : DrawnPer::gearbox);
    }
}

std::vector<double> Sampler::uniform_variates(const GearboxId& id) const {
    return plan_.copula.uniform_variates([&](std::size_t input) {
        if (plan_.sampling.has(input)) {
            return standard_normal_quantile(plan_.sampling.variate(input, id.group, id.index));
        }
        return Normals(plan_.seed, id, plan_.inputs[input].normal)();
    });
}

// Value of an input that is neither correlated nor sampled by the plan.
double Sampler::draw_alone(const DrawnInput& input, const GearboxId& id) const {
    const Distribution& distribution = input.distribution;
    const GearboxId owner_id = owner(id, distribution.per());
    if (id.exchanged && distribution.has_quantile()) {
        return distribution.quantile(
            standard_normal_cdf(Normals::of_record(plan_.seed, owner_id, input.whole)()));
    }
    Philox engine = record_stream(plan_.seed, owner_id, input.whole);
    return distribution.draw(engine,
                             source_index(plan_.seed, id, input.whole) / input.level_stride);
}

Realization Sampler::draw(const GearboxId& id, std::span<const GivenInput> given) const {
    InputValues values = plan_.recipe.nominal;
    Realization realization;
    realization.id = id;
    const SamplingPlan& sampling = plan_.sampling;
    const std::vector<double> uniform = uniform_variates(id);
    for (std::size_t i = 0, correlated = 0; i < plan_.inputs.size(); ++i) {
        const DrawnInput& input = plan_.inputs[i];
        const Distribution& distribution = input.distribution;
        // A baseline's own values are not points of the sampling plan.
        const bool planned = sampling.has(i) &&
                             (id.record == Record::test || distribution.per() == DrawnPer::gearbox);
        const double value = plan_.copula.has(i) ? distribution.quantile(uniform[correlated++])
                             : planned
                                 ? distribution.quantile(sampling.variate(i, id.group, id.index))
                                 : draw_alone(input, id);
        values.set(input.id, value);
        if (input.kind != InputKind::fault_size) {
            realization.random_values.push_back(value);
        }
    }
    if (id.group == Group::threshold) {
        values.set(plan_.fault_size, 0.0);
    }
    for (const GivenInput& input : given) {
        values.set(input.id, input.value);
    }
    InstanceInputs& inputs = realization.inputs;
    inputs = instance_inputs(plan_.recipe, values);
    if (plan_.planets) {
        add_random_planets(
            *plan_.planets, values,
            Normals::of_record(plan_.seed, owner(id, plan_.planets->pins), StreamPurpose::planets),
            inputs.planets);
    }
    if (id.record == Record::baseline) {
        inputs.fault_size = 0.0;
        Normals unit = Normals::of_record(plan_.seed, id, StreamPurpose::baseline_torque);
        const double share = std::exp(plan_.baseline_torque_scatter * unit());
        inputs.torque_N_m *= share;
        inputs.fixed_shaft.load_torque_N_m *= share;
    }
    return realization;
}

}  // namespace gearpod::mc
