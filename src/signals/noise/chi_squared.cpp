#include "signals/noise/chi_squared.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {
namespace {

// Boost's quantile costs microseconds. It is evaluated for few, wide pieces of high degree, from
// which the narrow pieces are interpolated.
constexpr int kWidePieces = 128;
constexpr int kWidePowers = 10;
constexpr int kNarrowInWide = kChiPieces / kWidePieces;

double quantile_of_normal(const boost::math::chi_squared& chi, double z) {
    const double tail = 0.5 * std::erfc(std::abs(z) / std::numbers::sqrt2);
    return z < 0.0 ? boost::math::quantile(chi, tail)
                   : boost::math::quantile(boost::math::complement(chi, tail));
}

// values[k][i] is the Chebyshev polynomial T_k at the i-th root of T_kPowers.
template <int kPowers>
const auto& polynomials_at_roots() {
    static const auto values = [] {
        std::array<std::array<double, kPowers>, kPowers> powers{};
        for (int k = 0; k < kPowers; ++k) {
            for (int i = 0; i < kPowers; ++i) {
                powers[k][i] = std::cos(std::numbers::pi * k * (i + 0.5) / kPowers);
            }
        }
        return powers;
    }();
    return values;
}

// Coefficients, by power of t, of the Chebyshev interpolant of `function` on [-1, 1].
template <int kPowers, typename Function>
std::array<double, kPowers> interpolate(Function function) {
    using Powers = std::array<double, kPowers>;
    const auto& at_root = polynomials_at_roots<kPowers>();
    Powers value{};
    for (int i = 0; i < kPowers; ++i) {
        value[i] = function(at_root[1][i]);
    }
    Powers powers{};
    Powers previous{};  // T_{k-1}, T_k in powers of t
    Powers current{};
    current[0] = 1.0;
    for (int k = 0; k < kPowers; ++k) {
        double sum = 0.0;
        for (int i = 0; i < kPowers; ++i) {
            sum += value[i] * at_root[k][i];
        }
        const double chebyshev = (k == 0 ? 1.0 : 2.0) * sum / kPowers;
        Powers next{};
        for (int power = 0; power < kPowers; ++power) {
            powers[power] += chebyshev * current[power];
            if (power + 1 < kPowers) {
                next[power + 1] = (k == 0 ? 1.0 : 2.0) * current[power];
            }
        }
        for (int power = 0; power < kPowers; ++power) {
            next[power] -= previous[power];
        }
        previous = current;
        current = next;
    }
    return powers;
}

template <std::size_t kPowers>
double evaluate(const std::array<double, kPowers>& powers, double t) {
    double sum = 0.0;
    for (std::size_t power = kPowers; power-- > 0;) {
        sum = sum * t + powers[power];
    }
    return sum;
}

}  // namespace

ChiSquaredTransform::ChiSquaredTransform(int degrees)
    : pieces_(static_cast<std::size_t>(kChiPieces) * kChiStride) {
    if (degrees < 2) {
        throw std::invalid_argument("chi-squared transform: needs two or more degrees of freedom");
    }
    const boost::math::chi_squared chi(degrees);
    constexpr double kHalfWidth = kChiRange / kWidePieces;
    double* piece = pieces_.data();
    for (int wide = 0; wide < kWidePieces; ++wide) {
        const double centre = -kChiRange + (2 * wide + 1) * kHalfWidth;
        const auto powers = interpolate<kWidePowers>(
            [&](double t) { return quantile_of_normal(chi, centre + kHalfWidth * t); });
        for (int narrow = 0; narrow < kNarrowInWide; ++narrow, piece += kChiStride) {
            const auto series = interpolate<kChiPowers>([&](double t) {
                return evaluate(powers, (2 * narrow + 1 + t) / kNarrowInWide - 1.0);
            });
            std::copy(series.begin(), series.end(), piece);
        }
    }
}

void ChiSquaredTransform::from_normal(std::span<double> values) const {
    chi_squared_values(static_cast<long>(values.size()), pieces_.data(), values.data());
}

}  // namespace gearpod::signals
