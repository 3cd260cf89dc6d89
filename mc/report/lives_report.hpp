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

// Results of one feature and detector, and of a campaign; docs/reference/report-json.md lists the
// keys. A value is null if it does not exist, for example if fewer than 90 % of the cracks are
// found.
nlohmann::json life_result_json(const MonitoredFeature& monitored);
nlohmann::json lives_json(const LifeMonitor& monitor, bool shows_withheld);

}  // namespace gearpod::mc
