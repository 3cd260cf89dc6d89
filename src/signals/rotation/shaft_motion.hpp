// Rotation of a shaft from tachometer pulses and encoder angles, with checks for motion that no
// shaft can have.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gearpod::signals {

// Jump of a measured motion: in the interval that ends at `place` the motion is larger by `excess`
// than its neighbours let expect, or smaller if it is negative.
struct MotionJump {
    std::size_t index = 0;
    double excess = 0.0, expected = 0.0;  // in the unit of the motion
};

// Finds a jump in rising values `motion` at the rising positions `at` (samples), which are known to
// within `timing` samples. An interval jumps if its speed differs from the median of its eight
// neighbours by more than
//
//     a fifth of that median,
//     three times the difference that a hundredth of all intervals exceed (jitter, quantization),
//     three times the third largest difference of its neighbours (torsional vibration),
//     one and a half times what `timing` explains,
//
// if the motion differs by more than `least`, if the neighbours do not undo at least half of it,
// and if it is not a count of an encoder that advances by whole counts in each sample. Motion that
// is smooth, vibrates or is quantized thus passes; jumps smaller than these limits are not found.
std::optional<MotionJump> motion_jump(std::span<const double> sample,
                                      std::span<const double> motion, double timing, double least);

// Returns "" unless a mesh phase, which rises from sample to sample, jumps by `least` or more.
std::string phase_jump_text(std::span<const double> phase, double least);

// Positions, in samples, at which the pulses of a tachometer rise through half their height.
// `problem` reports too few, missing or additional pulses, and jumps by `least` pulses or more.
struct Pulses {
    std::vector<double> sample;
    std::string problem;
    std::size_t problem_sample = 0;  // from 1; 0: unknown
};
Pulses tachometer_pulses(std::span<const double> column, double least);

// Number of pulses passed, at each sample from the first to the last pulse, by cubic interpolation.
// `first` is the first of these samples.
struct PulseCount {
    std::size_t first = 0;
    std::vector<double> count;
};
PulseCount count_pulses(const std::vector<double>& pulses);

// Rising angles of a shaft, rad, at the samples from `first` on, or a description of the problem.
struct ShaftAngle {
    std::size_t first = 0;
    std::vector<double> rad;
    std::string problem;
    std::size_t problem_sample = 0;  // from 1; 0: unknown
};
// Shaft angle from an encoder's angle. The column may restart after each turn and may fall
// (backward rotation). If samples repeat a count, the angle is the mean of two counts where the
// count changes, and linear in between. Jumps by `least` or more (rad) are a problem.
ShaftAngle shaft_angle(std::vector<double> column, double least);

}  // namespace gearpod::signals
