// Windowing and mapping: Liang (2016), section 5.3.
//
// Windows one mesh period wide cut the sensor signal every Z_p meshes. The n-th segment of planet
// tooth S is mapped to ring tooth mod((n-1) Z_p + 1, Z_r), and Z_p Z_r meshes give Z_p tooth
// signals of P Z_r samples. The mapping permutes the segments of a tooth signal and does not change
// its RMS (Eq. 5.4.1). The windows repeat every Z_p meshes, so the RMS follows from the folded
// squares:
//
//     RMS_j = sqrt( (1 / (P Z_r)) sum over m < P of w(m)^2 F[(j P + o + m) mod Z_p P] ).
//
// The offset o of the first window, 0..P-1, is the one whose largest tooth RMS is largest (section
// 5.3.2).
//
// The sum is linear in F, and F is a polynomial in the noise level (sensor_noise.hpp):
//
//     F_noisy = F + 2 sigma Z sqrt F + sigma^2 (Z^2 + G).
//
// Each of the three terms is therefore windowed once and serves all noise levels.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "machine/lanes.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Tukey window of `points` points; Liang (2016), section 5.3.1. taper 0: rectangular, 1: Hann.
std::vector<double> tukey_window(int points, double taper);

// Windows of one gearbox at a time. Holds scratch memory: use one object per thread.
class Windowing {
  public:
    // Throws std::invalid_argument unless P >= 2, the layout has meshes and 0 <= taper <= 1.
    Windowing(const SpanLayout& layout, int phases, double taper);

    // Takes the folded squares of a gearbox (contiguous, Z_p P bins), without noise or with noise
    // that search() and mean_square() can add. Throws std::invalid_argument if the sizes disagree.
    void load(std::span<const double> folded);
    void load(std::span<const double> folded, const NoiseVariates& noise);

    // Computes the RMS of every tooth signal (Z_p values, m/s^2) with noise of rms sigma, m/s^2, at
    // the best first window. Returns that window's offset, 0..P-1 (the smallest of equals). Equal
    // teeth give bit-equal values. Throws std::invalid_argument if sigma is not 0 and no noise was
    // loaded, or if the number of teeth disagrees.
    int search(double sigma, std::span<double> tooth_rms) const;

    // Mean square of the signal over the span, (m/s^2)^2. Throws likewise.
    double mean_square(double sigma) const;

  private:
    // One term of F_noisy: the windows' energies, [bin][segment], and the sum of all its bins.
    struct Term {
        machine::AlignedVector energy;
        double total = 0.0;
    };
    enum : std::size_t { kSignal, kCross, kNoise };

    void spread(std::span<const double> bins, machine::AlignedVector& spread) const;
    void window(const machine::AlignedVector& bins, Term& term);
    double total() const;
    double energy_at_level(double sigma, double signal, double cross, double noise) const;
    void check(double sigma) const;

    SpanLayout layout_;
    int phases_;
    int periods_;     // mesh periods of a segment
    int first_;       // index of the first nonzero weight
    int flat_first_;  // the window is 1 at flat_first_ .. flat_first_ + flat_count_ - 1
    int flat_count_;
    std::vector<double> weight_squared_;  // P
    std::vector<long> block_end_;
    std::vector<int> end_of_bin_;
    // Bins of the signal, of Z and of G, which become those of the three terms. Each segment is
    // followed by the mesh period after it.
    std::array<machine::AlignedVector, 3> bins_;
    machine::AlignedVector upwards_, downwards_;
    std::array<Term, 3> terms_;
    bool noisy_ = false;
};

}  // namespace gearpod::signals
