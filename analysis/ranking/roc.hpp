// Receiver operating characteristic (ROC): detection rate of the faulty gearboxes against
// false-alarm rate of the healthy ones, over all thresholds. T. Fawcett, Pattern Recognit. Lett. 27
// (2006), 861-874.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::analysis {

struct RocPoint {
    double false_alarm_rate = 0.0;
    double detection_rate = 0.0;
};

// Curve from (0, 0) to (1, 1) with a corner for each threshold. Tied values are joined by a
// straight line, so that the trapezoidal area equals that of auc(). Corners in excess of
// `most_points` (two or more) are removed evenly along the curve. Values that are not finite are
// left out. With `high` false, low values alarm. Empty without a value of either kind.
std::vector<RocPoint> roc_curve(std::span<const double> healthy, std::span<const double> faulty,
                                bool high, std::size_t most_points = 101);

}  // namespace gearpod::analysis
