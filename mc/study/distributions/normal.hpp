// Normal distribution. Values beyond 8.3 standard deviations (probability 1e-16) are rejected and
// sampled again. A bounded input may therefore be normal if its bound is that far from the mean.
#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Normal : LawDefaults {
    static constexpr std::string_view kName = "normal";
    double mean = 0.0;
    double sd = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"mean", &Normal::mean}, Field{"sd", &Normal::sd, kPositiveField}};
    }
    double median() const { return mean; }
    static constexpr double kReach = 8.3;  // standard deviations
    Support support() const { return {mean - kReach * sd, mean + kReach * sd}; }
    double draw(Philox& engine, std::uint64_t) const {
        boost::random::normal_distribution<double> normal;
        double z = normal(engine);
        while (std::abs(z) > kReach) {
            z = normal(engine);
        }
        return mean + sd * z;
    }
    double quantile(double p) const {
        return mean - sd * std::sqrt(2.0) * boost::math::erfc_inv(2.0 * p);
    }
    bool operator==(const Normal&) const = default;
};

}  // namespace gearpod::mc
