#include "analysis/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace gearpod::analysis {

Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate) {
    std::erase_if(healthy, [](double value) { return !std::isfinite(value); });
    Threshold threshold;
    threshold.sample = static_cast<long>(healthy.size());
    // (n+1)(1-rate) is a whole number for the usual rates: keep rounding from adding one to it.
    constexpr double kRounding = 1e-9;
    const double exact = static_cast<double>(threshold.sample + 1) * (1.0 - false_alarm_rate);
    const long rank = std::max(1L, static_cast<long>(std::ceil(exact - kRounding)));
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
