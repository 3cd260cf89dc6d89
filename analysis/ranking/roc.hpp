// Receiver operating characteristic: which share of the faulty gearboxes a threshold finds, against
// the share of healthy ones that it calls faulty. T. Fawcett, Pattern Recognit. Lett. 27 (2006),
// 861-874.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::analysis {

struct RocPoint {
    double false_alarm_rate = 0.0;
    double detection_rate = 0.0;
};

// From (0, 0) to (1, 1), a corner for each threshold; gearboxes of equal value join with a straight
// line, so that the area below (trapezoids) is auc()'s. Beyond `most_points` (two or more) corners
// are left out evenly along the curve. Values that are not finite are left out; `high` false: low
// values alarm. Empty without a value of either kind.
std::vector<RocPoint> roc_curve(std::span<const double> healthy, std::span<const double> faulty,
                                bool high, std::size_t most_points = 101);

}  // namespace gearpod::analysis
