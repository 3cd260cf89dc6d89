// Narrow-band demodulation of the strongest mesh harmonic of an averaged turn: P. D. McFadden, J.
// Vib. Acoust. Stress Reliab. Des. 108 (1986) 165-170.
//
// The carrier is the mesh harmonic j T of a gear with T teeth that has the largest amplitude. The
// band around it holds the orders j T - h to j T + h, h = (T - 1) / 2 rounded down: the harmonic
// with all its sidebands. Its analytic signal, divided by exp(i j T t), is the modulation b(t).
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace gearpod::signals {

// b(t), one value per sample of `turn`. `amplitude` holds the turn's one-sided amplitudes by order.
// Harmonics whose band exceeds the Nyquist order are not used. Empty if no harmonic is above 1e-12
// of the sum of all amplitudes, the size of rounding errors.
std::vector<std::complex<double>> mesh_modulation(std::span<const double> turn,
                                                  std::span<const double> amplitude, int teeth);

}  // namespace gearpod::signals
