// Dependence of detection on each random input: rates in bins of the input, and POD curves with it
// as a covariate.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Influence of the random inputs on misses. For every input, the probability that a missed gearbox
// has a larger value of it than a detected one of the same fault size: the Mann-Whitney statistic,
// i.e. the AUC of the input between misses and hits. 1/2 means no influence; 1 means that the
// misses are those with large values. The sizes are strata, weighted as in P. van Elteren, Bull.
// Inst. Int. Stat. 37 (1960), 351-361, which removes the dominant influence of the fault size
// itself. The measure detects only the monotone influence of single inputs, not interactions. It
// uses the sample as it is, without further runs or a model.

struct InputColumn {
    std::string name;
    std::string unit;
    std::span<const double> values;  // one per gearbox
};

// True if the values are not all equal.
inline bool varies(std::span<const double> values) {
    return std::ranges::any_of(values, [&](double value) { return value != values.front(); });
}

struct InputInfluence {
    std::string name;
    std::string unit;
    double larger_in_misses = 0.5;
    Interval bounds;       // two-sided; DeLong's variance, on the logit scale
    double p_value = 1.0;  // test against 1/2, adjusted over the inputs (Holm)
};
GEARPOD_FIELDS(InputInfluence, name, unit, larger_in_misses, lower_upper, p_value)

struct MissSensitivity {
    long misses = 0, hits = 0;             // numbers used
    double smallest = 0.0, largest = 0.0;  // range of the fault sizes used
    std::vector<InputInfluence> inputs;    // by falling distance from 1/2
    std::vector<std::string> left_out;     // inputs that do not vary
    std::string refusal;                   // reason why there is no result, or ""
};
GEARPOD_FIELDS(MissSensitivity, misses, hits, smallest, largest, inputs, left_out, refusal)

// `sizes` and `hit` per gearbox (1 detected, 0 missed, -1 no value). Uses fault sizes at which at
// least half of the gearboxes, but not all, are detected. Sizes that do not repeat are grouped into
// strata of 100 neighbours. Each stratum needs two hits and two misses, all strata together ten of
// each.
MissSensitivity miss_sensitivity(std::span<const double> sizes, std::span<const int> hit,
                                 const std::vector<InputColumn>& inputs, double confidence);

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
GEARPOD_FIELDS(InputEffect, name_, unit_, bins, statistic, degrees, p_value, values, a90, refusal)

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

// Uncertainty of the POD curve due to epistemic inputs. Their distribution over the gearboxes is
// not scatter between gearboxes but the knowledge of one value that all of them share, for example
// from a calibration; more gearboxes do not reduce it. The hit/miss curve has these inputs as
// further covariates,
//
//   POD(a, z) = floor + (ceiling - floor) F(b0 + b1 x(a) + sum of b2i zi + b3i zi^2),
//
// in the form of the feature's own curve. It is evaluated at the inputs of every gearbox, which are
// samples of the knowledge; the band holds the middle 90 % of these curves. All curves share one
// threshold, that of all samples together.

struct EpistemicBand {
    std::vector<std::string> inputs;  // those that vary; no band if empty
    SizeEstimate a90_low, a90_high;   // at the 5 and 95 % quantile of the curves
    std::vector<PodPoint> band;  // at the sizes of the feature's band: median, 5 and 95 % quantile
    std::string refusal;         // reason why there is no band, or ""
};
GEARPOD_FIELDS(EpistemicBand, inputs, a90_low, a90_high, band_, refusal)

inline constexpr double kEpistemicQuantiles[] = {0.05, 0.95};

// `sizes` and `hit` per gearbox as in input_effects(); `pod` is the analysis of the same gearboxes.
EpistemicBand epistemic_band(std::span<const double> sizes, std::span<const int> hit,
                             const std::vector<InputColumn>& inputs, const HitMissPod& pod);

}  // namespace gearpod::analysis
