#include "signals/prediction/deconvolution.hpp"

#include <cmath>
#include <numeric>

#include "signals/prediction/periodic_signal.hpp"
#include "signals/prediction/toeplitz.hpp"

namespace gearpod::signals {
namespace {

void scale_to_unit_rms(std::vector<double>& values) {
    const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    const double rms = std::sqrt(sum / static_cast<double>(values.size()));
    for (double& value : values) {
        value /= rms;
    }
}

}  // namespace

std::vector<double> deconvolve(std::span<const double> x, std::size_t length, int iterations) {
    PeriodicSignal signal(x);
    const std::vector<double> r = signal.corrected_autocorrelation(length);
    std::vector<double> impulse(length, 0.0);
    impulse[length / 2] = 1.0;
    std::vector<double> y = signal.filtered(impulse);
    for (int round = 0; round < iterations; ++round) {
        scale_to_unit_rms(y);
        for (double& value : y) {
            value = value * value * value;
        }
        y = signal.filtered(solve_toeplitz(r, signal.correlated(y, length)));
    }
    return y;
}

}  // namespace gearpod::signals
