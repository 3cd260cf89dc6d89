// Report of `lives`: cracks found before tooth failure, their depth, the warning time, and the
// false alarms.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/lives/life_monitor.hpp"

namespace gearpod::mc {

// Headings and cells of the table of results. Columns: threshold, false alarms with their interval,
// share found, share that false alarms alone would find in lives of the same length, net share,
// crack depth found with 50 % and with 90 % probability (with its bound), warning time of 50 % and
// of 90 %.
std::vector<std::string> life_result_columns(const CampaignPlan& plan);
std::vector<std::string> life_result_cells(const analysis::MonitorPerformance& performance,
                                           const CampaignPlan& plan);

// Largest interpolation error between torques and speeds, as a share of the signal and of the
// change made by the smallest crack of interest, with which results are reported.
inline constexpr double kMostInterpolationError = 0.1;
// Reason why the results of a campaign are withheld: its interpolation error; or "".
std::string why_withheld(const CampaignPlan& plan, const Campaign& campaign);

// Sections: headline, results and basis; without the results if they are withheld.
// `shows_withheld`: reports them all the same.
analysis::Report lives_report(const LifeMonitor& monitor, bool shows_withheld);

// Returns the results of one feature and detector: {"feature", "detector", "threshold",
// "threshold_hours", "false_alarms": {"count", "hours", "per_1000_h", "bounds", "dispersion",
// "expected"}, "ended", "found", "share", "share_bounds", "share_by_chance",
// "share_at_stated_rate", "net_share", "unranked" (why it has no rank), "best_of_feature",
// "depth_50_m",
// "effect_depth_m", "early_alarms", "early_hours",
// "depth_50_bound_m", "depth_90_m", "depth_90_bound_m", "warning_50_h", "warning_90_h"}; null as
// below.
nlohmann::json life_result_json(const MonitoredFeature& monitored);

// Returns {"kind": "lives", "title", "interval_h", "record", "baseline_records",
// "first_depth_m", "last_depth_m", "healthy_lives": {"setting", "counting"},
// "false_alarms_per_1000_h" (stated), "failed", "interpolation": {"first_depth_m", "first",
// "last_depth_m", "last", "load", "smallest_depth_m", "change"}, "costs":
// {"gearboxes", "gearbox_s", "records", "record_s"}, "withheld": why_withheld(), null if the
// results are shown, "findings": findings_json() of the report,
// "monitored": [life_result_json() with "alarm_h" (by life that did not fail)], "ranking": [indices
// of "monitored", best first], "trade_offs": [{"feature", "detector", "points":
// [{"stated_per_1000_h", "per_1000_h", "share", "depth_50_m", "depth_90_m"}]}], "fans":
// [{"feature", "healthy_05", "healthy_50", "healthy_95" (by record), "lives": [deviations]}],
// "lives": [{"status", "end_h", "hours", "depth_m"}]}. A value is null if it does not exist, for
// example if fewer than 90 % of the cracks are found.
nlohmann::json lives_json(const LifeMonitor& monitor, bool shows_withheld);

}  // namespace gearpod::mc
