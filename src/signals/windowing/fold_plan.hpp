// Pairs of distinct mesh and carrier index that contribute to a fold modulo one planet turn
// (folded_signal.hpp).
#pragma once

#include <vector>

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Samples that have to be evaluated, and those that each planet tooth sums. A plan depends on the
// timeline only and serves any number of tiles.
class FoldPlan {
  public:
    // Throws std::invalid_argument if the layout has no meshes or the timeline is empty or
    // negative.
    FoldPlan(const Timeline& timeline, const SpanLayout& layout);

    // Pairs first[m]..first[m + 1] - 1 belong to distinct mesh m, at carrier indices carrier[q].
    struct Pairs {
        std::vector<int> first;
        std::vector<int> carrier;
    };
    // Sums of squares. Entries first[s]..first[s + 1] - 1 of sum s are pairs with their numbers of
    // occurrences.
    struct Sums {
        std::vector<int> first;
        std::vector<int> pair;
        std::vector<double> count;
    };

    const Pairs& pairs() const { return pairs_; }
    const Sums& sums() const { return sums_; }
    const std::vector<int>& sum_of_tooth() const { return sum_of_tooth_; }  // Z_p
    const std::vector<int>& pair_of_mesh() const { return pair_of_mesh_; }  // Z_p Z_r, of the span
    const SpanLayout& layout() const { return layout_; }
    int largest_mesh() const { return largest_mesh_; }

  private:
    SpanLayout layout_;
    int largest_mesh_ = 0;
    Pairs pairs_;
    Sums sums_;
    std::vector<int> sum_of_tooth_;
    std::vector<int> pair_of_mesh_;
};

}  // namespace gearpod::signals
