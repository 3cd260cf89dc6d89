// Combination of all features into one detector by ridge-penalised logistic regression of faulty
// against healthy gearboxes (binary_regression.hpp). Covariates are the normal scores of each value
// among the healthy training gearboxes, scaled to the training gearboxes' standard deviation. The
// score is bounded where no healthy value lies beyond, so that a very large fault weighs no more
// than a small one that is as clear. Half of the gearboxes train the detector; the other half sets
// its threshold and evaluates it. The best single feature, chosen on the training half, is
// evaluated on the same gearboxes with a threshold from the same healthy ones.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Values of a feature at one noise level.
struct CombinedFeature {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample
    std::span<const double> test;
};

struct FeatureWeight {
    std::string name;
    double weight = 0.0;  // log odds of a fault per standard deviation
};
GEARPOD_FIELDS(FeatureWeight, feature, weight)

// Performance of a detector on the held-out gearboxes.
struct HeldOutDetector {
    std::string name;
    Auc auc;
    LevelDetection detection;
    HitMissPod pod;
};
GEARPOD_FIELDS(HeldOutDetector, name, auc, detection, hit_miss)

struct CombinedDetector {
    double noise_level = 0.0;
    std::vector<FeatureWeight> weights;
    double intercept = 0.0;
    long trained_healthy = 0, trained_faulty = 0;
    HeldOutDetector combined, single;
    double p_value = 1.0;               // paired test of equal areas (DeLong); NaN if undetermined
    std::vector<std::string> left_out;  // for example "te_fc: constant"
    std::vector<std::string> warnings;  // about the combined detector's threshold
    std::string refusal;                // reason why there is no detector, or ""
};

// True if a gearbox belongs to the training half. Decided by a hash bit of its index within its
// group, so that alternating levels do not fall into one half.
bool in_training_half(std::size_t instance);

// Trains and evaluates the detector. The noise level of `request` is that of the values.
// Refuses fewer than two usable features, and fewer than 50 healthy or faulty training gearboxes.
CombinedDetector combine_features(const std::vector<CombinedFeature>& features,
                                  std::span<const double> healthy_size,
                                  std::span<const double> test_size,
                                  const DetectionRequest& request);

}  // namespace gearpod::analysis
