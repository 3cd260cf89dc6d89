#include "signals/prediction/deconvolution.hpp"

#include <cmath>

#include "signals/prediction/toeplitz.hpp"

namespace gearpod::signals {
namespace {

void scale_to_unit_rms(std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value * value;
    }
    const double rms = std::sqrt(sum / static_cast<double>(values.size()));
    for (double& value : values) {
        value /= rms;
    }
}

}  // namespace

std::vector<double> deconvolve(std::span<const double> x, std::size_t length, int iterations) {
    const std::vector<double> r = corrected_autocorrelation(x, length);
    std::vector<double> impulse(length, 0.0);
    impulse[length / 2] = 1.0;
    std::vector<double> y = circular_filter(impulse, x);
    for (int round = 0; round < iterations; ++round) {
        scale_to_unit_rms(y);
        for (double& value : y) {
            value = value * value * value;
        }
        const std::vector<double> correlation = circular_correlation(x, y, length);
        y = circular_filter(solve_toeplitz(r, correlation), x);
    }
    return y;
}

}  // namespace gearpod::signals
