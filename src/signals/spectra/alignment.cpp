#include "signals/spectra/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

// Fraction of the mean's energy. A signal that varies less is constant apart from rounding.
constexpr double kRounding = 1e-24;

using Spectrum = std::vector<std::complex<double>>;

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

// Phase by which a shift turns order k of n. Whole samples turn it by whole parts of n, exactly.
std::complex<double> turn_of(std::size_t k, std::size_t n, const Shift& shift) {
    const auto count = static_cast<long>(n);
    const long part = static_cast<long>(k) * (shift.samples % count) % count;
    const double turns = static_cast<double>(part) / static_cast<double>(n);
    return std::polar(1.0, 2.0 * std::numbers::pi * turns + angle_of(k, n) * shift.fraction);
}

// First and second derivative of the correlation at a shift, from the product of both spectra.
struct CorrelationDerivatives {
    double slope = 0.0, bend = 0.0;
};
CorrelationDerivatives correlation_derivatives(const Spectrum& product, const Shift& shift) {
    CorrelationDerivatives derivatives;
    const std::size_t n = product.size();
    for (std::size_t k = 1; 2 * k < n; ++k) {
        const double angle = angle_of(k, n);
        const std::complex<double> turned = product[k] * turn_of(k, n, shift);
        derivatives.slope -= angle * turned.imag();
        derivatives.bend -= angle * angle * turned.real();
    }
    return derivatives;
}

// Refines the sample with the largest correlation to the peak near it by Newton's method.
Shift peak_near(const Spectrum& product, long sample) {
    Shift shift{sample, 0.0};
    for (int round = 0; round < 8; ++round) {
        const CorrelationDerivatives derivatives = correlation_derivatives(product, shift);
        if (!(derivatives.bend < 0.0)) {
            return {sample, 0.0};
        }
        const double step = -derivatives.slope / derivatives.bend;
        shift.fraction += step;
        if (std::abs(shift.fraction) > 1.0) {
            return {sample, 0.0};
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
    const Spectrum spectrum = spectrum_of(signal);
    double energy = 0.0, other_energy = 0.0;
    const double least = kRounding * std::norm(spectrum[0]),
                 other_least = kRounding * std::norm(product[0]);
    product[0] = 0.0;
    for (std::size_t k = 1; k < n; ++k) {
        energy += std::norm(spectrum[k]);
        other_energy += std::norm(product[k]);
        product[k] *= std::conj(spectrum[k]);
    }
    if (!(energy > least && other_energy > other_least)) {
        return {};
    }
    Spectrum correlations(n);
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(product, correlations);
    const auto largest = std::ranges::max_element(
        correlations, [](const auto& a, const auto& b) { return a.real() < b.real(); });
    const Shift shift = peak_near(product, largest - correlations.begin());
    double sum = 0.0;
    for (std::size_t k = 1; k < n; ++k) {
        sum += (product[k] * turn_of(k, n, shift)).real();
    }
    return {shift, sum / std::sqrt(energy * other_energy)};
}

double correlation(std::span<const double> signal, std::span<const double> other) {
    check_equal_sizes(signal, other);
    const auto mean = [](std::span<const double> values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    };
    const double a = mean(signal), b = mean(other);
    double both = 0.0, energy = 0.0, others = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        both += (signal[i] - a) * (other[i] - b);
        energy += (signal[i] - a) * (signal[i] - a);
        others += (other[i] - b) * (other[i] - b);
    }
    return energy > 0.0 && others > 0.0 ? both / std::sqrt(energy * others) : 0.0;
}

std::vector<double> shifted(std::span<const double> periodic, const Shift& shift) {
    const std::size_t n = periodic.size();
    Spectrum spectrum = spectrum_of(periodic);
    for (std::size_t k = 1; k < n; ++k) {
        const std::complex<double> turn = turn_of(k, n, shift);
        // The component at half the sampling rate is a cosine and stays real.
        spectrum[k] *= 2 * k == n ? turn.real() : turn;
    }
    return signal_of(spectrum);
}

}  // namespace gearpod::signals
