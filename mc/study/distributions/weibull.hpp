// Weibull distribution, for lives, wind speeds and loads: P(value > x) = exp(-(x / scale)^shape).
#pragma once

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Weibull : LawDefaults {
    static constexpr std::string_view kName = "weibull";
    double scale = 0.0;
    double shape = 0.0;

    // Range of the shape: below 0.2 values reach down to the smallest doubles, above 1e4 the
    // distribution is practically a constant.
    static constexpr auto fields() {
        return std::tuple{Field{"scale", &Weibull::scale, kPositiveField},
                          Field{"shape", &Weibull::shape, Range{0.2, 1e4}}};
    }
    double median() const { return quantile(0.5); }
    Support support() const { return {0.0, std::numeric_limits<double>::infinity(), true, true}; }
    double draw(Philox& engine, std::uint64_t) const {
        constexpr double kLeast = 0x1p-54;  // replaces 0, which occurs once in 2^53 times
        return quantile(std::max(kLeast, boost::random::uniform_01<double>()(engine)));
    }
    double quantile(double p) const { return scale * std::pow(-std::log1p(-p), 1.0 / shape); }
    bool operator==(const Weibull&) const = default;
};

}  // namespace gearpod::mc
