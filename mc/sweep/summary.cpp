#include "mc/sweep/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/text_lines.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/report/example_gearboxes.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/summary/run_report.hpp"
#include "mc/sweep/columns.hpp"

namespace gearpod::mc {
namespace {

using OrderedJson = nlohmann::ordered_json;

double size_or_nan(const analysis::SizeEstimate& estimate, double scale) {
    return estimate.where == analysis::SizeEstimate::Where::reached
               ? scale * estimate.size
               : std::numeric_limits<double>::quiet_NaN();
}

void add_levels(const Results& frame, const analysis::Reliability& reliability,
                PointSummary& summary) {
    const double scale = 1.0 / frame.request.size.per_unit();
    for (std::size_t n = 0; n < frame.noise_levels.size(); ++n) {
        LevelSummary level{frame.noise_levels[n], !without_threshold(reliability, n),
                           smallest_fault(reliability, n)};
        if (level.smallest) {
            level.smallest->size *= scale;
        }
        summary.levels.push_back(std::move(level));
        for (const std::size_t f : in_rank_order(reliability, n)) {
            const analysis::FeatureReliability& feature = reliability.features[f];
            const analysis::LevelReliability& at = feature.levels[n];
            const bool curve = at.hit_miss.refusal.empty();
            const auto size = [&](const analysis::SizeEstimate& estimate) {
                return curve ? size_or_nan(estimate, scale)
                             : std::numeric_limits<double>::quiet_NaN();
            };
            summary.features.push_back({feature.feature, frame.noise_levels[n], at.auc,
                                        size(at.hit_miss.a50.estimate),
                                        size(at.hit_miss.a90.estimate), size(at.hit_miss.a90.lower),
                                        size(at.hit_miss.a90.upper), at.pd});
        }
    }
}

std::string size_cell(const PointSummary& point, double noise_level) {
    const auto at = std::ranges::find(point.levels, noise_level, &LevelSummary::noise_level);
    if (at == point.levels.end()) {
        return "";
    }
    if (!at->smallest) {
        return at->has_threshold ? "none" : "?";
    }
    return fmt::format("{:.3g}{}{}", at->smallest->size, point.unit.empty() ? "" : " ", point.unit);
}

// Best feature at the noise level that is shown first, with its AUC.
std::string best_cell(const PointSummary& point) {
    if (point.levels.empty()) {
        return "";
    }
    const LevelSummary& level = point.levels[point.reference];
    for (const FeatureSummary& feature : point.features) {
        if (feature.noise_level == level.noise_level &&
            (!level.smallest || feature.feature == level.smallest->feature)) {
            return fmt::format("{} ({:.3f})", feature.feature, feature.auc.auc);
        }
    }
    return "";
}

// Warnings of all points, without duplicates.
std::string shortages(const std::vector<PointSummary>& points) {
    std::vector<std::string> printed;
    std::string text;
    for (const PointSummary& point : points) {
        if (!point.shortage.empty() && std::ranges::count(printed, point.shortage) == 0) {
            printed.push_back(point.shortage);
            analysis::add_wrapped(text, point.shortage, 2);
        }
    }
    return text;
}

}  // namespace

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
    summary.size_name = frame.request.size.name;
    summary.unit = frame.request.size.shown_unit();
    summary.false_alarm_rate = frame.request.false_alarm_rate;
    summary.confidence = frame.request.confidence;
    summary.shortage = analysis::sample_shortage(frame.detection, frame.request, subject_of(frame));
    summary.reference = reference_level(frame.noise_levels);
    for (const analysis::SizeGroup& group : frame.request.groups) {
        if (group.high > 0.0) {
            summary.sizes.push_back(group.high / frame.request.size.per_unit());
        }
    }
    if (const auto reliability = reliability_of(frame, rows, "", threads)) {
        add_levels(frame, *reliability, summary);
    }
    return summary;
}

