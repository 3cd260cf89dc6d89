// Discrete Fourier transform of any length n: X_k = sum over i of x_i w^(i k), w = exp(-2 pi i /
// n), or its conjugate for the way back, which gives n times the signal.
//
// Lengths here are teeth times samples a mesh period, and numbers of teeth like to be prime:
// kissfft, made for small factors, would spend most of its time on theirs. So the largest prime
// factor q > 5 is taken out (Cooley and Tukey): q transforms of n/q points, then one of q points
// for each of n/q orders, over lanes.
#pragma once

#include <complex>
#include <kissfft/kissfft.hh>
#include <span>
#include <vector>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// Holds scratch memory: one object per thread.
class FourierTransform {
  public:
    enum class Way { forward, back };

    // Throws std::invalid_argument unless points >= 1.
    explicit FourierTransform(int points, Way way = Way::forward);

    int points() const { return prime_ * part_; }

    // Both of points() values. Throws std::invalid_argument otherwise.
    void transform(std::span<const std::complex<double>> in, std::span<std::complex<double>> out);

  private:
    void transform_parts(std::span<const std::complex<double>> in);

    int prime_;  // q, 1 if there is none worth it
    int part_;   // n / q
    kissfft<double> fft_;
    std::size_t row_;  // part_, filled up to whole registers
    std::vector<std::complex<double>> of_part_;
    std::vector<std::complex<double>> twiddle_;  // [r][k]: w^(r k)
    std::vector<double> cosine_, sine_;          // prime_stage.hpp
    machine::AlignedVector real_, imaginary_;    // [r][k] of the parts
    machine::AlignedVector out_real_, out_imaginary_;
};

}  // namespace gearpod::signals
