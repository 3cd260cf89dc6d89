// ROC curves of features, and their ranking by the area under them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Receiver operating characteristic (ROC): detection rate of the faulty gearboxes against
// false-alarm rate of the healthy ones, over all thresholds. T. Fawcett, Pattern Recognit. Lett. 27
// (2006), 861-874.
struct RocPoint {
    double false_alarm_rate = 0.0;
    double detection_rate = 0.0;
};
GEARPOD_FIELDS(RocPoint, false_alarm_rate, detection_rate)

// Curve from (0, 0) to (1, 1) with a corner for each threshold. Tied values are joined by a
// straight line, so that the trapezoidal area equals that of auc(). Corners in excess of
// `most_points` are removed evenly along the curve. Values that are not finite are
// left out. With `high` false, low values alarm. Empty without a value of either kind.
std::vector<RocPoint> roc_curve(std::span<const double> healthy, std::span<const double> faulty,
                                bool high, std::size_t most_points = 101);

// Ranking of features by the area under their ROC curve, with paired tests of their differences on
// the same gearboxes (DeLong et al. (1988)), adjusted over all pairs (interval.hpp).

// Largest share of missing values with which a feature is still ranked.
inline constexpr double kMostMissing = 0.1;

// Values of one feature at one noise level, of the same gearboxes in the same order as those of
// other features.
struct RankedFeature {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;
    std::span<const double> faulty;
};

struct FeatureRank {
    std::string name;
    Auc auc;  // over the gearboxes for which all ranked features have a value
    // Adjusted p-values of the paired difference from every ranked feature, in order of rank; 1 for
    // the feature itself, NaN where the difference has no variance but is not 0.
    std::vector<double> p_values;
};
GEARPOD_FIELDS(FeatureRank, name, auc_, p_values)

struct FeatureRanking {
    long healthy = 0, faulty = 0;       // number of gearboxes used
    std::vector<FeatureRank> ranks;     // by falling area
    std::vector<std::string> left_out;  // for example "te_fc: no value for 61 of 5500 gearboxes"
    std::string refusal;                // reason why there is no ranking, or ""
};
GEARPOD_FIELDS(FeatureRanking, healthy, faulty, ranks, left_out, refusal)

// Ranks the features. A feature without a value for more than a tenth of the gearboxes is left out,
// because the ranking uses complete gearboxes only.
FeatureRanking rank_features(const std::vector<RankedFeature>& features, double confidence);

}  // namespace gearpod::analysis
