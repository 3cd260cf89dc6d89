// Order of monitored features and detectors by what they find net of chance.
#pragma once

#include <string>

#include "analysis/monitoring/monitor_performance.hpp"

namespace gearpod::analysis {

// Probability with which a detector that alarms at random is taken for one that finds cracks.
inline constexpr double kChanceLevel = 1e-3;

// Share found less the share that false alarms find in lives of the same length: that of the
// healthy lives, or, if none were counted, that of alarms at the stated rate. NaN if unknown.
double net_share(const MonitorPerformance& performance);

// Reason why a detector has no rank, or "": it has no threshold, no tooth fails, its false alarms
// exceed the stated rate (the lower bound of their interval lies above it), or it finds no more
// than chance. The last is a one-sided binomial test at the level kChanceLevel against the
// larger of the share of the healthy lives and that of the stated rate.
std::string why_unranked(const MonitorPerformance& performance, double per_1000_h);

// True if `a` ranks before `b`: it finds more net of chance; or as much at a smaller size (90 %,
// then 50 %); or at equal sizes with fewer false alarms.
bool ranks_before(const MonitorPerformance& a, const MonitorPerformance& b);

}  // namespace gearpod::analysis
