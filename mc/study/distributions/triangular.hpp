// Triangular distribution: density highest at the mode, falling linearly to zero at low and high.
#pragma once

#include <boost/random/triangle_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Triangular : LawDefaults {
    static constexpr std::string_view kName = "triangular";
    double low = 0.0;
    double mode = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"low", &Triangular::low}, Field{"mode", &Triangular::mode},
                          Field{"high", &Triangular::high}};
    }
    std::string problem() const {
        return low >= high || low > mode || mode > high
                   ? "must have low <= mode <= high and low < high"
                   : "";
    }
    double median() const {
        const double width = high - low;
        return 2.0 * mode >= low + high ? low + std::sqrt(0.5 * width * (mode - low))
                                        : high - std::sqrt(0.5 * width * (high - mode));
    }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return boost::random::triangle_distribution<double>(low, mode, high)(engine);
    }
    double quantile(double p) const {
        const double width = high - low, left = (mode - low) / width;
        return p < left ? low + std::sqrt(p * width * (mode - low))
                        : high - std::sqrt((1.0 - p) * width * (high - mode));
    }
    bool operator==(const Triangular&) const = default;
};

}  // namespace gearpod::mc
