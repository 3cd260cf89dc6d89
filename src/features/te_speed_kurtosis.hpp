// Kurtosis, normal = 3, of the speed error: the derivative of the averaged transmission error over
// the n samples of a planet turn,
//
//     v(t) = IDFT(i k TE_k),   |k| < n / 2,
//
// in rad per radian of the turn at constant mean speed. It is the jitter of the instantaneous
// angular speed that encoders show: Y. Li et al., Mech. Syst. Signal Process. 19 (2005) 786-805. A
// tooth fault changes the speed where the load passes to and from the tooth; the derivative weights
// these short changes more than te_kurtosis.hpp. NaN for a constant transmission error.
#pragma once

#include <complex>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"
#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::features {

inline double te_speed_kurtosis(const TeParts& te) {
    const std::size_t n = te.turn.size();
    std::vector<std::complex<double>> values(te.turn.begin(), te.turn.end()), spectrum(n);
    signals::FourierTransform(static_cast<int>(n)).transform(values, spectrum);
    for (std::size_t k = 0; k < n; ++k) {
        const double order = 2 * k == n  ? 0.0
                             : 2 * k < n ? static_cast<double>(k)
                                         : static_cast<double>(k) - static_cast<double>(n);
        spectrum[k] *= std::complex<double>(0.0, order);
    }
    signals::FourierTransform(static_cast<int>(n), signals::FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> speed(n);
    for (std::size_t i = 0; i < n; ++i) {
        speed[i] = values[i].real();
    }
    return standardised_moment(speed, 4);
}

}  // namespace gearpod::features
