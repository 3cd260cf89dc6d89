// Samples of a recording that are no vibration: dropouts, copies, spikes and steps of level.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace gearpod::mc {

double rms_of(std::span<const double> values);

// Subtracts the mean of the samples and returns it.
double subtract_mean(std::vector<double>& samples);

// Returns "" unless a stretch of samples is constant or repeats an earlier one, which noise
// excludes. A constant stretch has more than 20 samples, and four times as many as 99 of 100 runs
// of equal samples. A copy has 32 samples or more. A recording that consists of equal samples, or
// of copies by half, is another matter: an empty channel, or a simulation without noise.
std::string stretches_text(std::span<const double> samples);

// Returns "" unless single samples, or pairs, lie 30 standard deviations (from the median of the
// absolute values) or more from the mean, and their neighbours within a quarter of that.
std::string spikes_text(std::span<const double> samples);

// Returns "" unless the mean changes at one place by half the rms or more, and by eight times the
// scatter of the means of 32 parts on both sides.
std::string level_step_text(std::span<const double> samples);

}  // namespace gearpod::mc
