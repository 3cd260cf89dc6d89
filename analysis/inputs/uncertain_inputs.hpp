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
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/inputs/miss_sensitivity.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

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
