#include "signals/prediction/toeplitz.hpp"

#include <complex>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr double kWhiteNoiseCorrection = 1e-9;

using Spectrum = std::vector<std::complex<double>>;

Spectrum spectrum_of(std::span<const double> values, std::size_t points) {
    Spectrum padded(values.begin(), values.end()), spectrum(points);
    padded.resize(points);
    FourierTransform(static_cast<int>(points)).transform(padded, spectrum);
    return spectrum;
}

std::vector<double> signal_of(const Spectrum& spectrum, std::size_t count) {
    const std::size_t n = spectrum.size();
    Spectrum values(n);
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> signal(count);
    for (std::size_t i = 0; i < count; ++i) {
        signal[i] = values[i].real() / static_cast<double>(n);
    }
    return signal;
}

}  // namespace

std::vector<double> corrected_autocorrelation(std::span<const double> signal, std::size_t lags) {
    const std::size_t n = signal.size();
    Spectrum spectrum = spectrum_of(signal, n);
    for (auto& value : spectrum) {
        value = std::norm(value) / static_cast<double>(n);
    }
    std::vector<double> r = signal_of(spectrum, lags);
    r[0] *= 1.0 + kWhiteNoiseCorrection;
    return r;
}

std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b) {
    // `predictor`: 1, a_1, ..., a_m of the prediction error filter of order m.
    std::vector<double> predictor{1.0}, solution{b[0] / r[0]};
    double error = r[0];
    for (std::size_t m = 1; m < r.size(); ++m) {
        double mismatch = 0.0;
        for (std::size_t j = 0; j < m; ++j) {
            mismatch += predictor[j] * r[m - j];
        }
        const double reflection = -mismatch / error;
        std::vector<double> next(m + 1, 0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            next[j] = (j < m ? predictor[j] : 0.0) + (j > 0 ? reflection * predictor[m - j] : 0.0);
        }
        predictor = std::move(next);
        error *= 1.0 - reflection * reflection;
        double remainder = b[m];
        for (std::size_t j = 0; j < m; ++j) {
            remainder -= r[m - j] * solution[j];
        }
        solution.push_back(0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            solution[j] += remainder / error * predictor[m - j];
        }
    }
    return solution;
}

std::vector<double> circular_filter(std::span<const double> filter,
                                    std::span<const double> signal) {
    const std::size_t n = signal.size();
    Spectrum product = spectrum_of(signal, n);
    const Spectrum response = spectrum_of(filter, n);
    for (std::size_t k = 0; k < n; ++k) {
        product[k] *= response[k];
    }
    return signal_of(product, n);
}

std::vector<double> circular_correlation(std::span<const double> x, std::span<const double> y,
                                         std::size_t lags) {
    const std::size_t n = x.size();
    Spectrum product = spectrum_of(y, n);
    const Spectrum other = spectrum_of(x, n);
    for (std::size_t k = 0; k < n; ++k) {
        product[k] *= std::conj(other[k]) / static_cast<double>(n);
    }
    return signal_of(product, lags);
}

}  // namespace gearpod::signals
