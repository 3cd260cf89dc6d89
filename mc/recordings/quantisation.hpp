// Rounding of recorded samples, and features whose value would be rounding alone.
#pragma once

#include <span>
#include <string>

#include "features/feature.hpp"

namespace gearpod::mc {

// Quantisation step of samples: the smallest difference between two values if all values are whole
// multiples of it apart. 0 if there is no such step. Looks at the first 65536 samples.
double quantisation_step(std::span<const double> samples);

// RMS of the rounding error of a sample: the step over the square root of 12 (uniform error; B.
// Widrow, IRE Trans. Circuit Theory 3 (1956), 266-276), but at least 1e-12 of the samples' RMS,
// which covers the rounding of double-precision arithmetic.
double rounding_rms(std::span<const double> samples);

// Reason why a feature of a sensor signal with this rounding error measures rounding; "" if it
// does not. A part of the signal counts as rounding if its RMS is below four times that of the
// rounding error in it. The error is white, so an order of an average of N samples has the
// amplitude 2 / N^(1/2) of its RMS, however many turns were averaged.
std::string rounding_reason(const features::Feature& feature, const features::FeatureInput& input,
                            double rounding_rms);

}  // namespace gearpod::mc
