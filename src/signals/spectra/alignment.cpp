#include "signals/spectra/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

// Fraction of the mean's energy. A signal that varies less is constant apart from rounding.
constexpr double kRounding = 1e-24;

using Spectrum = std::vector<std::complex<double>>;

Spectrum spectrum_of(std::span<const double> signal) {
    const Spectrum values(signal.begin(), signal.end());
    Spectrum spectrum(signal.size());
    FourierTransform(static_cast<int>(signal.size())).transform(values, spectrum);
    return spectrum;
}

void check_equal_sizes(std::span<const double> signal, std::span<const double> other) {
    if (signal.empty() || signal.size() != other.size()) {
        throw std::invalid_argument("alignment: two signals of as many samples are needed");
    }
}

// Angle per sample of order k of n, negative for the upper half.
double angle_of(std::size_t k, std::size_t n) {
    const double order =
        2 * k > n ? static_cast<double>(k) - static_cast<double>(n) : static_cast<double>(k);
    return 2.0 * std::numbers::pi * order / static_cast<double>(n);
}

// First and second derivative of the correlation at a shift, from the product of both spectra.
struct CorrelationDerivatives {
    double slope = 0.0, bend = 0.0;
};
CorrelationDerivatives correlation_derivatives(const Spectrum& product, double shift) {
    CorrelationDerivatives at;
    const std::size_t n = product.size();
    for (std::size_t k = 1; 2 * k < n; ++k) {
        const double angle = angle_of(k, n);
        const std::complex<double> turned = product[k] * std::polar(1.0, angle * shift);
        at.slope -= angle * turned.imag();
        at.bend -= angle * angle * turned.real();
    }
    return at;
}

// Refines the sample with the largest correlation to the peak near it by Newton's method.
double peak_near(const Spectrum& product, double sample) {
    double shift = sample;
    for (int round = 0; round < 8; ++round) {
        const CorrelationDerivatives at = correlation_derivatives(product, shift);
        if (!(at.bend < 0.0)) {
            return sample;
        }
        const double step = -at.slope / at.bend;
        shift += step;
        if (std::abs(shift - sample) > 1.0) {
            return sample;
        }
        if (std::abs(step) < 1e-9) {
            break;
        }
    }
    return shift;
}

}  // namespace

Alignment align(std::span<const double> signal, std::span<const double> other) {
    check_equal_sizes(signal, other);
    const std::size_t n = signal.size();
    Spectrum product = spectrum_of(other);
    const Spectrum own = spectrum_of(signal);
    double energy = 0.0, other_energy = 0.0;
    const double least = kRounding * std::norm(own[0]),
                 other_least = kRounding * std::norm(product[0]);
    product[0] = 0.0;
    for (std::size_t k = 1; k < n; ++k) {
        energy += std::norm(own[k]);
        other_energy += std::norm(product[k]);
        product[k] *= std::conj(own[k]);
    }
    if (!(energy > least && other_energy > other_least)) {
        return {};
    }
    Spectrum correlations(n);
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(product, correlations);
    const auto largest =
        std::max_element(correlations.begin(), correlations.end(),
                         [](const auto& a, const auto& b) { return a.real() < b.real(); });
    const double shift = peak_near(product, static_cast<double>(largest - correlations.begin()));
    double sum = 0.0;
    for (std::size_t k = 1; k < n; ++k) {
        sum += (product[k] * std::polar(1.0, angle_of(k, n) * shift)).real();
    }
    const auto period = static_cast<double>(n);
    return {shift - period * std::floor(shift / period), sum / std::sqrt(energy * other_energy)};
}

double correlation(std::span<const double> signal, std::span<const double> other) {
    check_equal_sizes(signal, other);
    const auto mean = [](std::span<const double> values) {
        double sum = 0.0;
        for (const double value : values) {
            sum += value;
        }
        return sum / static_cast<double>(values.size());
    };
    const double a = mean(signal), b = mean(other);
    double both = 0.0, own = 0.0, others = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        both += (signal[i] - a) * (other[i] - b);
        own += (signal[i] - a) * (signal[i] - a);
        others += (other[i] - b) * (other[i] - b);
    }
    return own > 0.0 && others > 0.0 ? both / std::sqrt(own * others) : 0.0;
}

std::vector<double> shifted(std::span<const double> periodic, double shift) {
    const std::size_t n = periodic.size();
    Spectrum spectrum = spectrum_of(periodic), values(n);
    for (std::size_t k = 1; k < n; ++k) {
        const double angle = angle_of(k, n) * shift;
        // The component at half the sampling rate is a cosine and stays real.
        spectrum[k] *= 2 * k == n ? std::cos(angle) : std::polar(1.0, angle);
    }
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i) {
        result[i] = values[i].real() / static_cast<double>(n);
    }
    return result;
}

}  // namespace gearpod::signals
