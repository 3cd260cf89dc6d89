// Headline result: the smallest fault found with a probability of 90 % at the requested confidence.
//
// For one feature alone this is the upper bound of a90 where the curve fits, otherwise the smallest
// size demonstrated by the tested rates. Two effects make this bound erratic: a fitted curve may
// give a larger size after a miss has become a hit (its slope falls), and perfect detection has no
// curve. A size demonstrated by one feature at one noise level therefore also holds for every
// feature and level that finds at least as many faults in every size group. As a result the size
// never grows where no rate falls, and no feature ranks below one that finds fewer faults.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

struct SmallestFault {
    // Feature and noise level whose bound is used: the requested ones, or ones that find no more
    // faults.
    struct Source {
        std::string feature;
        double noise_level = 0.0;
        bool operator==(const Source&) const = default;
    };
    std::string feature;
    double size = 0.0;
    bool from_curve = false;  // the bound is a90's, otherwise a demonstrated size
    Source source;
    bool own = true;  // the source is the feature itself at this noise level
};

// Smallest fault of one feature (index in `reliability.features`) at a noise level.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level,
                                            std::size_t feature);

// Smallest fault over all features. Of equal sizes, the feature that finds most comes first, then
// the better ranked.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level);

// The same from the tested rates alone, where there are too many values for curves: the smallest
// size demonstrated by its own and all larger sizes' rates.
std::optional<SmallestFault> smallest_fault(std::span<const FeatureDetection> detection,
                                            std::size_t level);

}  // namespace gearpod::analysis
