#include "analysis/reliability.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/statistics/every_nth.hpp"
#include "machine/team.hpp"

namespace gearpod::analysis {
namespace {

// Values of all healthy gearboxes and of all faulty ones, for AUC and ranking.
struct HealthyAndFaulty {
    std::vector<double> healthy, faulty;
};

HealthyAndFaulty healthy_and_faulty(const ReliabilityData& data, const FeatureColumns& feature,
                                    std::size_t level, std::size_t levels) {
    HealthyAndFaulty values{every_nth(feature.healthy, level, levels), {}};
    for (std::size_t i = 0; i < data.test_size.size(); ++i) {
        (data.test_size[i] > 0.0 ? values.faulty : values.healthy)
            .push_back(feature.test[i * levels + level]);
    }
    return values;
}

// Values of one feature at one noise level.
struct LevelValues {
    HealthyAndFaulty all;
    std::vector<double> thresholds;            // of the threshold sample
    std::vector<double> test;                  // all test gearboxes in order
    std::vector<std::vector<double>> by_size;  // faulty gearboxes by size group
};

LevelValues level_values(const ReliabilityData& data, const FeatureColumns& feature,
                         const std::vector<std::size_t>& group, std::size_t groups,
                         std::size_t level, std::size_t levels) {
    LevelValues values;
    values.all = healthy_and_faulty(data, feature, level, levels);
    values.thresholds =
        every_nth(feature.records.empty() ? feature.healthy : feature.records, level, levels);
    values.test = every_nth(feature.test, level, levels);
    values.by_size.resize(groups);
    for (std::size_t i = 0; i < values.test.size(); ++i) {
        if (data.test_size[i] > 0.0 && group[i] != kNoGroup) {
            values.by_size[group[i]].push_back(values.test[i]);
        }
    }
    return values;
}

LevelReliability assess_level(const ReliabilityData& data, const FeatureColumns& feature,
                              const LevelValues& values, const LevelDetection& detection,
                              double confidence) {
    LevelReliability level;
    level.noise_level = detection.noise_level;
    level.has_threshold = !std::isnan(detection.threshold);
    const bool high = feature.alarm == Alarm::high;
    const auto& [healthy, all_faulty] = values.all;
    level.auc = auc(healthy, all_faulty, high, confidence);
    level.roc = roc_curve(healthy, all_faulty, high);
    for (const std::vector<double>& faulty : values.by_size) {
        level.auc_by_size.push_back(auc(healthy, faulty, high, confidence));
    }
    const std::vector<int> hit = outcomes(values.test, detection.threshold, feature.alarm);
    level.hit_miss = pod_of_outcomes(data.test_size, hit, detection, confidence);
    level.signal_response = signal_response_pod(data.test_size, values.test,
                                                {detection.threshold, feature.alarm, confidence});
    if (!level.has_threshold) {
        level.misses.refusal = "no threshold";
    } else {
        level.misses = miss_sensitivity(data.test_size, hit, data.inputs, confidence);
    }
    level.inputs = input_effects(data.test_size, hit, data.inputs, level.hit_miss,
                                 transition_sizes(detection.cells), confidence);
    level.uncertain = epistemic_band(data.test_size, hit, data.uncertain, level.hit_miss);
    for (const DetectionCell& cell : detection.cells) {
        if (cell.size.high > 0.0) {
            level.pd.push_back(cell.pd);
        }
    }
    // Only the threshold sample sets thresholds.
    HealthyValues sample{values.thresholds, data.record_gearbox};
    if (!feature.records.empty()) {
        sample.weights = feature.weights;
    }
    const TestValues test{feature.alarm, sample, data.test_size, values.test};
    level.by_rate = level.hit_miss.refusal.empty()
                        ? false_alarm_curve(test, level.hit_miss.supported, confidence)
                        : FalseAlarmCurve{{}, {}, level.hit_miss.refusal};
    level.demonstrated_size =
        demonstrated_size(detection, data.test_size, hit, kReliablePd, confidence);
    return level;
}

FeatureRanking ranking_at(const ReliabilityData& data, std::size_t level, std::size_t levels,
                          double confidence) {
    std::vector<HealthyAndFaulty> values;
    for (const FeatureColumns& feature : data.features) {
        values.push_back(healthy_and_faulty(data, feature, level, levels));
    }
    std::vector<RankedFeature> ranked;
    for (std::size_t f = 0; f < values.size(); ++f) {
        ranked.push_back(
            {data.features[f].name, data.features[f].alarm, values[f].healthy, values[f].faulty});
    }
    return rank_features(ranked, confidence);
}

using Where = SizeEstimate::Where;

// True if `a` finds at least as many faults as `b` in every size group, and both tested the same
// groups, at least one.
bool finds_no_less(const LevelReliability& a, const LevelReliability& b) {
    bool any = false;
    for (std::size_t i = 0; i < a.pd.size(); ++i) {
        if (std::isnan(a.pd[i]) != std::isnan(b.pd[i]) || a.pd[i] < b.pd[i]) {
            return false;
        }
        any |= !std::isnan(a.pd[i]);
    }
    return any;
}

double found(const LevelReliability& reliability) {
    return std::accumulate(reliability.pd.begin(), reliability.pd.end(), 0.0,
                           [](double sum, double pd) { return sum + (std::isnan(pd) ? 0.0 : pd); });
}

}  // namespace

std::vector<LevelReliability> assess_pairs(const ReliabilityData& data,
                                           const std::vector<FeatureDetection>& detections,
                                           const DetectionRequest& request, PairShare share,
                                           int threads) {
    if (detections.size() != data.features.size()) {
        throw std::invalid_argument("reliability: needs one detection per feature");
    }
    const std::size_t levels = request.noise_levels.size(), pairs = data.features.size() * levels;
    const std::size_t count =
        share.first < pairs ? (pairs - share.first + share.step - 1) / share.step : 0;
    const std::vector<std::size_t> group = groups_of(data.test_size, request.groups);
    std::vector<LevelReliability> result(count);
    // Entries are independent, so the results do not depend on the number of threads.
    machine::for_each_index(count, threads, [&](std::size_t i) {
        const std::size_t pair = share.first + i * share.step;
        const std::size_t f = pair / levels, n = pair % levels;
        const FeatureColumns& feature = data.features[f];
        result[i] = assess_level(
            data, feature, level_values(data, feature, group, request.groups.size(), n, levels),
            detections[f].levels[n], request.confidence);
    });
    return result;
}

Reliability assess_reliability(const ReliabilityData& data, const DetectionRequest& request,
                               std::vector<LevelReliability> pairs) {
    const std::size_t levels = request.noise_levels.size();
    Reliability result;
    auto next = pairs.begin();
    for (const FeatureColumns& feature : data.features) {
        result.features.push_back({feature.name, feature.alarm, {}});
        for (std::size_t n = 0; n < levels; ++n) {
            result.features.back().levels.push_back(std::move(*next++));
        }
        for (const ConditionColumn& condition : data.condition) {
            result.conditions.push_back(detect_by_condition(
                feature.name, feature.alarm, {data.healthy_size, feature.healthy},
                {data.test_size, feature.test}, condition, request));
        }
    }
    for (std::size_t n = 0; n < levels; ++n) {
        result.rankings.push_back(ranking_at(data, n, levels, request.confidence));
    }
    return result;
}

Reliability assess_reliability(const ReliabilityData& data,
                               const std::vector<FeatureDetection>& detections,
                               const DetectionRequest& request, int threads) {
    return assess_reliability(data, request, assess_pairs(data, detections, request, {}, threads));
}

std::vector<std::size_t> in_rank_order(const Reliability& reliability, std::size_t level) {
    std::vector<std::size_t> order;
    std::vector<char> taken(reliability.features.size(), 0);
    const auto take = [&](std::size_t f) {
        if (taken[f] == 0) {
            taken[f] = 1;
            order.push_back(f);
        }
    };
    for (const FeatureRank& rank : reliability.rankings[level].ranks) {
        for (std::size_t f = 0; f < reliability.features.size(); ++f) {
            if (reliability.features[f].feature == rank.name) {
                take(f);
            }
        }
    }
    for (std::size_t f = 0; f < reliability.features.size(); ++f) {
        take(f);
    }
    return order;
}

std::optional<SmallestFault> own_smallest_fault(const std::string& feature,
                                                const LevelReliability& reliability) {
    const HitMissPod& pod = reliability.hit_miss;
    const SmallestFault::Source source{feature, reliability.noise_level};
    if (pod.refusal.empty() && !pod.doubtful && pod.a90.upper.where != Where::not_reached) {
        const bool inside = pod.a90.upper.where == Where::reached;
        return SmallestFault{feature, inside ? pod.a90.upper.size : pod.smallest, true, source};
    }
    if (std::isnan(reliability.demonstrated_size)) {
        return std::nullopt;
    }
    return SmallestFault{feature, reliability.demonstrated_size, false, source};
}

std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level,
                                            std::size_t feature) {
    const FeatureReliability& requested_feature = reliability.features[feature];
    const LevelReliability& requested_level = requested_feature.levels[level];
    auto least = own_smallest_fault(requested_feature.feature, requested_level);
    for (const FeatureReliability& other : reliability.features) {
        for (const LevelReliability& there : other.levels) {
            const auto bound = own_smallest_fault(other.feature, there);
            if (bound && (!least || bound->size < least->size) &&
                finds_no_less(requested_level, there)) {
                least = bound;
                least->feature = requested_feature.feature;
                least->from_itself = false;
            }
        }
    }
    return least;
}

std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level) {
    std::optional<SmallestFault> least;
    double most = 0.0;
    for (const std::size_t f : in_rank_order(reliability, level)) {
        const auto fault = smallest_fault(reliability, level, f);
        const double finds = found(reliability.features[f].levels[level]);
        if (fault &&
            (!least || fault->size < least->size || (fault->size == least->size && finds > most))) {
            least = fault;
            most = finds;
        }
    }
    return least;
}

std::optional<SmallestFault> smallest_fault(std::span<const FeatureDetection> detection,
                                            std::size_t level) {
    std::optional<SmallestFault> least;
    double most = 0.0;
    for (const FeatureDetection& feature : detection) {
        const LevelDetection& rates = feature.levels[level];
        const auto size = reliable_size(rates, kReliablePd);
        double finds = 0.0;
        for (const DetectionCell& cell : rates.cells) {
            finds += std::isnan(cell.pd) ? 0.0 : cell.pd;
        }
        if (size &&
            (!least || size->high < least->size || (size->high == least->size && finds > most))) {
            least = SmallestFault{
                feature.feature, size->high, false, {feature.feature, rates.noise_level}, true};
            most = finds;
        }
    }
    return least;
}

}  // namespace gearpod::analysis
