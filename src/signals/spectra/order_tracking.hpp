// Order tracking: a signal sampled evenly in time, resampled evenly in mesh phase.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Where the samples of a recording lie in mesh phase. Between samples the phase is linear and a
// signal is its cubic B-spline interpolant, whose error grows with the fourth power of the
// frequency: 5e-4 of a sine at a tenth of the sampling rate, 1e-2 at a fifth (Unser, Aldroubi and
// Eden, IEEE Trans. Signal Process. 41 (1993) 821), more within a few samples of the ends. Grid
// points that fall on a sample take it as it is.
class OrderTracking {
  public:
    // `phase`: of every sample, in mesh periods. Throws std::invalid_argument unless it has two or
    // more values and rises from sample to sample.
    explicit OrderTracking(std::vector<double> phase);

    // Whole mesh periods for which the recording has samples on a grid of `per_mesh` points.
    int meshes(int per_mesh) const;

    // The signal at phases phase[0] + i / per_mesh, i < meshes * per_mesh. Throws
    // std::invalid_argument if the signal or the recording is too short.
    std::vector<double> resample(std::span<const double> signal, int per_mesh, int meshes) const;

  private:
    std::vector<double> phase_;
};

}  // namespace gearpod::signals
