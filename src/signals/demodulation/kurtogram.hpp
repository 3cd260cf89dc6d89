// Kurtogram of a signal: kurtosis of its complex envelope in the bands of a binary and 1/3-binary
// tree. J. Antoni, Mech. Syst. Signal Process. 21 (2007) 108-124.
//
// Each level of the tree splits the range from zero to the Nyquist order into n equal bands, n = 1,
// 2, 3, 4, 6, 8, 12, 16, ... The bands are ideal in frequency over the periodic record, where the
// paper has short filters. With N samples, band i of n has the orders k (cycles per record) with
//
//     i N / (2 n) < k <= (i + 1) N / (2 n),   k < N / 2.
//
// With b the analytic signal of a band, its kurtosis is
//
//     K = <|b|^4> / <|b|^2>^2 - 2:
//
// 0 for stationary Gaussian noise, -1 for a tone, (2 C + 1 / C) / 3 - 2 for an impulse in a band of
// C orders.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::signals {

// Band of a kurtogram: `orders` orders from `first` on.
struct KurtogramBand {
    std::size_t first = 0, orders = 0;
    double kurtosis = 0.0;
};

class Kurtogram {
  public:
    // Computes the levels with up to `most_bands` bands. At least three samples.
    Kurtogram(std::span<const double> samples, std::size_t most_bands);

    // Bands in the order of the levels, each from low to high orders. Bands with less than 1e-12 of
    // the mean square of the samples contain rounding errors only and are left out.
    std::span<const KurtogramBand> bands() const { return bands_; }
    // Band with the largest kurtosis, the first of equal ones; nullptr if there are no bands.
    const KurtogramBand* peak() const;

  private:
    std::vector<KurtogramBand> bands_;
};

}  // namespace gearpod::signals
