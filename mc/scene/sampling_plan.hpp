// Sampling plan of the random inputs (ensemble.sampling): independent, or a randomized quasi-Monte
// Carlo sequence that fills their ranges evenly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/random/scrambled_sobol.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Assigns a dimension to every input that is sampled by a distribution's quantile, in the order of
// the study's random inputs. Gearboxes of one group with the same `levels` and `grid` values are
// the points of one sequence, scrambled by the seed. A larger ensemble continues the sequences.
class SamplingPlan {
  public:
    // `combinations`: number of combinations of `levels` and `grid` values; `sizes`: number of
    // fault sizes, which vary fastest.
    SamplingPlan(const Study& study, std::uint64_t sizes, std::uint64_t combinations);

    // True if the study's random input at this index is sampled by variate().
    bool has(std::size_t input) const {
        return input < dimension_.size() && dimension_[input] >= 0;
    }
    // Uniform variate in (0, 1) of an input of a gearbox.
    double variate(std::size_t input, Group group, std::uint64_t index) const;

  private:
    struct SequencePoint {
        std::uint64_t sequence, number;
    };
    SequencePoint place(Group group, std::uint64_t index) const;

    std::uint64_t seed_;
    std::uint64_t sizes_, combinations_;
    std::vector<int> dimension_;           // by input; -1: not sampled by the plan
    std::vector<StreamPurpose> purposes_;  // by dimension
    Sobol sobol_;
};

}  // namespace gearpod::mc
