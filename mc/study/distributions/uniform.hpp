// Uniform distribution on [low, high).
#pragma once

#include <boost/random/uniform_real_distribution.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Uniform : LawDefaults {
    static constexpr std::string_view kName = "uniform";
    double low = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"low", &Uniform::low}, Field{"high", &Uniform::high}};
    }
    std::string problem() const { return low >= high ? "low must be below high" : ""; }
    double median() const { return 0.5 * low + 0.5 * high; }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return boost::random::uniform_real_distribution<double>(low, high)(engine);
    }
    double quantile(double p) const { return low + p * (high - low); }
    bool operator==(const Uniform&) const = default;
};

}  // namespace gearpod::mc
