#include "analysis/ranking/roc.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace gearpod::analysis {
namespace {

// Finite values, the most alarming first.
std::vector<double> from_alarm_side(std::span<const double> values, bool high) {
    std::vector<double> sorted;
    for (const double value : values) {
        if (std::isfinite(value)) {
            sorted.push_back(high ? value : -value);
        }
    }
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    return sorted;
}

std::vector<RocPoint> corners(const std::vector<double>& healthy,
                              const std::vector<double>& faulty) {
    std::vector<RocPoint> points{{0.0, 0.0}};
    std::size_t h = 0, f = 0;
    while (h < healthy.size() || f < faulty.size()) {
        const double next = std::max(h < healthy.size() ? healthy[h] : -HUGE_VAL,
                                     f < faulty.size() ? faulty[f] : -HUGE_VAL);
        while (h < healthy.size() && healthy[h] == next) {
            ++h;
        }
        while (f < faulty.size() && faulty[f] == next) {
            ++f;
        }
        points.push_back({static_cast<double>(h) / static_cast<double>(healthy.size()),
                          static_cast<double>(f) / static_cast<double>(faulty.size())});
    }
    return points;
}

double way(const RocPoint& point) {
    return 0.5 * (point.false_alarm_rate + point.detection_rate);
}

// Corners nearest to `most` points that divide the path from (0, 0) to (1, 1) evenly.
std::vector<RocPoint> thinned(const std::vector<RocPoint>& points, std::size_t most) {
    std::vector<RocPoint> kept;
    std::size_t at = 0, last = points.size();
    for (std::size_t place = 0; place < most; ++place) {
        const double target = static_cast<double>(place) / static_cast<double>(most - 1);
        while (at + 1 < points.size() && way(points[at]) < target) {
            ++at;
        }
        const bool before = at > 0 && target - way(points[at - 1]) < way(points[at]) - target;
        const std::size_t nearest = before ? at - 1 : at;
        if (nearest != last) {
            kept.push_back(points[nearest]);
            last = nearest;
        }
    }
    return kept;
}

}  // namespace

std::vector<RocPoint> roc_curve(std::span<const double> healthy, std::span<const double> faulty,
                                bool high, std::size_t most_points) {
    const std::vector<double> below = from_alarm_side(healthy, high);
    const std::vector<double> beyond = from_alarm_side(faulty, high);
    if (below.empty() || beyond.empty()) {
        return {};
    }
    const std::vector<RocPoint> points = corners(below, beyond);
    return points.size() <= most_points ? points : thinned(points, most_points);
}

}  // namespace gearpod::analysis
