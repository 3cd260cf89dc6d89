#include "signals/spectra/mesh_separation.hpp"

#include <cmath>
#include <stdexcept>

namespace gearpod::signals {
namespace {

int checked(int points, int teeth) {
    if (teeth < 3 || points < 4 * teeth) {
        throw std::invalid_argument(
            "mesh separation: needs three or more teeth and four samples a tooth");
    }
    return points;
}

}  // namespace

MeshSeparation::MeshSeparation(int points, int teeth)
    : forward_(checked(points, teeth)),
      backward_(points, FourierTransform::Direction::back),
      kind_(static_cast<std::size_t>(points) / 2 + 1, Kind::other),
      teeth_(teeth) {
    const auto n = static_cast<std::size_t>(points);
    for (std::size_t k = 1; 2 * k <= n; ++k) {
        const auto mesh = static_cast<std::size_t>(teeth);
        if (k % mesh == 0) {
            kind_[k] = Kind::harmonic;
        } else if (k + 1 >= mesh && (k % mesh == 1 || k % mesh == mesh - 1)) {
            kind_[k] = Kind::sideband;
        }
    }
    for (auto* buffer : {&spectrum_, &part_, &back_}) {
        buffer->resize(n);
    }
    for (auto* signal : {&regular_, &residual_, &difference_, &envelope_}) {
        signal->resize(n);
    }
    amplitude_.resize(kind_.size());
}

void MeshSeparation::load(std::span<const double> turn) {
    const std::size_t n = regular_.size();
    if (turn.size() != n) {
        throw std::invalid_argument("mesh separation: the turn has another number of samples");
    }
    for (std::size_t i = 0; i < n; ++i) {
        part_[i] = turn[i];
    }
    forward_.transform(part_, spectrum_);
    const double scale = 1.0 / static_cast<double>(n);
    for (std::size_t k = 0; k < kind_.size(); ++k) {
        const bool paired = k != 0 && 2 * k != n;
        amplitude_[k] = (paired ? 2.0 : 1.0) * scale * std::abs(spectrum_[k]);
    }
    // Harmonics in the real part and sidebands in the imaginary part share one inverse transform,
    // because both are real signals.
    const std::complex<double> i_unit(0.0, 1.0);
    for (std::size_t k = 0; k < n; ++k) {
        const Kind kind = kind_[std::min(k, n - k)];
        part_[k] = kind == Kind::harmonic   ? spectrum_[k]
                   : kind == Kind::sideband ? i_unit * spectrum_[k]
                                            : 0.0;
    }
    backward_.transform(part_, back_);
    const double mean = scale * spectrum_[0].real();
    for (std::size_t i = 0; i < n; ++i) {
        const double harmonics = scale * back_[i].real();
        const double sidebands = scale * back_[i].imag();
        regular_[i] = harmonics + sidebands;
        residual_[i] = turn[i] - mean - harmonics;
        difference_[i] = residual_[i] - sidebands;
    }
    // Analytic signal of the band: positive orders only, doubled.
    const int half = (teeth_ - 1) / 2;
    std::fill(part_.begin(), part_.end(), 0.0);
    for (int k = teeth_ - half; k <= teeth_ + half && 2 * k < points(); ++k) {
        part_[static_cast<std::size_t>(k)] = 2.0 * scale * spectrum_[static_cast<std::size_t>(k)];
    }
    backward_.transform(part_, back_);
    for (std::size_t i = 0; i < n; ++i) {
        envelope_[i] = std::abs(back_[i]);
    }
}

}  // namespace gearpod::signals
