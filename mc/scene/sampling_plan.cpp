#include "mc/scene/sampling_plan.hpp"

#include <algorithm>

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
    if (group == Group::graded) {
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

}  // namespace gearpod::mc
