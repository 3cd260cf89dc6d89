// How the gearboxes of an ensemble share out the ranges of their random inputs
// (ensemble.sampling): each by itself, or as points that fill them evenly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/random/scrambled_sobol.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// A dimension for every input that is drawn by a distribution's quantile, in the order of the
// study's random inputs. Gearboxes of one group and of the same values in turn (levels, grid) are
// the points of a sequence of their own, scrambled by the seed; those of a larger ensemble go on
// with it.
class SamplingPlan {
  public:
    // `combinations`: of the values in turn, of which the fault's sizes come first.
    SamplingPlan(const Study& study, std::uint64_t sizes, std::uint64_t combinations);

    // Of the study's random input at a place: whether it is drawn by share().
    bool has(std::size_t input) const {
        return input < dimension_.size() && dimension_[input] >= 0;
    }
    // Where the input of a gearbox lies in its distribution, 0 < share < 1.
    double share(std::size_t input, Group group, std::uint64_t index) const;

  private:
    struct Place {
        std::uint64_t sequence, number;
    };
    Place place(Group group, std::uint64_t index) const;

    std::uint64_t seed_;
    std::uint64_t sizes_, combinations_;
    std::vector<int> dimension_;           // by input; -1: none
    std::vector<std::uint64_t> purposes_;  // by dimension
    Sobol sobol_;
};

}  // namespace gearpod::mc
