// What a study says of its features as detectors: POD curves, areas under the ROC, ranking and what
// decides the misses, for every feature and noise level.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/condition_detection.hpp"
#include "analysis/false_alarm_curve.hpp"
#include "analysis/inputs/input_effects.hpp"
#include "analysis/inputs/level_sensitivity.hpp"
#include "analysis/inputs/miss_sensitivity.hpp"
#include "analysis/inputs/uncertain_inputs.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/ranking/combined_detector.hpp"
#include "analysis/ranking/feature_ranking.hpp"
#include "analysis/ranking/roc.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

struct LevelReliability {
    double noise_level = 0.0;
    bool has_threshold = true;  // without one nothing is known of what is found
    HitMissPod hit_miss;
    SignalResponsePod signal_response;
    Auc auc;  // all faulty gearboxes against all healthy ones
    std::vector<Auc>
        auc_by_size;            // in the order of the request's groups; no faulty ones in one at 0
    std::vector<RocPoint> roc;  // all faulty gearboxes against all healthy ones
    MissSensitivity misses;
    InputEffects inputs;
    UncertainBand uncertain;
    std::vector<double> pd;   // of the size groups above 0, ascending; NaN where none was tested
    FalseAlarmCurve by_rate;  // a90 at other false-alarm rates
    std::optional<LeastCost> least_cost;  // if costs are asked for
    // The size that the rates alone vouch for, without a curve; NaN: none.
    double tested_size = kNan;
};

struct FeatureReliability {
    std::string feature;
    Alarm alarm = Alarm::high;
    std::vector<LevelReliability> levels;  // ascending noise
};

struct Reliability {
    std::vector<FeatureReliability> features;
    std::vector<FeatureRanking> rankings;    // one a noise level
    std::vector<CombinedDetector> combined;  // one a noise level
    std::vector<LevelSensitivity>
        sensitivities;  // one a noise level, of its best ranked feature; without a name if none
    std::vector<ConditionDetection>
        conditions;  // one a feature; empty if no condition was asked for
};

// Places of the features at a noise level, the best ranked first, those without a rank last.
std::vector<std::size_t> in_rank_order(const Reliability& reliability, std::size_t level);

struct FeatureColumns {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample, gearboxes x noise levels
    std::span<const double> graded;
    // Of several records of each gearbox of the threshold sample all of them, records x noise
    // levels, and the weights of tilted ones: for thresholds. `healthy` has the first of each.
    std::span<const double> records = {};
    std::span<const double> weights = {};
};

struct ReliabilityData {
    std::span<const double> healthy_size;  // threshold sample
    std::span<const double> graded_size;
    std::vector<FeatureColumns> features;
    std::vector<InputColumn> inputs;         // of the graded gearboxes
    std::vector<InputColumn> uncertain;      // those of them that are (uncertain_inputs.hpp)
    std::vector<ConditionColumn> condition;  // at most one
    std::optional<Costs> costs = {};
    // Of the features' records, or without these of the threshold sample; empty: each its own.
    std::vector<std::size_t> record_gearbox = {};
};

// `detections` as detect() gave them, in the order of data.features. Healthy gearboxes are the
// threshold sample and the graded ones of size 0. The same numbers whatever the
// threads.
Reliability assess_reliability(const ReliabilityData& data,
                               const std::vector<FeatureDetection>& detections,
                               const DetectionRequest& request, int threads);

}  // namespace gearpod::analysis
