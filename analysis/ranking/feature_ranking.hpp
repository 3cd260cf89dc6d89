// Features in order of the area under their ROC, and which of them the gearboxes tell apart: paired
// test of DeLong et al. (1988) on the same gearboxes, adjusted over all pairs (holm.hpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/statistics/auc.hpp"

namespace gearpod::analysis {

// A feature that lacks more of its values is not ranked, nor combined with others.
inline constexpr double kMostMissing = 0.1;

// One feature's values at one noise level; all features over the same gearboxes in the same order.
struct RankedFeature {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;
    std::span<const double> faulty;
};

struct FeatureRank {
    std::string name;
    Auc auc;  // over the gearboxes that all ranked features have a value for
    // Adjusted p-value of the paired difference from every ranked feature, in order of rank; 1 from
    // itself.
    std::vector<double> p_values;
};

struct FeatureRanking {
    long healthy = 0, faulty = 0;       // gearboxes that it rests on
    std::vector<FeatureRank> ranks;     // falling area
    std::vector<std::string> left_out;  // "te_fc: no value for 61 of 5500 gearboxes"
    std::string refusal;                // why there is none, else empty
};

// A feature without a value for more than a tenth of the gearboxes is left out, so that it does not
// take these from the others.
FeatureRanking rank_features(const std::vector<RankedFeature>& features, double confidence);

}  // namespace gearpod::analysis
