#include "signals/spectra/speed_error.hpp"

#include <complex>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

std::vector<double> speed_error(std::span<const double> turn) {
    const std::size_t n = turn.size();
    std::vector<std::complex<double>> spectrum = spectrum_of(turn);
    for (std::size_t k = 0; k < n; ++k) {
        const double order = 2 * k == n  ? 0.0
                             : 2 * k < n ? static_cast<double>(k)
                                         : static_cast<double>(k) - static_cast<double>(n);
        spectrum[k] *= std::complex<double>(0.0, order);
    }
    return signal_of(spectrum);
}

}  // namespace gearpod::signals
