#include "signals/spectra/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>

namespace gearpod::signals {
namespace {

using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

// Largest distance, in samples, at which a grid point counts as being on a sample.
constexpr double kOnSample = 1e-6;

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

OrderTracking::OrderTracking(std::vector<double> phase) : phase_(std::move(phase)) {
    if (phase_.size() < 2 ||
        !std::is_sorted(phase_.begin(), phase_.end(), [](double a, double b) { return a <= b; })) {
        throw std::invalid_argument("order tracking: the phase must rise from sample to sample");
    }
}

int OrderTracking::meshes(int per_mesh) const {
    const double points = std::floor((phase_.back() - phase_.front()) * per_mesh + 1e-6) + 1.0;
    const double meshes = std::floor(points / per_mesh);
    return meshes < std::numeric_limits<int>::max() ? static_cast<int>(meshes)
                                                    : std::numeric_limits<int>::max();
}

std::vector<double> OrderTracking::resample(std::span<const double> signal, int per_mesh,
                                            int meshes) const {
    if (signal.size() != phase_.size() || meshes > this->meshes(per_mesh)) {
        throw std::invalid_argument("order tracking: the recording is too short");
    }
    std::unique_ptr<Spline> spline;
    std::vector<double> resampled(static_cast<std::size_t>(meshes) *
                                  static_cast<std::size_t>(per_mesh));
    std::size_t next = 1;  // first sample at or after the grid point, or the last sample
    for (std::size_t i = 0; i < resampled.size(); ++i) {
        const double grid_phase = phase_.front() + static_cast<double>(i) / per_mesh;
        while (next + 1 < phase_.size() && phase_[next] < grid_phase) {
            ++next;
        }
        const double step = phase_[next] - phase_[next - 1];
        const double position =
            static_cast<double>(next - 1) + std::min((grid_phase - phase_[next - 1]) / step, 1.0);
        const double nearest = std::rint(position);
        if (std::abs(position - nearest) < kOnSample) {
            resampled[i] = signal[static_cast<std::size_t>(nearest)];
            continue;
        }
        if (!spline) {
            spline = std::make_unique<Spline>(signal.begin(), signal.end(), 0.0, 1.0);
        }
        resampled[i] = (*spline)(position);
    }
    return resampled;
}

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
