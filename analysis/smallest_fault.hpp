// The headline: the smallest fault found with a probability of 90 % at the confidence asked for.
//
// A feature's own: a90's upper bound where the curve fits, else the size that the rates alone vouch
// for. A fitted curve may read off a larger size after a miss has become a hit (its slope falls),
// and perfect detection has no curve: so what a feature vouches for at some noise level holds for
// every feature and level all the more that finds at least as many faults in every group of sizes.
// Thus the size never grows where no rate falls, and no feature loses to one that finds fewer.
#pragma once

#include <optional>
#include <string>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

struct SmallestFault {
    // Whose bound it is: the feature and noise level themselves, or ones that find no more.
    struct Source {
        std::string feature;
        double noise_level = 0.0;
        bool operator==(const Source&) const = default;
    };
    std::string feature;
    double size = 0.0;
    bool from_curve = false;  // the bound is a90's; else a tested size
    Source source;
    bool own = true;  // the source is the feature at this noise level
};

// Of a feature (by its place in `reliability.features`) at a noise level.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level,
                                            std::size_t feature);

// No feature has a threshold at the noise level: that there is no smallest fault says nothing.
bool without_threshold(const Reliability& reliability, std::size_t level);

// Of all features, the least; of equal ones the one that finds most, then the better ranked.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level);

}  // namespace gearpod::analysis
