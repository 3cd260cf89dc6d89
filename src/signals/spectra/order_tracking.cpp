#include "signals/spectra/order_tracking.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace gearpod::signals {
namespace {

using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

// Largest distance, in samples, at which a grid point counts as being on a sample.
constexpr double kOnSample = 1e-6;

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
        const double place =
            static_cast<double>(next - 1) + std::min((grid_phase - phase_[next - 1]) / step, 1.0);
        const double nearest = std::rint(place);
        if (std::abs(place - nearest) < kOnSample) {
            resampled[i] = signal[static_cast<std::size_t>(nearest)];
            continue;
        }
        if (!spline) {
            spline = std::make_unique<Spline>(signal.begin(), signal.end(), 0.0, 1.0);
        }
        resampled[i] = (*spline)(place);
    }
    return resampled;
}

}  // namespace gearpod::signals
