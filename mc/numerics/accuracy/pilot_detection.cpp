#include "mc/numerics/accuracy/pilot_detection.hpp"

#include <algorithm>
#include <cmath>

#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

using analysis::SizeEstimate;

// True if a value raises the alarm.
bool alarm(const analysis::FeatureDetection& feature, std::size_t level, double value) {
    return analysis::is_alarm(value, feature.levels[level].threshold, feature.alarm);
}

double share_of_alarms_changed(const Results& a, const Results& b) {
    const std::size_t levels = a.noise_levels.size();
    long changed = 0, all = 0;
    for (std::size_t f = 0; f < a.features.size(); ++f) {
        for (std::size_t row = 0; row < a.group.size(); ++row) {
            if (a.group[row] != static_cast<int>(Group::test)) {
                continue;
            }
            for (std::size_t level = 0; level < levels; ++level) {
                const std::size_t value = row * levels + level;
                changed += alarm(a.detection[f], level, a.features[f].values[value]) !=
                                   alarm(b.detection[f], level, b.features[f].values[value])
                               ? 1
                               : 0;
                ++all;
            }
        }
    }
    return all > 0 ? static_cast<double>(changed) / static_cast<double>(all) : 0.0;
}

void compare_rates(const Results& here, const Results& reference, DetectionChange& change) {
    for (std::size_t f = 0; f < reference.detection.size(); ++f) {
        for (std::size_t level = 0; level < reference.noise_levels.size(); ++level) {
            const auto& cells = reference.detection[f].levels[level].cells;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const double moved =
                    std::abs(here.detection[f].levels[level].cells[c].pd - cells[c].pd);
                if (moved > change.pd || change.pd_half_width == 0.0) {
                    change.pd = std::max(change.pd, moved);
                    change.pd_half_width = 0.5 * (cells[c].upper - cells[c].lower);
                }
            }
        }
    }
}

bool reached(const SizeEstimate& estimate) {
    return estimate.where == SizeEstimate::Where::reached;
}

void compare_sizes(const analysis::Reliability& here, const analysis::Reliability& reference,
                   DetectionChange& change) {
    for (std::size_t f = 0; f < reference.features.size(); ++f) {
        for (std::size_t level = 0; level < reference.features[f].levels.size(); ++level) {
            const auto& there = reference.features[f].levels[level].hit_miss;
            const auto& compared = here.features[f].levels[level].hit_miss;
            if (!there.refusal.empty() || !compared.refusal.empty() ||
                !reached(there.a90.estimate) || !reached(compared.a90.estimate)) {
                continue;
            }
            const double a90 = there.a90.estimate.size;
            const double moved = std::abs(compared.a90.estimate.size - a90) / a90;
            if (moved > change.a90) {
                change.a90 = moved;
                change.a90_interval =
                    reached(there.a90.upper) ? (there.a90.upper.size - a90) / a90 : INFINITY;
            }
        }
    }
}

}  // namespace

PilotEnsemble run_pilot_ensemble(const TilePlan& tile, const EnsemblePlan& ensemble) {
    Progress silent(1, true);
    PilotEnsemble pilot;
    pilot.results = run_ensemble(tile, ensemble, silent);
    pilot.results.detection = detect_all(pilot.results);
    pilot.reliability =
        reliability_of(pilot.results, ColumnRows(pilot.results), "", thread_count(ensemble));
    return pilot;
}

bool has_rates(const PilotEnsemble& pilot) {
    const auto has_threshold = [](const analysis::LevelDetection& level) {
        return std::isfinite(level.threshold);
    };
    return std::any_of(pilot.results.detection.begin(), pilot.results.detection.end(),
                       [&](const analysis::FeatureDetection& feature) {
                           return std::any_of(feature.levels.begin(), feature.levels.end(),
                                              has_threshold);
                       });
}

DetectionChange detection_change(const PilotEnsemble& here, const PilotEnsemble& reference) {
    DetectionChange change;
    change.gearboxes = std::count(reference.results.group.begin(), reference.results.group.end(),
                                  static_cast<int>(Group::test));
    change.alarms = share_of_alarms_changed(here.results, reference.results);
    compare_rates(here.results, reference.results, change);
    if (here.reliability && reference.reliability) {
        compare_sizes(*here.reliability, *reference.reliability, change);
    }
    return change;
}

}  // namespace gearpod::mc
