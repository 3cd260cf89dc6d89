// Fourier transforms of any length, and lengths for which they are fast.
#pragma once

#include <algorithm>
#include <complex>
#include <kissfft/kissfft.hh>
#include <span>
#include <vector>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// Smallest number >= least, and >= 1, whose only prime factors are 2, 3 and 5.
inline int smooth_length(int least) {
    for (int n = std::max(least, 1);; ++n) {
        int rest = n;
        for (const int prime : {2, 3, 5}) {
            while (rest % prime == 0) {
                rest /= prime;
            }
        }
        if (rest == 1) {
            return n;
        }
    }
}

// Discrete Fourier transform of any length n: X_k = sum over i of x_i w^(i k), w = exp(-2 pi i /
// n). The inverse transform uses the conjugate of w and gives n times the signal.
//
// Lengths are teeth times samples per mesh period, and numbers of teeth are often prime. kissfft is
// made for small factors and would spend most of its time on a large one. The largest prime factor
// q > 5 is therefore split off (Cooley and Tukey): q transforms of n/q points, then one of q points
// for each of n/q orders, over lanes.

// Holds scratch memory: use one object per thread.
class FourierTransform {
  public:
    enum class Direction { forward, back };

    // Copies the factors of an earlier transform of the thread, if there is one of this length.
    // Throws std::invalid_argument unless points >= 1.
    explicit FourierTransform(int points, Direction way = Direction::forward);

    int points() const { return prime_ * part_; }

    // Both spans have points() values. Throws std::invalid_argument otherwise.
    void transform(std::span<const std::complex<double>> in, std::span<std::complex<double>> out);

  private:
    struct Computed {};  // selects the constructor that computes the factors
    FourierTransform(Computed, int points, Direction way);
    static FourierTransform known(int points, Direction way);

    void transform_parts(std::span<const std::complex<double>> in);

    int prime_;  // q, or 1 if no factor is split off
    int part_;   // n / q
    kissfft<double> fft_;
    std::size_t row_;  // part_, padded to whole registers
    std::vector<std::complex<double>> part_spectrum_;
    std::vector<std::complex<double>> twiddle_;  // [r][k]: w^(r k)
    std::vector<double> cosine_, sine_;          // prime_stage.hpp
    machine::AlignedVector real_, imaginary_;    // [r][k] of the parts
    machine::AlignedVector out_real_, out_imaginary_;
};

// Spectrum of a real signal, all n orders, and the real signal of such a spectrum.
std::vector<std::complex<double>> spectrum_of(std::span<const double> signal);
std::vector<double> signal_of(std::span<const std::complex<double>> spectrum);

}  // namespace gearpod::signals
