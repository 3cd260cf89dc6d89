#include "signals/chi_squared.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {
namespace {

constexpr double kRange = 8.3;
constexpr int kPieces = 128;
constexpr int kCoefficients = 10;
constexpr double kHalfWidth = kRange / kPieces;

using Coefficients = std::array<double, kCoefficients>;

double quantile_of_normal(const boost::math::chi_squared& chi, double z) {
    const double tail = 0.5 * std::erfc(std::abs(z) / std::numbers::sqrt2);
    return z < 0.0 ? boost::math::quantile(chi, tail)
                   : boost::math::quantile(boost::math::complement(chi, tail));
}

// Chebyshev interpolation at the roots, rewritten in powers of t.
Coefficients interpolate(const boost::math::chi_squared& chi, double centre) {
    Coefficients value{};
    for (int i = 0; i < kCoefficients; ++i) {
        const double t = std::cos(std::numbers::pi * (i + 0.5) / kCoefficients);
        value[i] = quantile_of_normal(chi, centre + kHalfWidth * t);
    }
    Coefficients powers{};
    Coefficients previous{};  // T_{k-1}, T_k in powers of t
    Coefficients current{};
    current[0] = 1.0;
    for (int k = 0; k < kCoefficients; ++k) {
        double sum = 0.0;
        for (int i = 0; i < kCoefficients; ++i) {
            sum += value[i] * std::cos(std::numbers::pi * k * (i + 0.5) / kCoefficients);
        }
        const double chebyshev = (k == 0 ? 1.0 : 2.0) * sum / kCoefficients;
        Coefficients next{};
        for (int power = 0; power < kCoefficients; ++power) {
            powers[power] += chebyshev * current[power];
            if (power + 1 < kCoefficients) {
                next[power + 1] = (k == 0 ? 1.0 : 2.0) * current[power];
            }
        }
        for (int power = 0; power < kCoefficients; ++power) {
            next[power] -= previous[power];
        }
        previous = current;
        current = next;
    }
    return powers;
}

}  // namespace

ChiSquaredTransform::ChiSquaredTransform(int degrees) {
    if (degrees < 2) {
        throw std::invalid_argument("chi-squared transform: needs two or more degrees of freedom");
    }
    const boost::math::chi_squared chi(degrees);
    for (int piece = 0; piece < kPieces; ++piece) {
        const Coefficients c = interpolate(chi, -kRange + (2 * piece + 1) * kHalfWidth);
        coefficients_.insert(coefficients_.end(), c.begin(), c.end());
    }
}

double ChiSquaredTransform::operator()(double z) const {
    const double place = (std::clamp(z, -kRange, kRange) + kRange) / (2.0 * kHalfWidth);
    const int piece = std::min(static_cast<int>(place), kPieces - 1);
    const double t = 2.0 * (place - piece) - 1.0;
    const double* c = coefficients_.data() + static_cast<std::ptrdiff_t>(piece) * kCoefficients;
    double sum = c[kCoefficients - 1];
    for (int power = kCoefficients - 2; power >= 0; --power) {
        sum = sum * t + c[power];
    }
    return sum;
}

void ChiSquaredTransform::from_normal(std::span<double> values) const {
    for (double& value : values) {
        value = (*this)(value);
    }
}

}  // namespace gearpod::signals
