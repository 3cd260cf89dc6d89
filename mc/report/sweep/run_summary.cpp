#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "machine/no_value.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/input/find_in.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

using Json = nlohmann::json;
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
    PointSummary summary{{point, results},
                         counts.all,
                         counts.failed(),
                         frame.request,
                         sample_shortage(frame.detection, frame.request, subject_of(frame)),
                         reference_level(frame.noise_levels),
                         {},
                         {},
                         {}};
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
    all.a90.resize(sweep.points.size(), {kNan, kNan, {}, kNan, "none"});
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
    request.confidence = 1.0 - (1.0 - best.request.confidence) / std::max(1.0, pairs);
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

Json point_json(const RunSweep& sweep, std::size_t p) {
    const PointSummary& point = sweep.points[p];
    const std::string unit = point.size().shown_unit();
    const auto shown = [&](double size) {
        return analysis::number(size / point.size().per_unit());
    };
    Json sizes = Json::array(), smallest = sizes, features = sizes, difference = nullptr;
    for (const double size : point.sizes) {
        sizes.push_back(shown(size));
    }
    for (const LevelSummary& level : point.levels) {
        smallest.push_back({{"noise_level", level.noise_level},
                            {"has_threshold", level.has_threshold},
                            {"size", nullptr}});
        if (level.smallest) {
            smallest.back().update({{"size", shown(level.smallest->size)},
                                    {"feature", level.smallest->feature},
                                    {"from_curve", level.smallest->from_curve}});
        }
    }
    for (const FeatureSummary& f : point.features) {
        const auto size = [&](const analysis::SizeEstimate& estimate) {
            return f.has_curve && estimate.where == Where::reached ? shown(estimate.size)
                                                                   : Json(nullptr);
        };
        features.push_back({{"feature", f.feature},
                            {"noise_level", f.noise_level},
                            {"auc", f.auc.auc},
                            {"auc_lower", f.auc.bounds.lower},
                            {"auc_upper", f.auc.bounds.upper},
                            {"a50", size(f.a50.estimate)},
                            {"a90", size(f.a90.estimate)},
                            {"a90_lower", size(f.a90.lower)},
                            {"a90_bound", size(f.a90.upper)},
                            {"pd", f.pd}});
    }
    if (const analysis::NumberDifference* d = sweep.differences.known(p)) {
        difference = {{"difference", shown(d->difference())},
                      {"lower", shown(d->bounds.lower)},
                      {"upper", shown(d->bounds.upper)}};
    }
    return {{"results", point.results},
            {"values", values_json(sweep.keys, point.point)},
            {"gearboxes", point.gearboxes},
            {"failed", point.failed},
            {"false_alarm_rate", point.request.false_alarm_rate},
            {"confidence", point.request.confidence},
            {"shortage", analysis::text_or_null(point.shortage)},
            {"size_name", point.size().name},
            {"size_unit", unit.empty() ? "1" : unit},
            {"sizes", sizes},
            {"shown_level", point.levels.empty() ? Json(nullptr)
                                                 : Json(point.levels[point.reference].noise_level)},
            {"smallest_fault", smallest},
            {"features", features},
            {"a90_difference", difference}};
}

using analysis::feature_text;
using analysis::number_text;
using analysis::percent_text;
using analysis::Section;
using analysis::Shown;
using analysis::Table;

std::string studies_text(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "study" : "studies");
}

const LevelSummary* find_level(const PointSummary& point, double noise_level) {
    return find_in(point.levels, noise_level, &LevelSummary::noise_level);
}

const LevelSummary* shown_level(const PointSummary& point) {
    return point.levels.empty() ? nullptr : &point.levels[point.reference];
}

const FeatureSummary* find_feature(const PointSummary& point, const std::string& name,
                                   double noise_level) {
    const auto at = std::ranges::find_if(point.features, [&](const FeatureSummary& f) {
        return f.feature == name && f.noise_level == noise_level;
    });
    return at == point.features.end() ? nullptr : &*at;
}

std::string size_text(const FeatureSummary& f, const analysis::SizeEstimate& estimate,
                      const analysis::SizeUnit& unit) {
    return analysis::size_estimate_text(estimate, f.smallest, f.largest, unit);
}

// "1.06 [0.98, > 4.28]"
std::string a90_text(const FeatureSummary* f, const analysis::SizeUnit& unit) {
    return f == nullptr || !f->has_curve
               ? "-"
               : fmt::format("{} [{}, {}]", size_text(*f, f->a90.estimate, unit),
                             size_text(*f, f->a90.lower, unit), size_text(*f, f->a90.upper, unit));
}

std::string area_text(const FeatureSummary* f) {
    return f == nullptr ? "-" : analysis::area_text(f->auc.auc, f->auc.bounds);
}

