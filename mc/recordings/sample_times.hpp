// Sampling times of a recording, with checks for missing and clipped samples.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace gearpod::mc {

// Evenly spaced times, or a description of the problem.
struct SampleTimes {
    std::vector<double> seconds;
    std::string problem;
};

// Evenly spaced times, s, from a column that may have been rounded: to decimals, to significant
// digits, or to single or double precision. `factor` converts the column to seconds. Missing
// samples, and times that stand still or run back by more than the rounding, are reported with
// their position; so are times rounded so coarsely that a missing sample would not show. `column`
// must have at least two values.
SampleTimes sample_times(std::vector<double> column, double factor = 1.0);

// The values 0, 1, 2, ... divided by `rate`.
std::vector<double> evenly_spaced(std::size_t samples, double rate);

// Returns "" unless the speed changes its sign. A gearbox that reverses passes its meshes again and
// loads the other flanks.
std::string sign_change_text(std::span<const double> speed);

// Integral of `rate` over `time` from the first sample on, by the trapezoidal rule.
std::vector<double> integral(std::span<const double> time, std::span<const double> rate);

// Continues a signal of whole planet turns periodically by some samples; does nothing for other
// lengths and for empty signals. Otherwise a finer grid would lose its points after the last
// sample, and with them the last mesh period.
void extend_periodically(const std::vector<std::vector<double>*>& signals,
                         std::vector<double>& phase, double samples_per_turn);

// Returns "" unless values are not finite or too large to compute with.
std::string bad_values(std::span<const double> values);

// Returns "" unless the signal is clipped: several runs of equal samples at its largest or smallest
// value that begin and end with jumps above the resolution.
std::string clipping(std::span<const double> samples);

// Returns "" unless samples are missing within a signal on the mesh-phase grid
// (signals/spectra/lost_samples.hpp). `detectable` is set to true if missing samples can be
// detected.
std::string losses_text(std::span<const double> samples, int per_mesh, int turn_meshes,
                        bool& detectable);

}  // namespace gearpod::mc
