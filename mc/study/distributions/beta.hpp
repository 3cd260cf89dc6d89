// Beta distribution on [low, high]: density proportional to (x - low)^(alpha - 1) (high - x)^(beta
// - 1). Sampled by inverting its distribution function.
#pragma once

#include <boost/math/special_functions/beta.hpp>
#include <boost/random/uniform_01.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Beta : LawDefaults {
    static constexpr std::string_view kName = "beta";
    double low = 0.0;
    double high = 0.0;
    double alpha = 0.0;
    double beta = 0.0;

    static constexpr auto fields() {
        constexpr Range kExponent{0.05, 1e4};  // within it the inverse is exact to rounding
        return std::tuple{Field{"low", &Beta::low}, Field{"high", &Beta::high},
                          Field{"alpha", &Beta::alpha, kExponent},
                          Field{"beta", &Beta::beta, kExponent}};
    }
    std::string problem() const { return low >= high ? "low must be below high" : ""; }
    double median() const { return quantile(0.5); }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return quantile(boost::random::uniform_01<double>()(engine));
    }
    double quantile(double p) const {
        return low + (high - low) * boost::math::ibeta_inv(alpha, beta, p);
    }
    bool operator==(const Beta&) const = default;
};

}  // namespace gearpod::mc
