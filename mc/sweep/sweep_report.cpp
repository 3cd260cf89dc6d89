// Findings of a sweep of `run` in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/report/wording.hpp"
#include "mc/input/find_in.hpp"
#include "mc/sweep/summary.hpp"

namespace gearpod::mc {
namespace {

using analysis::feature_text;
using analysis::number_text;
using analysis::percent_text;
using analysis::Section;
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

std::string smallest_text(const PointSummary& point, const LevelSummary* level) {
    return level == nullptr  ? "-"
           : level->smallest ? analysis::with_unit(level->smallest->size, point.size) +
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
    if (p >= sweep.differences.a90.size() || !sweep.differences.a90[p].refusal.empty()) {
        return "-";
    }
    const analysis::NumberDifference& d = sweep.differences.a90[p];
    const analysis::SizeUnit& unit = sweep.points[p].size;
    const auto bound = [&](double value) {
        return std::isfinite(value) ? signed_text(value, unit) : "open";
    };
    return fmt::format("{} [{}, {}]", signed_text(d.difference(), unit), bound(d.bounds.lower),
                       bound(d.bounds.upper));
}

std::string headline_text(const RunSweep& sweep) {
    const LevelSummary* shown = sweep.points.empty() ? nullptr : shown_level(sweep.points.front());
    if (shown == nullptr) {
        return "The study computes no feature, so there is nothing to detect a fault with.";
    }
    std::vector<const PointSummary*> found;
    std::size_t unknown = 0;
    for (const PointSummary& point : sweep.points) {
        const LevelSummary* level = shown_level(point);
        if (level != nullptr && level->smallest) {
            found.push_back(&point);
        }
        unknown += level != nullptr && !level->has_threshold;
    }
    const std::size_t all = sweep.points.size(), missing = all - found.size() - unknown;
    const std::string begin =
        fmt::format("Smallest fault found with 90 % probability at {} confidence, noise x {}: ",
                    percent_text(sweep.points.front().confidence), number_text(shown->noise_level));
    if (found.empty()) {
        return begin + (unknown == 0
                            ? fmt::format("none in any of {}.", studies_text(all))
                            : fmt::format("no threshold in {} of {}{}.", unknown, studies_text(all),
                                          missing > 0 ? fmt::format(", none in {}", missing) : ""));
    }
    const auto [least, most] = std::ranges::minmax_element(
        found, {}, [](const PointSummary* point) { return shown_level(*point)->smallest->size; });
    const auto at = [&](const PointSummary& point) {
        return fmt::format("{} by {} at {}",
                           analysis::with_unit(shown_level(point)->smallest->size, point.size),
                           feature_text(shown_level(point)->smallest->feature),
                           point_text(sweep.keys, point.point));
    };
    std::string text = begin + at(**least);
    if (shown_level(**most)->smallest->size > shown_level(**least)->smallest->size) {
        text += "; largest " + at(**most);
    }
    text += missing > 0 ? fmt::format("; none in {} of {}", missing, all) : "";
    text += unknown > 0 ? fmt::format("; no threshold in {} of {}", unknown, all) : "";
    return text + ".";
}

// Sentence on the differences of a90 from the smallest one that exceed the scatter.
std::string differences_text(const RunSweep& sweep) {
    const SweepDifferences& all = sweep.differences;
    if (!all.best || sweep.points.size() < 2) {
        return "";
    }
    const PointSummary& best = sweep.points[*all.best];
    std::vector<std::string> within;
    std::size_t larger = 0;
    for (std::size_t p = 0; p < all.a90.size(); ++p) {
        if (p == *all.best || !all.a90[p].refusal.empty()) {
            continue;
        }
        if (all.a90[p].bounds.lower > 0.0) {
            ++larger;
        } else {
            within.push_back(point_text(sweep.keys, sweep.points[p].point));
        }
    }
    const FeatureSummary* feature = find_feature(best, all.feature, shown_level(best)->noise_level);
    const std::string begin = fmt::format(
        "By {} a90 is smallest at {}, {} {}.", feature_text(all.feature),
        point_text(sweep.keys, best.point), a90_text(feature, best.size), best.size.shown_unit());
    if (larger + within.size() == 0) {
        return begin + " No other point has an a90 to compare.";
    }
    return within_scatter_text(begin, "larger", larger, within) +
           fmt::format(
               " Differences: percentiles of {} bootstrap samples of {}, at {} for all pairs "
               "of compared points together (Bonferroni).",
               all.resamples,
               all.paired ? "the gearboxes that the points have in common"
                          : "gearboxes, which differ between some points",
               percent_text(best.confidence));
}

Table points_table(const RunSweep& sweep, const std::set<double>& levels) {
    const PointSummary& first = sweep.points.front();
    const LevelSummary* shown = shown_level(first);
    Table table{"points", "Smallest fault found, by noise", key_columns(sweep.keys), {}};
    table.labels = sweep.keys.size();
    for (const double level : levels) {
        table.columns.push_back("noise x " + number_text(level));
    }
    const std::string at = shown == nullptr ? "" : ", noise x " + number_text(shown->noise_level);
    table.columns.push_back("by" + at);
    table.columns.push_back(analysis::in_unit("its a90", first.size));
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
        row.push_back(a90_text(feature, point.size));
        row.push_back(
            feature == nullptr ? "-" : analysis::area_text(feature->auc.auc, feature->auc.bounds));
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
    section.state("headline", headline_text(sweep));
    section.state("differences", differences_text(sweep));
    std::set<std::string> shortages;
    std::set<double> levels;
    bool tested = false;
    for (const PointSummary& point : sweep.points) {
        if (!point.shortage.empty() && shortages.insert(point.shortage).second) {
            section.state(fmt::format("shortage.{}", shortages.size() - 1), point.shortage);
        }
        for (const LevelSummary& level : point.levels) {
            levels.insert(level.noise_level);
            tested |= level.smallest && !level.smallest->from_curve;
        }
    }
    section.add(points_table(sweep, levels));
    section.state("note.tested", tested ? analysis::kTestedAlone : "");
    return section;
}

// a90 and areas of all features, for the figures.
Section features_section(const RunSweep& sweep) {
    Section section{"features", "", {}};
    const PointSummary& first = sweep.points.front();
    Table table{"features", "a90 and area under the ROC", key_columns(sweep.keys), {}, true};
    table.columns.insert(table.columns.end(),
                         {"feature", analysis::in_unit("a90", first.size), "area under the ROC"});
    for (const PointSummary& point : sweep.points) {
        for (const std::string& name : sweep.order) {
            const LevelSummary* level = shown_level(point);
            if (const auto* feature =
                    level == nullptr ? nullptr : find_feature(point, name, level->noise_level)) {
                std::vector<std::string> row = point.point.labels;
                row.insert(row.end(), {name, a90_text(feature, point.size),
                                       analysis::area_text(feature->auc.auc, feature->auc.bounds)});
                table.rows.push_back(std::move(row));
            }
        }
    }
    section.add(std::move(table));
    return section;
}

}  // namespace

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
