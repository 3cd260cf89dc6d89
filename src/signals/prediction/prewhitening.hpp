// Cepstral pre-whitening: P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi and R. Ricci,
// Mech. Syst. Signal Process. 36 (2013) 370-384.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Holds the transforms of one length: use one object per thread.
class Prewhitening {
  public:
    // `points` is the number of samples.
    explicit Prewhitening(int points);

    int points() const { return forward_.points(); }

    // Signal with the same phase spectrum and unit magnitudes: x_w = IDFT(X / |X|), which sets the
    // real cepstrum to zero except at zero quefrency. Mesh lines and resonances lose their
    // dominance, and impulses remain. Orders below 1e-12 of the largest magnitude, and the mean,
    // become 0. Throws std::invalid_argument unless there are points() samples.
    std::vector<double> whitened(std::span<const double> samples);

  private:
    FourierTransform forward_, backward_;
    std::vector<std::complex<double>> values_, spectrum_;
};

}  // namespace gearpod::signals
