// FM4 of the averages of the single planets, largest value, normal = 3. They are assembled from
// windows around the planets' passages of the sensor: vibration separation of McFadden (1991) and
// Howard (1990), signals/windowing/planet_separation.hpp; with FM4 (difference_moments.hpp): D. G.
// Lewicki, K. E. LaBerge, R. T. Ehinger and J. Fetty, NASA/TM-2011-217127. The fault of one planet
// is not averaged with its sound companions as in fm4. NaN without passages of all teeth, and if
// the difference signals are rounding errors.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/rounding.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

inline double separated_fm4(const SeparatedPlanets& planets) {
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t p = 0; p < planets.turn.size(); ++p) {
        if (!is_rounding(planets.difference[p], planets.turn[p])) {
            largest = std::fmax(largest, standardised_moment(planets.difference[p], 4));
        }
    }
    return largest;
}

}  // namespace gearpod::features
