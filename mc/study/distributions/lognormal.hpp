// Lognormal distribution, given by its median and its coefficient of variation cv = sd / mean:
// sigma^2 = ln(1 + cv^2), mu = ln(median).
#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <boost/random/lognormal_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

// The member cannot be called `median` as in the study file, because median() is a function.
struct Lognormal : LawDefaults {
    static constexpr std::string_view kName = "lognormal";
    double middle = 0.0;
    double cv = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"median", &Lognormal::middle, kPositiveField},
                          Field{"cv", &Lognormal::cv, kPositiveField}};
    }
    double median() const { return middle; }
    Support support() const { return {0.0, std::numeric_limits<double>::infinity(), true, true}; }
    double draw(Philox& engine, std::uint64_t) const {
        const double sigma = std::sqrt(std::log1p(cv * cv));
        return boost::random::lognormal_distribution<double>(std::log(middle), sigma)(engine);
    }
    double quantile(double p) const {
        const double z = -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * p);
        return middle * std::exp(std::sqrt(std::log1p(cv * cv)) * z);
    }
    bool operator==(const Lognormal&) const = default;
};

}  // namespace gearpod::mc
