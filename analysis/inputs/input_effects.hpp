// Dependence of detection on each random input: rates in bins of the input, and POD curves with it
// as a covariate.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/inputs/miss_sensitivity.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Bin of each value, 0 to bins - 1 in ascending order of the values. With at most `bins` distinct
// values, each has its own bin. Otherwise equal values share a bin and the counts are as equal as
// that allows.
struct InputBins {
    std::vector<std::size_t> of;
    std::size_t bins = 0;
};
InputBins equal_count_bins(std::span<const double> values, std::size_t bins);

// Dependence of the probability of detection on every random input besides the fault size: rates in
// bins of the input, and the hit/miss curve with the input as a second covariate,
//
//   POD(a, z) = floor + (ceiling - floor) F(b0 + b1 x(a) + b2 z + b3 z^2),
//
// in the form (link, scale of size, floor, ceiling) of the feature's own curve. b2 = b3 = 0 is
// tested by the likelihood ratio (McCullagh and Nelder (1989), section 4.4), adjusted over the
// inputs (Holm). a90 follows as a function of z, with bounds after E. C. Fieller, J. R. Stat. Soc.
// B 16 (1954), 175-185: the sizes at which POD 0.9 is not rejected. The slope over size is assumed
// equal at all values of the input.

// Gearboxes whose input lies in [low, high].
struct InputBin {
    double low = 0.0, high = 0.0;
    double middle = 0.0;  // median
    long tested = 0, detected = 0;
    double pd = 0.0;
    Interval bounds;  // Wilson interval
};
GEARPOD_FIELDS(InputBin, low, high, middle, tested, detected, pd, lower_upper)

struct InputEffect {
    std::string name;
    std::string unit;
    std::vector<InputBin> bins;  // of equal counts, or one per value if the values are few
    double statistic = 0.0;      // likelihood ratio; NaN without a curve
    int degrees = 0;
    double p_value = 0.0;  // adjusted over the inputs; NaN without a curve
    // Values of the input at kInputQuantiles, or all its values if they are few.
    std::vector<double> values;
    std::vector<SizeBounds> a90;  // one per value
    std::string refusal;          // reason why there are no test and no a90, or ""
};
GEARPOD_FIELDS(InputEffect, name_, unit_, bins, statistic, degrees, p_value, values_, a90_, refusal)

struct InputEffects {
    double smallest = 0.0, largest = 0.0;  // fault sizes of the bins; NaN if there are none
    std::vector<InputEffect> inputs;       // in the given order
    std::vector<std::string> left_out;     // inputs that do not vary
};
GEARPOD_FIELDS(InputEffects, smallest, largest, inputs, left_out)

inline constexpr double kInputQuantiles[] = {0.05, 0.25, 0.5, 0.75, 0.95};

// `sizes` and `hit` per gearbox (1 detected, 0 missed, -1 no value). Bins count the gearboxes with
// sizes in [range.low, range.high]; the test and a90 use all faulty gearboxes. `pod` is the
// feature's hit/miss analysis of the same gearboxes. `confidence` applies to the bins (two-sided)
// and to each one-sided bound of a90.
InputEffects input_effects(std::span<const double> sizes, std::span<const int> hit,
                           const std::vector<InputColumn>& inputs, const HitMissPod& pod,
                           const SizeGroup& range, double confidence);

// Range of sizes at which detection is neither certain nor impossible: the groups of faulty
// gearboxes with a rate of 0.1 to 0.95, or, if there are none, the group with the rate nearest to
// 1/2. NaN without a tested group.
SizeGroup transition_sizes(const std::vector<DetectionCell>& cells);

// True within the range up to the rounding of a unit conversion; false for a range of NaN.
bool in_range(double size, const SizeGroup& range);

}  // namespace gearpod::analysis
