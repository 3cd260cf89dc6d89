#include "mc/plan/draw_plan.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace gearpod::mc
