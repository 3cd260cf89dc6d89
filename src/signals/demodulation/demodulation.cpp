#include "signals/demodulation/demodulation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastMeshLine = 1e-12;  // of the sum of all amplitudes; less is rounding

// Mesh harmonic with the largest amplitude; 0 if none is above rounding.
std::size_t strongest_harmonic(std::span<const double> amplitude, std::size_t points,
                               std::size_t teeth, std::size_t half) {
    std::size_t strongest = 0;
    for (std::size_t k = teeth; 2 * (k + half) < points; k += teeth) {
        if (strongest == 0 || amplitude[k] > amplitude[strongest]) {
            strongest = k;
        }
    }
    const double sum = std::accumulate(amplitude.begin(), amplitude.end(), 0.0);
    return strongest > 0 && amplitude[strongest] > kLeastMeshLine * sum ? strongest : 0;
}

}  // namespace

std::vector<std::complex<double>> mesh_modulation(std::span<const double> turn,
                                                  std::span<const double> amplitude, int teeth) {
    const std::size_t n = turn.size();
    const auto half = static_cast<std::size_t>(teeth - 1) / 2;
    const std::size_t carrier =
        strongest_harmonic(amplitude, n, static_cast<std::size_t>(teeth), half);
    if (carrier == 0) {
        return {};
    }
    std::vector<std::complex<double>> band(n), spectrum = spectrum_of(turn);
    // The carrier's order becomes order 0.
    const double scale = 2.0 / static_cast<double>(n);
    for (std::size_t k = 0; k <= half; ++k) {
        band[k] = scale * spectrum[carrier + k];
        band[(n - k) % n] = scale * spectrum[carrier - k];
    }
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(band, spectrum);
    return spectrum;
}

namespace {

constexpr double kLeastBandPower = 1e-12;  // of the mean square of the samples

using Spectrum = std::vector<std::complex<double>>;
using Transform = FourierTransform;

// Squared envelope of bands of up to `orders` orders. It has at least two values per order, so that
// products of two orders are not aliased.
class SquaredEnvelope {
  public:
    SquaredEnvelope(std::span<const std::complex<double>> spectrum, std::size_t orders)
        : spectrum_(spectrum),
          transform_(smooth_length(static_cast<int>(2 * orders)), Transform::Direction::back),
          band_(static_cast<std::size_t>(transform_.points())),
          signal_(band_.size()),
          squares_(band_.size()) {}

    // Valid until the next call.
    std::span<const double> of(const KurtogramBand& band) {
        const double scale = 2.0 / static_cast<double>(spectrum_.size());
        std::fill(band_.begin(), band_.end(), 0.0);
        for (std::size_t j = 0; j < band.orders; ++j) {
            band_[j] = scale * spectrum_[band.first + j];
        }
        transform_.transform(band_, signal_);
        for (std::size_t i = 0; i < signal_.size(); ++i) {
            squares_[i] = std::norm(signal_[i]);
        }
        return squares_;
    }

  private:
    std::span<const std::complex<double>> spectrum_;
    Transform transform_;
    Spectrum band_, signal_;
    std::vector<double> squares_;
};

// Band i of n of a record of `points` samples.
KurtogramBand band_of(std::size_t i, std::size_t n, std::size_t points) {
    const std::size_t first = i * points / (2 * n) + 1;
    const std::size_t end = std::min((i + 1) * points / (2 * n), (points - 1) / 2) + 1;
    return {first, end - std::min(first, end)};
}

double mean_square(std::span<const double> samples) {
    return std::inner_product(samples.begin(), samples.end(), samples.begin(), 0.0) /
           static_cast<double>(samples.size());
}

}  // namespace

Kurtogram::Kurtogram(std::span<const double> samples, std::size_t most_bands)
    : spectrum_(spectrum_of(samples)) {
    const double power = mean_square(samples);
    // 1, 2, 3, 4, 6, 8, 12, ...: twice the number before the last one, from 4 on.
    for (std::size_t n = 1, next = 2; n <= most_bands;) {
        SquaredEnvelope envelope(spectrum_, samples.size() / (2 * n) + 1);
        for (std::size_t i = 0; i < n; ++i) {
            KurtogramBand band = band_of(i, n, samples.size());
            double mean = 0.0, fourth = 0.0;
            const std::span<const double> squares = envelope.of(band);
            for (const double square : squares) {
                mean += square;
                fourth += square * square;
            }
            mean /= static_cast<double>(squares.size());
            fourth /= static_cast<double>(squares.size());
            if (mean > kLeastBandPower * power) {
                band.kurtosis = fourth / (mean * mean) - 2.0;
                bands_.push_back(band);
            }
        }
        const std::size_t after = n == 1 ? 3 : 2 * n;
        n = next;
        next = after;
    }
}

const KurtogramBand* Kurtogram::peak() const {
    const auto largest = std::ranges::max_element(bands_, {}, &KurtogramBand::kurtosis);
    return largest == bands_.end() ? nullptr : &*largest;
}

std::vector<double> Kurtogram::squared_envelope(const KurtogramBand& band) const {
    SquaredEnvelope envelope(spectrum_, band.orders);
    const std::span<const double> squares = envelope.of(band);
    return {squares.begin(), squares.end()};
}

std::vector<double> envelope_spectrum(std::span<const double> squared_envelope) {
    std::vector<double> magnitudes;
    for (const auto& value : spectrum_of(squared_envelope)) {
        magnitudes.push_back(std::abs(value));
    }
    return magnitudes;
}

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
            const std::size_t sample = (k * points / kFramesPerMesh + i) % x.size();
            frame[i] = window[i] * x[sample];
            shifted[i] = frame[i] * carrier[sample % turn];
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
