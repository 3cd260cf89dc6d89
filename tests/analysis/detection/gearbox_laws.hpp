// Healthy gearboxes whose mean values have a normal or an exponential law, with normal noise of
// variance 1, and noise that is exponentially tilted towards alarms.
#pragma once

#include <boost/math/distributions/normal.hpp>

#include "tests/numbers.hpp"

namespace gearpod::analysis {

enum class Law { normal, exponential };

// False-alarm rate of further gearboxes whose means have this standard deviation.
inline double rate_beyond(double threshold, double deviation, Law law) {
    const boost::math::normal normal;
    if (law == Law::normal) {
        return cdf(complement(normal, threshold / std::sqrt(1.0 + deviation * deviation)));
    }
    constexpr int kSteps = 4000;
    constexpr double kFar = 40.0;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double g = (i + 0.5) * kFar / kSteps;
        sum += std::exp(-g) * cdf(complement(normal, threshold - deviation * (g - 1.0)));
    }
    return sum * kFar / kSteps;
}

inline constexpr std::array kShifts{0.0, 2.0, 3.5, 5.0};

// Weight of a value of noise that was shifted by each of kShifts equally often.
inline double weight_of(double z) {
    double density = 0.0;
    for (const double shift : kShifts) {
        density += std::exp(shift * (z - 0.5 * shift)) / kShifts.size();
    }
    return 1.0 / density;
}

}  // namespace gearpod::analysis