std::string smallest_text(const PointSummary& point, const LevelSummary* level) {
    return level == nullptr  ? "-"
           : level->smallest ? analysis::with_unit(level->smallest->size, point.size()) +
                                   (level->smallest->from_curve ? "" : "*")
           : level->has_threshold ? "none"
                                  : "no threshold";
}

// Feature that finds the smallest fault, else the best ranked one.
std::string best_feature(const PointSummary& point) {
    const LevelSummary* level = shown_level(point);
    if (level == nullptr) {
        return "";
    }
    if (level->smallest) {
        return level->smallest->feature;
    }
    const auto first =
        std::ranges::find(point.features, level->noise_level, &FeatureSummary::noise_level);
    return first == point.features.end() ? "" : first->feature;
}

std::string signed_text(double value, const analysis::SizeUnit& unit) {
    return (value > 0.0 ? "+" : "") + number_text(value / unit.per_unit());
}

std::string difference_text(const RunSweep& sweep, std::size_t p) {
    if (sweep.differences.best == p) {
        return "smallest";
    }
    const analysis::NumberDifference* d = sweep.differences.known(p);
    if (d == nullptr) {
        return "-";
    }
    const analysis::SizeUnit& unit = sweep.points[p].size();
    const auto bound = [&](double value) {
        return std::isfinite(value) ? signed_text(value, unit) : "open";
    };
    return fmt::format("{} [{}, {}]", signed_text(d->difference(), unit), bound(d->bounds.lower),
                       bound(d->bounds.upper));
}

// Noise at which points are compared, "noise x 1"; "" if no point has any.
std::string noise_text(const RunSweep& sweep) {
    std::set<double> levels;
    for (const PointSummary& point : sweep.points) {
        if (const LevelSummary* level = shown_level(point)) {
            levels.insert(level->noise_level);
        }
    }
    return levels.empty()       ? ""
           : levels.size() == 1 ? "noise x " + number_text(*levels.begin())
                                : "each point at its own noise level";
}

std::string headline_text(const RunSweep& sweep) {
    std::vector<const PointSummary*> found;
    std::vector<std::string> none, unknown, featureless;
    for (const PointSummary& point : sweep.points) {
        const LevelSummary* level = shown_level(point);
        if (level != nullptr && level->smallest) {
            found.push_back(&point);
        } else {
            (level == nullptr       ? featureless
             : level->has_threshold ? none
                                    : unknown)
                .push_back(point_text(sweep.keys, point.point));
        }
    }
    const std::size_t all = sweep.points.size();
    if (featureless.size() == all) {
        return "The study computes no feature, so there is nothing to detect a fault with.";
    }
    std::vector<std::string> parts;
    const auto at = [&](const PointSummary& point) {
        return fmt::format("{} by {} at {}",
                           analysis::with_unit(shown_level(point)->smallest->size, point.size()),
                           feature_text(shown_level(point)->smallest->feature),
                           point_text(sweep.keys, point.point));
    };
    if (!found.empty()) {
        const auto [least, most] = std::ranges::minmax_element(
            found, {},
            [](const PointSummary* point) { return shown_level(*point)->smallest->size; });
        parts.push_back(at(**least));
        if (shown_level(**most)->smallest->size > shown_level(**least)->smallest->size) {
            parts.push_back("largest " + at(**most));
        }
    }
    const auto add = [&](const char* what, const std::vector<std::string>& points) {
        if (points.size() == all) {
            parts.push_back(fmt::format("{} in {} of {}", what, all, studies_text(all)));
        } else if (!points.empty()) {
            parts.push_back(fmt::format("{} in {} of {} ({})", what, points.size(),
                                        studies_text(all), names_text(points)));
        }
    };
    add("none", none);
    add("no threshold", unknown);
    add("no feature", featureless);
    return fmt::format("Smallest fault found with 90 % probability at {} confidence, {}: {}.",
                       percent_text(sweep.points.front().request.confidence), noise_text(sweep),
                       fmt::join(parts, "; "));
}

// Sentence on the differences of a90 from the smallest one that exceed the scatter.
std::string differences_text(const RunSweep& sweep) {
    const SweepDifferences& all = sweep.differences;
    if (!all.best || sweep.points.size() < 2) {
        return "";
    }
    const PointSummary& best = sweep.points[*all.best];
    std::vector<std::string> within, others;
    std::size_t larger = 0;
    for (std::size_t p = 0; p < all.a90.size(); ++p) {
        const analysis::NumberDifference* d = all.known(p);
        if (p == *all.best) {
            continue;
        }
        if (d != nullptr && d->bounds.lower > 0.0) {
            ++larger;
        } else {
            (d != nullptr ? within : others)
                .push_back(point_text(sweep.keys, sweep.points[p].point));
        }
    }
    const FeatureSummary* feature = find_feature(best, all.feature, shown_level(best)->noise_level);
    const std::string begin =
        fmt::format("By {} a90 is smallest at {}, {} {}.", feature_text(all.feature),
                    point_text(sweep.keys, best.point), a90_text(feature, best.size()),
                    best.size().shown_unit());
    if (larger + within.size() == 0) {
        return begin + " No other point has an a90 to compare.";
    }
    return within_scatter_text(begin, "larger", larger, within) +
           (others.empty() ? "" : fmt::format(" Not compared: {}.", names_text(others))) +
           fmt::format(
               " Differences: percentiles of {} bootstrap samples of {}, at {} for all pairs "
               "of compared points together (Bonferroni).",
               all.resamples,
               all.paired ? "the gearboxes that the points have in common"
                          : "gearboxes, which differ between some points",
               percent_text(best.request.confidence));
}

