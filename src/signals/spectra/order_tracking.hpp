// Order tracking: resamples a signal sampled evenly in time to an even grid of mesh phase.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Mesh phases of the samples of a recording. Between samples the phase is linear and a signal is
// its cubic B-spline interpolant. The interpolation error grows with the fourth power of the
// frequency: 5e-4 of a sine at a tenth of the sampling rate, 1e-2 at a fifth (Unser, Aldroubi and
// Eden, IEEE Trans. Signal Process. 41 (1993) 821). It is larger within a few samples of the ends.
// Grid points that fall on a sample take its value.
class OrderTracking {
  public:
    // `phase`: mesh phase of every sample, in mesh periods. Throws std::invalid_argument unless it
    // has two or more values and increases strictly.
    explicit OrderTracking(std::vector<double> phase);

    // Number of whole mesh periods that the recording covers on a grid of `per_mesh` points per
    // mesh.
    int meshes(int per_mesh) const;

    // Signal at phases phase[0] + i / per_mesh, i < meshes * per_mesh. Throws std::invalid_argument
    // if the signal or the recording is too short.
    std::vector<double> resample(std::span<const double> signal, int per_mesh, int meshes) const;

  private:
    std::vector<double> phase_;
};

}  // namespace gearpod::signals
