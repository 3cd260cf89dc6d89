// Evaluates the features of a study as detectors, for every feature and noise level: POD curves,
// areas under the ROC curve, ranking, and the influence of the inputs on misses.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/false_alarm_curve.hpp"
#include "analysis/inputs/input_effects.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/ranking/feature_ranking.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct LevelReliability {
    double noise_level = 0.0;
    // False: no threshold could be set, so the detection rates are unknown.
    bool has_threshold = true;
    HitMissPod hit_miss;
    SignalResponsePod signal_response;
    Auc auc;  // all faulty gearboxes against all healthy ones
    std::vector<Auc>
        // In the order of the request's groups; without faulty gearboxes for a group at size 0.
        auc_by_size;
    std::vector<RocPoint> roc;  // all faulty gearboxes against all healthy ones
    MissSensitivity misses;
    InputEffects inputs;
    EpistemicBand uncertain;
    // Detection rates of the size groups above 0, ascending; NaN where none was tested.
    std::vector<double> pd;
    FalseAlarmCurve by_rate;  // a90 at other false-alarm rates
    // Smallest size demonstrated by the tested rates alone, without a curve; NaN if there is none.
    double demonstrated_size = kNan;
};
GEARPOD_FIELDS(LevelReliability, noise_level, has_threshold_, hit_miss, signal_response, auc,
               auc_by_size, roc, misses, inputs_, uncertain, pd_, by_false_alarm_rate,
               demonstrated_size_)

struct FeatureReliability {
    std::string feature;
    Alarm alarm = Alarm::high;
    std::vector<LevelReliability> levels;  // by ascending noise level
};

struct Reliability {
    std::vector<FeatureReliability> features;
    std::vector<FeatureRanking> rankings;  // one per noise level
    std::vector<ConditionDetection>
        conditions;  // one per feature; empty if no condition was requested
};

// Indices of the features at a noise level in order of rank. Features without a rank come last.
std::vector<std::size_t> in_rank_order(const Reliability& reliability, std::size_t level);

struct FeatureColumns {
    std::string name;
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample, gearboxes x noise levels
    std::span<const double> test;
    // All records of the threshold sample (records x noise levels) if each gearbox has several, and
    // the importance-sampling weights of the records. Used for thresholds; `healthy` holds the
    // first record of each gearbox.
    std::span<const double> records = {};
    std::span<const double> weights = {};
};

struct ReliabilityData {
    std::span<const double> healthy_size;  // threshold sample
    std::span<const double> test_size;
    std::vector<FeatureColumns> features;
    std::vector<InputColumn> inputs;         // inputs of the test gearboxes
    std::vector<InputColumn> uncertain;      // epistemic inputs among them (input_effects.hpp)
    std::vector<ConditionColumn> condition;  // at most one
    // Gearbox of each row of the features' `records`, or of the threshold sample if there are none.
    // Empty if every row is a gearbox of its own.
    std::vector<std::size_t> record_gearbox = {};
};

// Every `step`-th pair of a feature and a noise level, from pair number `first` on. The pairs of a
// feature are consecutive.
struct PairShare {
    std::size_t first = 0, step = 1;
};

// Evaluates these pairs in order. `detections` are the results of detect() in the order of
// data.features. Healthy gearboxes are the threshold sample and the test gearboxes of size 0.
// Results depend neither on the number of threads nor on the shares.
std::vector<LevelReliability> assess_pairs(const ReliabilityData& data,
                                           const std::vector<FeatureDetection>& detections,
                                           const DetectionRequest& request, PairShare share,
                                           int threads);

// Ranks the features. `pairs` are the results of assess_pairs() for all pairs.
Reliability assess_reliability(const ReliabilityData& data, const DetectionRequest& request,
                               std::vector<LevelReliability> pairs);

// The same, including the pairs.
Reliability assess_reliability(const ReliabilityData& data,
                               const std::vector<FeatureDetection>& detections,
                               const DetectionRequest& request, int threads);

// Headline result: the smallest fault found with a probability of 90 % at the requested confidence.
//
// For one feature alone this is the upper bound of a90 where the curve fits, otherwise the smallest
// size demonstrated by the tested rates. Two effects make this bound erratic: a fitted curve may
// give a larger size after a miss has become a hit (its slope falls), and perfect detection has no
// curve. A size demonstrated by one feature at one noise level therefore also holds for every
// feature and level that finds at least as many faults in every size group. As a result the size
// never grows where no rate falls, and no feature ranks below one that finds fewer faults.
struct SmallestFault {
    // Feature and noise level whose bound is used: the requested ones, or ones that find no more
    // faults.
    struct Source {
        std::string feature;
        double noise_level = 0.0;
        bool operator==(const Source&) const = default;
    };
    std::string feature;
    double size = 0.0;
    bool from_curve = false;  // the bound is a90's, otherwise a demonstrated size
    Source source;
    bool from_itself = true;  // the source is the feature itself at this noise level
};
GEARPOD_FIELDS(SmallestFault, feature, size, from_curve, source_, from_itself_)
GEARPOD_FIELDS(SmallestFault::Source, feature, noise_level)

// Smallest fault of one feature at one noise level by its own bound or demonstrated size alone.
std::optional<SmallestFault> own_smallest_fault(const std::string& feature,
                                                const LevelReliability& reliability);

// Smallest fault of one feature (index in `reliability.features`) at a noise level.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level,
                                            std::size_t feature);

// Smallest fault over all features. Of equal sizes, the feature that finds most comes first, then
// the better ranked.
std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level);

// The same from the tested rates alone, where there are too many values for curves: the smallest
// size demonstrated by its own and all larger sizes' rates.
std::optional<SmallestFault> smallest_fault(std::span<const FeatureDetection> detection,
                                            std::size_t level);

}  // namespace gearpod::analysis
