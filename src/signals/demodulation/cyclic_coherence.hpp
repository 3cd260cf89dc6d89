// Cyclic spectral coherence at one cycle per turn, averaged over the frequency bands f:
//
//     |gamma(f)|^2 = |<X_k(f) Y_k(f)*>|^2 / (<|X_k(f)|^2> <|Y_k(f)|^2>),
//
// where X_k are short-time Fourier transforms of the record x, and Y_k those of x exp(2 pi i t /
// T), T being the turn: Y(f) = X(f - 1/T). <> is the mean over the frames k. J. Antoni, Mech. Syst.
// Signal Process. 21 (2007) 597-630; 23 (2009) 987-1036. It is 1 if components 1/T apart are fully
// correlated, and 0 without modulation at the turn. An estimate from K independent frames is about
// 1/K above 0.
#pragma once

#include <cstddef>
#include <span>

namespace gearpod::signals {

// Mean of |gamma|^2 over the bands between zero and the Nyquist frequency with more than 1e-12 of
// the strongest band's power; NaN for a zero signal. Frames are one mesh period of `points` samples
// long, under a periodic Hann window, and overlap by three quarters. `x` holds whole turns of
// `turn` samples, and continues from its beginning after its end.
double cyclic_coherence(std::span<const double> x, std::size_t turn, std::size_t points);

}  // namespace gearpod::signals
