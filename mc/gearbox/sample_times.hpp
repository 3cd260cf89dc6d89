// When the samples of a recording were taken: columns of time as they are written, pulses of a
// tachometer, angles of an encoder, and what tells that samples are missing or were cut off.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace gearpod::mc {

// Evenly spaced times, or what is wrong with them.
struct SampleTimes {
    std::vector<double> seconds;
    std::string problem;
};

// Of a column that may have been rounded to some decimals. Where samples are missing, or time
// stands or runs back by more than that, it is said where. Two values at least.
SampleTimes sample_times(std::vector<double> column);

// Where a tachometer's pulses rise through half of their height, in samples; or what is wrong with
// them: too few, or some that are missing or too many.
struct Pulses {
    std::vector<double> at;
    std::string problem;
};
Pulses tachometer_pulses(std::span<const double> column);

// Pulses that have passed at each of the samples from the first pulse to the last, by cubic
// interpolation; `first` is the first of these samples.
struct PulseCount {
    std::size_t first = 0;
    std::vector<double> count;
};
PulseCount count_pulses(const std::vector<double>& pulses);

// Angles of a shaft, rad, at the samples from `first` on, rising; or what is wrong with them.
struct ShaftAngle {
    std::size_t first = 0;
    std::vector<double> rad;
    std::string problem;
};
// Of an encoder's angle, which may begin anew after a turn and may fall: turning backwards. Where
// samples repeat a count, the angle is between two counts when it changes, and linear in between.
ShaftAngle shaft_angle(std::vector<double> column);

// 0, 1, 2, ... over `rate`.
std::vector<double> counted(std::size_t samples, double rate);

// "" unless a speed changes its sign: a gearbox that turns about passes its meshes again, and loads
// its other flanks.
std::string turning_about(std::span<const double> speed);

// Of a rate over the time from the first sample on, by the trapezoidal rule.
std::vector<double> integral(std::span<const double> time, std::span<const double> rate);

// Whole turns of so many samples, as averages are kept, go on from their beginning: without that a
// finer grid's points behind the last sample would be lost, and the last mesh with them. Adds some
// samples to phase and signals, empty ones aside, unless they are no whole turns.
void close_turn(const std::vector<std::vector<double>*>& signals, std::vector<double>& phase,
                double samples_per_turn);

// "" unless values are no finite numbers, or larger than can be computed with.
std::string bad_values(std::span<const double> values);

// "" unless the signal was cut off at its largest or least value: several runs of equal samples
// there that it enters and leaves by more than its own resolution.
std::string clipping(std::span<const double> samples);

// "" unless samples are missing inside a signal on the mesh-phase grid
// (signals/spectra/lost_samples.hpp); `noticed`: whether they would be.
std::string losses_text(std::span<const double> samples, int per_mesh, int turn_meshes,
                        bool& noticed);

}  // namespace gearpod::mc