Table points_table(const RunSweep& sweep, const std::set<double>& levels) {
    const PointSummary& first = sweep.points.front();
    Table table{"points", "Smallest fault found, by noise", key_columns(sweep.keys), {}};
    table.labels = sweep.keys.size();
    for (const double level : levels) {
        table.columns.push_back("noise x " + number_text(level));
    }
    const std::string noise = noise_text(sweep);
    table.columns.push_back(noise.empty() ? "by" : "by, " + noise);
    table.columns.push_back(analysis::in_unit("its a90", first.size()));
    table.columns.emplace_back("its area under the ROC");
    if (sweep.differences.best) {
        table.columns.push_back(
            fmt::format("a90 of {} less the smallest", sweep.differences.feature));
    }
    table.columns.insert(table.columns.end(), {"gearboxes", "failed"});
    for (std::size_t p = 0; p < sweep.points.size(); ++p) {
        const PointSummary& point = sweep.points[p];
        std::vector<std::string> row = point.point.labels;
        for (const double level : levels) {
            row.push_back(smallest_text(point, find_level(point, level)));
        }
        const std::string best = best_feature(point);
        const FeatureSummary* feature =
            best.empty() ? nullptr : find_feature(point, best, shown_level(point)->noise_level);
        row.push_back(best.empty() ? "-" : best);
        row.push_back(a90_text(feature, point.size()));
        row.push_back(area_text(feature));
        if (sweep.differences.best) {
            row.push_back(difference_text(sweep, p));
        }
        row.push_back(std::to_string(point.gearboxes));
        row.push_back(std::to_string(point.failed));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Section headline(const RunSweep& sweep) {
    Section section{"headline", "", {}};
    section.state("headline", headline_text(sweep), Shown::screen);
    section.state("differences", differences_text(sweep), Shown::screen);
    std::set<std::string> shortages;
    std::set<double> levels;
    bool tested = false;
    for (const PointSummary& point : sweep.points) {
        if (!point.shortage.empty() && shortages.insert(point.shortage).second) {
            section.state(fmt::format("shortage.{}", shortages.size() - 1), point.shortage,
                          Shown::screen);
        }
        for (const LevelSummary& level : point.levels) {
            levels.insert(level.noise_level);
            tested |= level.smallest && !level.smallest->from_curve;
        }
    }
    Table table = points_table(sweep, levels);
    table.shown = Shown::screen;
    section.add(std::move(table));
    section.state("note.tested", tested ? analysis::kTestedAlone : "", Shown::screen);
    return section;
}

// a90 and areas of all features, for the figures.
Section features_section(const RunSweep& sweep) {
    Section section{"features", "", {}};
    const PointSummary& first = sweep.points.front();
    Table table{"features", "a90 and area under the ROC", key_columns(sweep.keys), {}, Shown::page};
    table.columns.insert(table.columns.end(),
                         {"feature", analysis::in_unit("a90", first.size()), "area under the ROC"});
    for (const PointSummary& point : sweep.points) {
        for (const std::string& name : sweep.order) {
            const LevelSummary* level = shown_level(point);
            const FeatureSummary* feature =
                level == nullptr ? nullptr : find_feature(point, name, level->noise_level);
            std::vector<std::string> row = point.point.labels;
            row.insert(row.end(), {name, a90_text(feature, point.size()), area_text(feature)});
            table.rows.push_back(std::move(row));
        }
    }
    section.add(std::move(table));
    return section;
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

nlohmann::json sweep_json(const RunSweep& sweep) {
    Json points = Json::array();
    for (std::size_t p = 0; p < sweep.points.size(); ++p) {
        points.push_back(point_json(sweep, p));
    }
    return {{"kind", "sweep"},
            {"title", sweep.title},
            {"varied", analysis::json_of(sweep.keys)},
            {"order", sweep.order},
            {"findings", findings_json(sweep_report(sweep))},
            {"points", points}};
}

analysis::Report sweep_report(const RunSweep& sweep) {
    analysis::Report report;
    if (!sweep.points.empty()) {
        report.add(headline(sweep));
        report.add(features_section(sweep));
        report.add(files_section(sweep.keys, {sweep.points.begin(), sweep.points.end()}));
    }
    return report;
}

}  // namespace gearpod::mc
