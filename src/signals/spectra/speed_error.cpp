#include "signals/spectra/speed_error.hpp"

#include <complex>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

std::vector<double> speed_error(std::span<const double> turn) {
    const std::size_t n = turn.size();
    std::vector<std::complex<double>> values(turn.begin(), turn.end()), spectrum(n);
    FourierTransform(static_cast<int>(n)).transform(values, spectrum);
    for (std::size_t k = 0; k < n; ++k) {
        const double order = 2 * k == n  ? 0.0
                             : 2 * k < n ? static_cast<double>(k)
                                         : static_cast<double>(k) - static_cast<double>(n);
        spectrum[k] *= std::complex<double>(0.0, order);
    }
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> speed(n);
    for (std::size_t i = 0; i < n; ++i) {
        speed[i] = values[i].real() / static_cast<double>(n);
    }
    return speed;
}

}  // namespace gearpod::signals
