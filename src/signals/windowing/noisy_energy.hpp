// Energy of a window, or of a bin, of signal plus noise.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::signals {

// signal + 2 sigma cross + sigma^2 noise. Apart from rounding, cross^2 <= signal * noise, so that
// the sum is not negative; negative values are set to 0.
GEARPOD_INLINE double noisy_energy(double sigma, double signal, double cross, double noise) {
    const double energy = std::fma(sigma * sigma, noise, std::fma(2.0 * sigma, cross, signal));
    return energy < 0.0 ? 0.0 : energy;
}

}  // namespace gearpod::signals
