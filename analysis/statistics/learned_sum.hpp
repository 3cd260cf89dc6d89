// Weighted sum of several values of a specimen that separates faulty from healthy specimens:
// Fisher's linear discriminant (Annals of Eugenics 7 (1936), 179-188).
//
// The weights are S^-1 (mean of the faulty - mean of the healthy). S is the covariance of the
// healthy values, of which a tenth is replaced by its diagonal, because few specimens determine it
// badly. The sum is scaled to mean 0 and standard deviation 1 in the healthy specimens that the
// weights come from.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace gearpod::analysis {

struct LearningSample {
    std::vector<std::vector<double>> values;  // [value][specimen]; NaN where one is missing
    std::vector<bool> faulty;                 // by specimen
    // Half to which a specimen belongs, 0 or 1. The weights of each half are learned in the other
    // one, so that no specimen is evaluated by weights that it has influenced.
    std::vector<int> half;
};

// True if a gearbox belongs to the second half. Decided by a hash bit of its index within its
// group, so that alternating levels do not fall into one half.
bool in_second_half(std::size_t gearbox);

// Smallest number of complete healthy and of complete faulty specimens in each half.
inline constexpr int kLeastLearned = 10;

// The sum of each specimen; NaN where a value is missing. Empty if either half has too few
// specimens or no scatter.
std::optional<std::vector<double>> learned_sum(const LearningSample& sample);

}  // namespace gearpod::analysis
