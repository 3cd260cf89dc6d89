// Speed error: derivative of the averaged transmission error with respect to the angle of the turn.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// With n samples of a turn and their Fourier transform TE_k,
//
//     v(t) = IDFT(i k TE_k),   |k| < n / 2,
//
// in rad per radian of the turn. The length of `turn` is the length of the result.
std::vector<double> speed_error(std::span<const double> turn);

}  // namespace gearpod::signals