std::string sweep_text(const std::vector<VariedKey>& keys,
                       const std::vector<PointSummary>& points) {
    std::set<double> levels;
    for (const PointSummary& point : points) {
        for (const LevelSummary& level : point.levels) {
            levels.insert(level.noise_level);
        }
    }
    std::vector<std::vector<std::string>> lines(1);
    for (const VariedKey& key : keys) {
        lines[0].push_back(short_key(key.key));
    }
    lines[0].insert(lines[0].end(), {"gearboxes", "failed"});
    for (const double level : levels) {
        lines[0].push_back(fmt::format("noise x {:g}", level));
    }
    const bool any = !points.empty() && !points[0].levels.empty();
    lines[0].push_back(any ? fmt::format("feature (AUC), noise x {:g}",
                                         points[0].levels[points[0].reference].noise_level)
                           : "");
    for (const PointSummary& point : points) {
        std::vector<std::string> line = point.point.values;
        line.push_back(std::to_string(point.gearboxes));
        line.push_back(std::to_string(point.failed));
        for (const double level : levels) {
            line.push_back(size_cell(point, level));
        }
        line.push_back(best_cell(point));
        lines.push_back(std::move(line));
    }
    return shortages(points) +
           fmt::format(
               "smallest fault found with 90 % probability at {:g} % confidence, by noise level\n",
               points.empty() ? 0.0 : 100.0 * points[0].confidence) +
           aligned_columns(lines) +
           "none: no tested fault is found; ?: too few healthy gearboxes for a threshold\n";
}

nlohmann::ordered_json sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                  const std::vector<PointSummary>& points) {
    OrderedJson json{{"kind", "sweep"},
                     {"title", title},
                     {"varied", OrderedJson::array()},
                     {"points", OrderedJson::array()}};
    for (const VariedKey& key : keys) {
        json["varied"].push_back({{"key", key.key}, {"values", key.values}});
    }
    for (const PointSummary& point : points) {
        OrderedJson one{{"results", point.results}};
        for (std::size_t k = 0; k < keys.size(); ++k) {
            one["values"][keys[k].key] = point.point.values[k];
        }
        one["gearboxes"] = point.gearboxes;
        one["failed"] = point.failed;
        one["false_alarm_rate"] = point.false_alarm_rate;
        one["confidence"] = point.confidence;
        one["shortage"] =
            point.shortage.empty() ? OrderedJson(nullptr) : OrderedJson(point.shortage);
        one["size_name"] = point.size_name;
        one["size_unit"] = point.unit.empty() ? "1" : point.unit;
        one["sizes"] = point.sizes;
        one["shown_level"] = point.levels.empty()
                                 ? OrderedJson(nullptr)
                                 : OrderedJson(point.levels[point.reference].noise_level);
        one["smallest_fault"] = OrderedJson::array();
        for (const LevelSummary& level : point.levels) {
            OrderedJson at{{"noise_level", level.noise_level},
                           {"has_threshold", level.has_threshold},
                           {"size", nullptr}};
            if (level.smallest) {
                at["size"] = level.smallest->size;
                at["feature"] = level.smallest->feature;
                at["from_curve"] = level.smallest->from_curve;
            }
            one["smallest_fault"].push_back(std::move(at));
        }
        one["features"] = OrderedJson::array();
        for (const FeatureSummary& f : point.features) {
            one["features"].push_back({{"feature", f.feature},
                                       {"noise_level", f.noise_level},
                                       {"auc", f.auc.auc},
                                       {"auc_lower", f.auc.bounds.lower},
                                       {"auc_upper", f.auc.bounds.upper},
                                       {"a50", f.a50},
                                       {"a90", f.a90},
                                       {"a90_lower", f.a90_lower},
                                       {"a90_bound", f.a90_bound},
                                       {"pd", f.pd}});
        }
        json["points"].push_back(std::move(one));
    }
    return json;
}

}  // namespace gearpod::mc
