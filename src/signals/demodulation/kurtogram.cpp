#include "signals/demodulation/kurtogram.hpp"

#include <algorithm>
#include <complex>
#include <numeric>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
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

Kurtogram::Kurtogram(std::span<const double> samples, std::size_t most_bands) {
    const Spectrum spectrum = spectrum_of(samples);
    const double power = mean_square(samples);
    // 1, 2, 3, 4, 6, 8, 12, ...: twice the number before the last one, from 4 on.
    for (std::size_t n = 1, next = 2; n <= most_bands;) {
        SquaredEnvelope envelope(spectrum, samples.size() / (2 * n) + 1);
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

}  // namespace gearpod::signals
