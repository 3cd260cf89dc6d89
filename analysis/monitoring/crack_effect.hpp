// Size of a crack from which a monitored value shows it. Alarms at smaller cracks are false.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"

namespace gearpod::analysis {

// Values of one gearbox with a growing crack, as seen by a monitor.
struct CrackedLife {
    std::vector<double> values;        // deviations in time order; NaN: a record without a value
    std::vector<double> hours, sizes;  // of each record
    std::size_t first = 0;             // first record with the crack
    std::optional<double> end_hours;   // empty: still running at the last record
};

// The crack has an effect if the median or the 90 % quantile of the values has risen above that of
// healthy values by this many standard deviations of healthy values.
inline constexpr double kEffectDeviations = 0.5;

// Smallest size at and above which the crack has an effect on the values. The records with a crack
// are divided into at most 20 groups of equal number by size, of at least 40 records each where
// there are as many; the result is the smallest size in the first group from which on all groups
// have moved. Infinite if the largest cracks have no effect; NaN without healthy values.
// `two_sided`: a fall of the median or of the 10 % quantile counts as well. The healthy standard
// deviation is half the distance of the 16 and 84 % quantiles.
double effect_size(std::span<const HealthyLife> healthy, std::span<const CrackedLife> cracked,
                   bool two_sided);

}  // namespace gearpod::analysis
