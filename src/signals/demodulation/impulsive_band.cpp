#include "signals/demodulation/impulsive_band.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastBandPower = 1e-12;            // of the mean square of the samples
constexpr std::size_t kBandWidths[] = {1, 2, 4, 8};  // mesh orders

using Spectrum = std::vector<std::complex<double>>;
using Transform = FourierTransform;

// Squared envelope of a band: `count` orders of the record's spectrum from `first` on. It has two
// values per order, so that products of two orders are not aliased.
class SquaredEnvelope {
  public:
    SquaredEnvelope(std::span<const std::complex<double>> spectrum, std::size_t count)
        : spectrum_(spectrum),
          count_(count),
          transform_(static_cast<int>(2 * count), Transform::Direction::back),
          band_(2 * count),
          signal_(2 * count) {}

    std::vector<double> of(std::size_t first) {
        const double scale = 2.0 / static_cast<double>(spectrum_.size());
        for (std::size_t j = 0; j < count_; ++j) {
            band_[j] = scale * spectrum_[first + j];
        }
        transform_.transform(band_, signal_);
        std::vector<double> squares(signal_.size());
        for (std::size_t i = 0; i < signal_.size(); ++i) {
            squares[i] = std::norm(signal_[i]);
        }
        return squares;
    }

  private:
    std::span<const std::complex<double>> spectrum_;
    std::size_t count_;
    Transform transform_;
    Spectrum band_, signal_;
};

double mean_of(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

}  // namespace

std::vector<double> most_impulsive_envelope(std::span<const double> samples, std::size_t per_mesh) {
    const std::size_t meshes = samples.size() / per_mesh;
    const Spectrum values(samples.begin(), samples.end());
    Spectrum spectrum(samples.size());
    Transform(static_cast<int>(samples.size())).transform(values, spectrum);
    double power = 0.0;
    for (const double value : samples) {
        power += value * value;
    }
    power /= static_cast<double>(samples.size());
    std::vector<double> best;
    double largest = -std::numeric_limits<double>::infinity();
    for (const std::size_t width : kBandWidths) {
        if (2 * width + 1 >= per_mesh) {
            break;
        }
        SquaredEnvelope envelope(spectrum, width * meshes);
        for (std::size_t i = 0; 2 * (i + 1) * width + 1 < per_mesh; ++i) {
            // First order above half a mesh order after i widths.
            std::vector<double> squares = envelope.of((2 * i * width + 1) * meshes / 2 + 1);
            const double mean = mean_of(squares);
            double fourth = 0.0;
            for (const double square : squares) {
                fourth += square * square;
            }
            const double kurtosis =
                fourth / static_cast<double>(squares.size()) / (mean * mean) - 2.0;
            if (mean > kLeastBandPower * power && kurtosis > largest) {
                largest = kurtosis;
                best = std::move(squares);
            }
        }
    }
    return best;
}

std::vector<double> envelope_spectrum(std::span<const double> squared_envelope) {
    const Spectrum values(squared_envelope.begin(), squared_envelope.end());
    Spectrum spectrum(values.size());
    Transform(static_cast<int>(values.size())).transform(values, spectrum);
    std::vector<double> magnitudes;
    for (const auto& value : spectrum) {
        magnitudes.push_back(std::abs(value));
    }
    return magnitudes;
}

}  // namespace gearpod::signals
