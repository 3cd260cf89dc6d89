#include "analysis/detection/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/detection/false_alarm_rate.hpp"

namespace gearpod::analysis {

Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate) {
    std::erase_if(healthy, [](double value) { return !std::isfinite(value); });
    Threshold threshold;
    threshold.sample = static_cast<long>(healthy.size());
    const long rank = threshold_rank(threshold.sample, false_alarm_rate);
    if (rank > threshold.sample) {
        threshold.value = std::numeric_limits<double>::quiet_NaN();
        return threshold;
    }
    const auto place = healthy.begin() + (rank - 1);
    if (alarm == Alarm::high) {
        std::nth_element(healthy.begin(), place, healthy.end());
    } else {
        std::nth_element(healthy.begin(), place, healthy.end(), std::greater<>());
    }
    threshold.value = *place;
    threshold.alarms = std::count_if(healthy.begin(), healthy.end(), [&](double value) {
        return is_alarm(value, threshold.value, alarm);
    });
    return threshold;
}

bool is_alarm(double value, double threshold, Alarm alarm) {
    return alarm == Alarm::high ? value > threshold : value < threshold;
}

}  // namespace gearpod::analysis
