#include "signals/spectra/periodic_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace gearpod::signals {
namespace {

constexpr std::size_t kDenser = 4;
// Dense samples repeated before and after the period, within which the ends of the spline lose
// their influence: it decays by a factor of 3.7 per sample.
constexpr std::size_t kMargin = 32;

int at_least_four(int samples) {
    if (samples < 4) {
        throw std::invalid_argument("periodic interpolation: needs at least 4 samples");
    }
    return samples;
}

}  // namespace

double PeriodicSpline::operator()(double position) const {
    return spline_(position - samples_ * std::floor(position / samples_));
}

PeriodicInterpolation::PeriodicInterpolation(int samples)
    : forward_(at_least_four(samples)),
      back_(static_cast<int>(kDenser) * samples, FourierTransform::Direction::back),
      spectrum_(static_cast<std::size_t>(samples)),
      dense_spectrum_(kDenser * spectrum_.size()),
      dense_(dense_spectrum_.size()) {}

PeriodicSpline PeriodicInterpolation::spline(std::span<const double> period) {
    const std::size_t n = spectrum_.size(), all = dense_.size();
    if (period.size() != n) {
        throw std::invalid_argument("periodic interpolation: the period has another length");
    }
    values_.assign(period.begin(), period.end());
    forward_.transform(values_, spectrum_);
    std::ranges::fill(dense_spectrum_, 0.0);
    for (std::size_t k = 0; 2 * k <= n; ++k) {
        const double share = (2 * k == n ? 0.5 : 1.0) / static_cast<double>(n);
        dense_spectrum_[k] = share * spectrum_[k];
        if (k > 0) {
            dense_spectrum_[all - k] = share * spectrum_[n - k];
        }
    }
    back_.transform(dense_spectrum_, dense_);
    std::vector<double> repeated(all + 2 * kMargin + 1);
    for (std::size_t i = 0; i < repeated.size(); ++i) {
        repeated[i] = dense_[(i + all * kMargin - kMargin) % all].real();
    }
    return {static_cast<double>(n),
            PeriodicSpline::Spline(repeated.begin(), repeated.end(),
                                   -static_cast<double>(kMargin) / kDenser, 1.0 / kDenser)};
}

}  // namespace gearpod::signals
