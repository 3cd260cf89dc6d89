// Truncated normal distribution: mean and sd before truncation to [low, high]. Sampled by inverting
// its distribution function. It is evaluated on the side of the mean where the tail is small, so
// that an interval far from the mean keeps its shape.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct TruncatedNormal : LawDefaults {
    static constexpr std::string_view kName = "truncated-normal";
    double mean = 0.0;
    double sd = 0.0;
    double low = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"mean", &TruncatedNormal::mean},
                          Field{"sd", &TruncatedNormal::sd, kPositiveField},
                          Field{"low", &TruncatedNormal::low},
                          Field{"high", &TruncatedNormal::high}};
    }
    std::string problem() const {
        if (low >= high) {
            return "low must be below high";
        }
        const double deviations = std::max((low - mean) / sd, (mean - high) / sd);
        return deviations > kFarthest ? "low..high lies more than 30 sd away from the mean" : "";
    }
    double median() const { return quantile(0.5); }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return quantile(boost::random::uniform_01<double>()(engine));
    }
    // Precondition: 0 <= p < 1.
    double quantile(double p) const {
        const double side = mean < 0.5 * low + 0.5 * high ? 1.0 : -1.0;
        const double scale = side / (std::sqrt(2.0) * sd);
        const double tail_low = std::erfc((low - mean) * scale);
        const double tail_high = std::erfc((high - mean) * scale);
        const double tail = tail_low + p * (tail_high - tail_low);
        // Bound of an interval that reaches to where erfc underflows to 0 or rounds to 2.
        if (tail <= 0.0 || tail >= 2.0) {
            return (tail <= 0.0) == (side > 0.0) ? high : low;
        }
        const double deviation = boost::math::erfc_inv(tail) / scale;
        return std::clamp(mean + deviation, low, high);
    }
    bool operator==(const TruncatedNormal&) const = default;

  private:
    // Beyond 30 standard deviations the tail probabilities approach the smallest doubles.
    static constexpr double kFarthest = 30.0;
};

}  // namespace gearpod::mc
