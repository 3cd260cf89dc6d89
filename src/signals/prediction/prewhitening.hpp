// Cepstral pre-whitening: P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi and R. Ricci,
// Mech. Syst. Signal Process. 36 (2013) 370-384.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Signal with the same phase spectrum and unit magnitudes: x_w = IDFT(X / |X|), which sets the real
// cepstrum to zero except at zero quefrency. Mesh lines and resonances lose their dominance, and
// impulses remain. Orders below 1e-12 of the largest magnitude, and the mean, become 0.
std::vector<double> prewhitened(std::span<const double> samples);

}  // namespace gearpod::signals
