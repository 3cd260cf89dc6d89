#include "signals/demodulation/cyclic_coherence.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastPower = 1e-12;  // of the strongest band's; less is rounding
constexpr std::size_t kFramesPerMesh = 4;

using Complex = std::complex<double>;

double turn_angle(std::size_t i, std::size_t points) {
    return 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
}

// Sums over the frames of one band.
struct BandSums {
    Complex cross = 0.0;                   // X Y*
    double original = 0.0, shifted = 0.0;  // |X|^2, |Y|^2
};

}  // namespace

double cyclic_coherence(std::span<const double> x, std::size_t turn, std::size_t points) {
    std::vector<double> window(points);
    for (std::size_t i = 0; i < points; ++i) {
        window[i] = 0.5 - 0.5 * std::cos(turn_angle(i, points));
    }
    std::vector<Complex> carrier(turn);
    for (std::size_t i = 0; i < turn; ++i) {
        carrier[i] = std::polar(1.0, turn_angle(i, turn));
    }
    FourierTransform transform(static_cast<int>(points));
    std::vector<Complex> frame(points), shifted(points), spectrum(points), other(points);
    std::vector<BandSums> bands((points + 1) / 2);  // 0 is not used
    for (std::size_t k = 0; k < kFramesPerMesh * (x.size() / points); ++k) {
        for (std::size_t i = 0; i < points; ++i) {
            const std::size_t at = (k * points / kFramesPerMesh + i) % x.size();
            frame[i] = window[i] * x[at];
            shifted[i] = frame[i] * carrier[at % turn];
        }
        transform.transform(frame, spectrum);
        transform.transform(shifted, other);
        for (std::size_t m = 1; m < bands.size(); ++m) {
            bands[m].cross += spectrum[m] * std::conj(other[m]);
            bands[m].original += std::norm(spectrum[m]);
            bands[m].shifted += std::norm(other[m]);
        }
    }
    double strongest = 0.0;
    for (const BandSums& band : bands) {
        strongest = std::max(strongest, band.original);
    }
    double sum = 0.0, used = 0.0;
    for (const BandSums& band : bands) {
        if (band.original > kLeastPower * strongest) {
            sum += std::norm(band.cross) / (band.original * band.shifted);
            used += 1.0;
        }
    }
    return sum / used;
}

}  // namespace gearpod::signals
