#include "mc/sweep/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report/false_alarm_text.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/report/failures.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/sweep/compared_results.hpp"

namespace gearpod::mc {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Where = analysis::SizeEstimate::Where;

void add_levels(const Results& frame, const analysis::Reliability& reliability,
                PointSummary& summary) {
    for (std::size_t n = 0; n < frame.noise_levels.size(); ++n) {
        summary.levels.push_back({frame.noise_levels[n], !without_threshold(frame.detection, n),
                                  smallest_fault(reliability, n)});
        for (const std::size_t f : in_rank_order(reliability, n)) {
            const analysis::FeatureReliability& feature = reliability.features[f];
            const analysis::LevelReliability& at = feature.levels[n];
            const analysis::HitMissPod& pod = at.hit_miss;
            summary.features.push_back({feature.feature, frame.noise_levels[n], at.auc,
                                        pod.refusal.empty(), pod.a50, pod.a90, pod.smallest,
                                        pod.largest, at.pd});
        }
    }
}

PointSummary summarise(const SweepPoint& point, const std::string& results, int threads) {
    Results frame = read_frame(results);
    const FileRows rows(results, frame);
    check_results(results, frame, rows);
    frame.detection = detect_all(frame, rows);
    const RowCounts counts = count_rows(rows, frame.request.threshold_records);
    PointSummary summary;
    summary.point = point;
    summary.results = results;
    summary.gearboxes = counts.all;
    summary.failed = counts.failed();
    summary.size = frame.request.size;
    summary.false_alarm_rate = frame.request.false_alarm_rate;
    summary.confidence = frame.request.confidence;
    summary.shortage = analysis::sample_shortage(frame.detection, frame.request, subject_of(frame));
    summary.reference = reference_level(frame.noise_levels);
    for (const analysis::SizeGroup& group : frame.request.groups) {
        if (group.high > 0.0) {
            summary.sizes.push_back(group.high);
        }
    }
    if (const auto reliability = reliability_of(frame, rows, "", threads)) {
        add_levels(frame, *reliability, summary);
    }
    return summary;
}

// Features in order of how often they find the smallest fault, then of their area.
std::vector<std::string> feature_order(const std::vector<PointSummary>& points) {
    std::map<std::string, std::pair<int, double>> score;
    for (const PointSummary& point : points) {
        if (point.levels.empty()) {
            continue;
        }
        const LevelSummary& shown = point.levels[point.reference];
        for (const FeatureSummary& feature : point.features) {
            if (feature.noise_level == shown.noise_level) {
                auto& [leads, area] = score[feature.feature];
                leads += shown.smallest && shown.smallest->feature == feature.feature;
                area += std::isnan(feature.auc.auc) ? 0.0 : feature.auc.auc;
            }
        }
    }
    std::vector<std::string> order;
    for (const auto& [name, value] : score) {
        order.push_back(name);
    }
    std::ranges::stable_sort(order,
                             [&](const auto& a, const auto& b) { return score[a] > score[b]; });
    return order;
}

// a90 of the feature at the noise level shown; infinite where there is none.
double shown_a90(const PointSummary& point, const std::string& name) {
    for (const FeatureSummary& feature : point.features) {
        if (feature.feature == name && feature.has_curve &&
            feature.noise_level == point.levels[point.reference].noise_level &&
            feature.a90.estimate.where == Where::reached) {
            return feature.a90.estimate.size;
        }
    }
    return std::numeric_limits<double>::infinity();
}

// Compares the points of smallest a90 with the best. The intervals hold for all pairs of them
// together (Bonferroni), because the best is chosen from the same data.
SweepDifferences find_differences(const RunSweep& sweep) {
    constexpr std::size_t kMostCompared = 12;
    constexpr int kLeastResamples = 400;
    SweepDifferences all;
    if (sweep.order.empty()) {
        return all;
    }
    all.feature = sweep.order.front();
    all.a90.resize(sweep.points.size(),
                   {analysis::kNan, analysis::kNan, {}, analysis::kNan, "none"});
    std::vector<std::pair<double, std::size_t>> known;
    for (std::size_t p = 0; p < sweep.points.size(); ++p) {
        if (const double a90 = shown_a90(sweep.points[p], all.feature); std::isfinite(a90)) {
            known.emplace_back(a90, p);
        }
    }
    if (known.empty()) {
        return all;
    }
    std::ranges::sort(known);
    known.resize(std::min(known.size(), kMostCompared));
    all.best = known.front().second;
    const PointSummary& best = sweep.points[*all.best];
    const double level = best.levels[best.reference].noise_level;
    const double pairs = 0.5 * static_cast<double>(known.size() * (known.size() - 1));
    analysis::ComparisonRequest request;
    request.confidence = 1.0 - (1.0 - best.confidence) / std::max(1.0, pairs);
    request.resamples = all.resamples =
        std::max(kLeastResamples, static_cast<int>(std::ceil(4.0 / (1.0 - request.confidence))));
    const ComparedSide first = read_compared(best.results);
    for (std::size_t i = 1; i < known.size(); ++i) {
        const std::size_t p = known[i].second;
        const ComparedSide second = read_compared(sweep.points[p].results);
        if (!mismatch(first, second).empty()) {
            continue;
        }
        analysis::ComparedFile file;
        compare_with(first, second, request, {all.feature, level}, file);
        if (!file.features.empty()) {
            all.a90[p] = file.features.front().comparison.a90;
            all.paired = all.paired && file.unpaired.empty();
        }
    }
    return all;
}

// Size in the unit shown; null where it is not reached.
OrderedJson size_json(const FeatureSummary& feature, const analysis::SizeEstimate& estimate,
                      const analysis::SizeUnit& unit) {
    return feature.has_curve && estimate.where == Where::reached
               ? OrderedJson(estimate.size / unit.per_unit())
               : OrderedJson(nullptr);
}

OrderedJson feature_json(const FeatureSummary& f, const analysis::SizeUnit& unit) {
    return {{"feature", f.feature},
            {"noise_level", f.noise_level},
            {"auc", f.auc.auc},
            {"auc_lower", f.auc.bounds.lower},
            {"auc_upper", f.auc.bounds.upper},
            {"a50", size_json(f, f.a50.estimate, unit)},
            {"a90", size_json(f, f.a90.estimate, unit)},
            {"a90_lower", size_json(f, f.a90.lower, unit)},
            {"a90_bound", size_json(f, f.a90.upper, unit)},
            {"pd", f.pd}};
}

OrderedJson point_json(const RunSweep& sweep, std::size_t p) {
    const PointSummary& point = sweep.points[p];
    const std::string unit = point.size.shown_unit();
    OrderedJson one{{"results", point.results}};
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
        one["values"][sweep.keys[k].key] = point.point.values[k];
    }
    one["gearboxes"] = point.gearboxes;
    one["failed"] = point.failed;
    one["false_alarm_rate"] = point.false_alarm_rate;
    one["confidence"] = point.confidence;
    one["shortage"] = point.shortage.empty() ? OrderedJson(nullptr) : OrderedJson(point.shortage);
    one["size_name"] = point.size.name;
    one["size_unit"] = unit.empty() ? "1" : unit;
    one["sizes"] = OrderedJson::array();
    for (const double size : point.sizes) {
        one["sizes"].push_back(size / point.size.per_unit());
    }
    one["shown_level"] = point.levels.empty()
                             ? OrderedJson(nullptr)
                             : OrderedJson(point.levels[point.reference].noise_level);
    one["smallest_fault"] = OrderedJson::array();
    for (const LevelSummary& level : point.levels) {
        OrderedJson at{{"noise_level", level.noise_level},
                       {"has_threshold", level.has_threshold},
                       {"size", nullptr}};
        if (level.smallest) {
            at["size"] = level.smallest->size / point.size.per_unit();
            at["feature"] = level.smallest->feature;
            at["from_curve"] = level.smallest->from_curve;
        }
        one["smallest_fault"].push_back(std::move(at));
    }
    one["features"] = OrderedJson::array();
    for (const FeatureSummary& f : point.features) {
        one["features"].push_back(feature_json(f, point.size));
    }
    one["a90_difference"] = nullptr;
    if (p < sweep.differences.a90.size() && sweep.differences.a90[p].refusal.empty()) {
        const analysis::NumberDifference& d = sweep.differences.a90[p];
        const auto shown = [&](double value) {
            return std::isfinite(value) ? OrderedJson(value / point.size.per_unit())
                                        : OrderedJson(nullptr);
        };
        one["a90_difference"] = {{"difference", shown(d.difference())},
                                 {"lower", shown(d.bounds.lower)},
                                 {"upper", shown(d.bounds.upper)}};
    }
    return one;
}

}  // namespace

RunSweep summarise_runs(const std::string& title, const std::vector<VariedKey>& keys,
                        const std::vector<SweepPoint>& points,
                        const std::vector<std::string>& results, int threads) {
    RunSweep sweep{title, keys, {}, {}, {}};
    for (std::size_t p = 0; p < points.size(); ++p) {
        sweep.points.push_back(summarise(points[p], results[p], threads));
    }
    sweep.order = feature_order(sweep.points);
    sweep.differences = find_differences(sweep);
    return sweep;
}

nlohmann::ordered_json sweep_json(const RunSweep& sweep) {
    OrderedJson json{{"kind", "sweep"},
                     {"title", sweep.title},
                     {"varied", OrderedJson::array()},
                     {"order", sweep.order},
                     {"findings", OrderedJson(analysis::findings_json(sweep_report(sweep)))},
                     {"points", OrderedJson::array()}};
    for (const VariedKey& key : sweep.keys) {
        json["varied"].push_back({{"key", key.key}, {"values", key.values}});
    }
    for (std::size_t p = 0; p < sweep.points.size(); ++p) {
        json["points"].push_back(point_json(sweep, p));
    }
    return json;
}

}  // namespace gearpod::mc
