// All features as one detector: ridge-penalised logistic regression of faulty against healthy
// (binary_regression.hpp) on each value's normal score among the healthy training gearboxes, which
// ends where no healthy one lies beyond (large faults then weigh no more than small ones that are
// as clear), scaled to the training gearboxes' standard deviation. Half of the gearboxes train it;
// the other half, none of which it has seen, set its threshold and grade it. The best single
// feature, chosen on the training half, is graded on the same gearboxes with a threshold from the
// same healthy ones.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/statistics/auc.hpp"

namespace gearpod::analysis {

// A feature's values at one noise level.
struct CombinedFeature {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample
    std::span<const double> graded;
};

struct FeatureWeight {
    std::string name;
    double weight = 0.0;  // of one standard deviation, in log odds of a fault
};

// A detector on the gearboxes that were held back.
struct HeldOutDetector {
    std::string name;
    Auc auc;
    LevelDetection detection;
    HitMissPod pod;
};

struct CombinedDetector {
    double noise_level = 0.0;
    std::vector<FeatureWeight> weights;
    double intercept = 0.0;
    long trained_healthy = 0, trained_faulty = 0;
    HeldOutDetector combined, single;
    double p_value = 1.0;               // of equal areas, paired (DeLong); NaN if undetermined
    std::vector<std::string> left_out;  // "te_fc: constant"
    std::vector<std::string> warnings;  // of the combined detector's threshold
    std::string refusal;                // why there is none, else empty
};

// Which half a gearbox belongs to, from its place in its group alone: a mixed bit of its number, so
// that levels in turn do not fall into one half.
bool trains(std::size_t instance);

// `request` with the one noise level of these values. Refused with fewer than two usable features,
// or fewer than 50 healthy or faulty gearboxes to train on.
CombinedDetector combine_features(const std::vector<CombinedFeature>& features,
                                  std::span<const double> healthy_size,
                                  std::span<const double> graded_size,
                                  const DetectionRequest& request);

}  // namespace gearpod::analysis
