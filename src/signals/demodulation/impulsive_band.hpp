// Squared envelope of a signal in its most impulsive frequency band, after the kurtogram of J.
// Antoni, Mech. Syst. Signal Process. 21 (2007) 108-124.
//
// Candidate bands are 1, 2, 4 or 8 mesh orders wide, side by side from half a mesh order to the
// Nyquist order, so that no mesh line is at an edge. They take the place of the tree of filters
// there. With b the analytic signal of a band, ideal in frequency over the periodic record, the
// chosen band has the largest kurtosis
//
//     K = <|b|^4> / <|b|^2>^2 - 2,
//
// 0 for stationary Gaussian noise. Of equal bands it is the first, narrow before wide.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::signals {

// |b|^2 over the record, (m/s^2)^2, with two values per order of the band. `samples` holds whole
// mesh periods of `per_mesh` samples, at least four. Empty if no band has more than 1e-12 of the
// mean square of the samples: these are rounding errors.
std::vector<double> most_impulsive_envelope(std::span<const double> samples, std::size_t per_mesh);

// Magnitudes of the Fourier transform of a squared envelope: [k] at k cycles per record.
std::vector<double> envelope_spectrum(std::span<const double> squared_envelope);

}  // namespace gearpod::signals
