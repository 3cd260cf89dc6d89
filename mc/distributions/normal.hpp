// Gaussian; unbounded, so only for inputs that may have any value.
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "mc/distribution.hpp"
#include "mc/distributions/field.hpp"

namespace gearpod::mc {

struct Normal {
    static constexpr std::string_view kName = "normal";
    double mean = 0.0;
    double sd = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"mean", &Normal::mean}, Field{"sd", &Normal::sd}};
    }
    std::string problem() const { return sd > 0.0 ? "" : "sd must be > 0"; }
    double median() const { return mean; }
    Support support() const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {-infinity, infinity, true, true};
    }
    std::vector<double> levels() const { return {}; }
    double draw(Philox& engine, std::uint64_t) const {
        return boost::random::normal_distribution<double>(mean, sd)(engine);
    }
    bool operator==(const Normal&) const = default;
};

}  // namespace gearpod::mc
