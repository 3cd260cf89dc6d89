// Checks the speed of a signal by the mesh lines of its spectrum.
//
// In steady running all lines of a gearbox are multiples of the turn frequency of the carrier (of
// the wheel, for a fixed-shaft pair). The lines of a mesh cluster around the multiples k of the
// mesh frequency. A comb of these lines, stretched by `ratio`, is compared with the strong lines of
// the spectrum. The ratio of the best fit is the signal's speed over the assumed one: it shows a
// wrong speed, another shaft's speed, a wrong number of pulses, and signals without mesh lines.
//
// A stretch by one comb tooth maps the lines of k = 1 to their neighbours, but the lines of the
// k-th harmonic k teeth away, where lines are weaker. With few harmonics such a ratio may fit
// nearly as well; it is then reported as `other`.
#pragma once

#include <optional>
#include <span>

namespace gearpod::signals {

struct WideSpeed {
    double ratio = 1.0;   // best-fitting speed over the assumed one
    double fit = 0.0;     // fraction of the lines that the comb covers at `ratio`, from 0 to 1
    double stated = 0.0;  // the same at a ratio of 1
    double other = 0.0;   // another ratio with nearly the same fit; 0: none
    int harmonics = 0;    // number of mesh harmonics with lines at `ratio`
    int lines = 0;        // number of lines above the noise, of any origin

    // True if the lines confirm the assumed speed. At a wrong speed chance covers a tenth of them.
    // The dense comb of a lower speed covers more.
    bool fits() const { return stated > (ratio < 1.0 ? 0.5 : 0.6) * fit && stated > 0.1; }
    // True if enough lines fit another speed to name it.
    bool contradicts() const { return !fits() && fit > 0.3 && harmonics >= 3; }
};

// `samples` are evenly spaced in mesh phase, `per_mesh` per mesh period; `turn_meshes` is the
// number of mesh periods of a turn, 1 if the path does not move. Searches ratios from 0.19 to 5.3.
// Lines count by the logarithm of their power over the noise, and a comb without lines at some of
// its harmonics fits less: a half or a double of the speed is so told from it. Empty for fewer than
// 20 mesh periods or two samples in each.
std::optional<WideSpeed> wide_speed(std::span<const double> samples, double per_mesh,
                                    int turn_meshes);

}  // namespace gearpod::signals
