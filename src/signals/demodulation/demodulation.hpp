// Narrow-band demodulation of the strongest mesh harmonic of an averaged turn: P. D. McFadden, J.
// Vib. Acoust. Stress Reliab. Des. 108 (1986) 165-170.
//
// The carrier is the mesh harmonic j T of a gear with T teeth that has the largest amplitude. The
// band around it holds the orders j T - h to j T + h, h = (T - 1) / 2 rounded down: the harmonic
// with all its sidebands. Its analytic signal, divided by exp(i j T t), is the modulation b(t).
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::signals {

// b(t), one value per sample of `turn`. `amplitude` holds the turn's one-sided amplitudes by order.
// Harmonics whose band exceeds the Nyquist order are not used. Empty if no harmonic is above 1e-12
// of the sum of all amplitudes, the size of rounding errors.
std::vector<std::complex<double>> mesh_modulation(std::span<const double> turn,
                                                  std::span<const double> amplitude, int teeth);

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
    // |b|^2 of a band over the record, (m/s^2)^2, in at least two values per order of the band.
    std::vector<double> squared_envelope(const KurtogramBand& band) const;

  private:
    std::vector<std::complex<double>> spectrum_;  // of the samples
    std::vector<KurtogramBand> bands_;
};

// Magnitudes of the Fourier transform of a squared envelope: [k] at k cycles per record.
std::vector<double> envelope_spectrum(std::span<const double> squared_envelope);

// Cyclic spectral coherence at one cycle per turn, averaged over the frequency bands f:
//
//     |gamma(f)|^2 = |<X_k(f) Y_k(f)*>|^2 / (<|X_k(f)|^2> <|Y_k(f)|^2>),
//
// where X_k are short-time Fourier transforms of the record x, and Y_k those of x exp(2 pi i t /
// T), T being the turn: Y(f) = X(f - 1/T). <> is the mean over the frames k. J. Antoni, Mech. Syst.
// Signal Process. 21 (2007) 597-630; 23 (2009) 987-1036. It is 1 if components 1/T apart are fully
// correlated, and 0 without modulation at the turn. An estimate from K independent frames is about
// 1/K above 0.

// Mean of |gamma|^2 over the bands between zero and the Nyquist frequency with more than 1e-12 of
// the strongest band's power; NaN for a zero signal. Frames are one mesh period of `points` samples
// long, under a periodic Hann window, and overlap by three quarters. `x` holds whole turns of
// `turn` samples, and continues from its beginning after its end.
double cyclic_coherence(std::span<const double> x, std::size_t turn, std::size_t points);

}  // namespace gearpod::signals
