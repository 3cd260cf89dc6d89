// Amplitude and phase modulation of the strongest mesh harmonic by narrow-band demodulation of the
// averaged sensor signal: P. D. McFadden, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 165-170.
//
// The carrier is the mesh harmonic j Z_p with the largest amplitude A. The band around it holds the
// orders j Z_p - h to j Z_p + h, h = (Z_p - 1) / 2 rounded down: the harmonic with all its
// sidebands. Its analytic signal, divided by that of the carrier, is
//
//     b(t) = (1 + a(t)) exp(i phi(t)) A'.
//
//     amplitude_modulation  largest magnitude of |b| / mean(|b|) - 1
//     phase_modulation      peak-to-peak of the unwrapped phase of b, rad
//
// A cracked tooth delays the mesh for one tooth and shows as a dip of both. Harmonics whose band
// exceeds the Nyquist order are not used. NaN if no harmonic is above rounding errors.
#pragma once

#include <complex>
#include <vector>

#include "features/signals.hpp"

namespace gearpod::features {

// b(t), one value per sample of the turn. Empty if there is no mesh line.
std::vector<std::complex<double>> demodulated_mesh(const SensorTurn& sensor);

double amplitude_modulation(const SensorTurn& sensor);
double phase_modulation(const SensorTurn& sensor);

}  // namespace gearpod::features
