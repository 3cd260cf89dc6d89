// Windowing and mapping: Liang (2016), section 5.3.
//
// Windows one mesh period wide cut the sensor signal every Z_p meshes; the n-th segment of planet
// tooth S goes to ring tooth mod((n-1) Z_p + 1, Z_r), and Z_p Z_r meshes give Z_p tooth signals of
// P Z_r samples. The mapping permutes the segments of a tooth signal and leaves its RMS (Eq. 5.4.1)
// as it is, and the windows repeat every Z_p meshes, so the RMS follows from the folded squares:
//
//     RMS_j = sqrt( (1 / (P Z_r)) sum over m < P of w(m)^2 F[(j P + o + m) mod Z_p P] ).
//
// The offset o of the first window is the one of P whose largest tooth RMS is largest
// (section 5.3.2).
#pragma once

#include <span>
#include <vector>

#include "machine/lanes.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Tukey window of `points` points; Liang (2016), section 5.3.1. taper 0: rectangular, 1: Hann.
std::vector<double> tukey_window(int points, double taper);

// Holds scratch memory: one object per thread.
class Windowing {
  public:
    // Throws std::invalid_argument unless P >= 2, the layout has meshes and 0 <= taper <= 1.
    Windowing(const SpanLayout& layout, int phases, double taper);

    // From the folded squares of one gearbox (contiguous, Z_p P bins), with or without noise: the
    // RMS of every tooth signal (Z_p values, m/s^2) at the best first window, whose offset 0..P-1
    // is returned (the smallest of equals). Equal teeth give bit-equal values: no running sums.
    // Throws std::invalid_argument if the sizes disagree.
    int search(std::span<const double> folded, std::span<double> tooth_rms);

  private:
    SpanLayout layout_;
    int phases_;
    int flat_first_;  // the window is 1 at flat_first_ .. flat_first_ + flat_count_ - 1
    int flat_count_;
    std::vector<double> weight_squared_;  // P
    machine::AlignedVector extended_;     // the folded squares and P - 1 of them again
    machine::AlignedVector scratch_;
    machine::AlignedVector energy_;  // per first bin of a window
};

}  // namespace gearpod::signals
