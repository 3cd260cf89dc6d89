// Detection rules applied to the successive values of one gearbox. Each rule is a state that takes
// the next value and returns a statistic, which alarms above a threshold. Values are deviations
// from normal in standard deviations, larger where the condition is worse.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gearpod::analysis {

// Single value. W. A. Shewhart (1931).
struct SingleRule {
    double next(double value) const { return value; }
};

// m-th largest of the last n values: above a threshold if at least m of the n are.
struct MOfNRule {
    int m = 2, n = 3;
    std::deque<double> last{};

    double next(double value) {
        last.push_back(value);
        if (last.size() > static_cast<std::size_t>(n)) {
            last.pop_front();
        }
        if (last.size() < static_cast<std::size_t>(m)) {
            return -std::numeric_limits<double>::infinity();
        }
        std::vector<double> ordered(last.begin(), last.end());
        const auto nth = ordered.begin() + (m - 1);
        std::nth_element(ordered.begin(), nth, ordered.end(), std::greater<>());
        return *nth;
    }
};

// Exponentially weighted moving average in units of its asymptotic standard deviation. S. W.
// Roberts, Technometrics 1 (1959), 239-250; J. M. Lucas, M. S. Saccucci, Technometrics 32 (1990),
// 1-12.
struct EwmaRule {
    double lambda = 0.1;
    double average = 0.0;

    double next(double value) {
        average += lambda * (value - average);
        return average / std::sqrt(lambda / (2.0 - lambda));
    }
};

// Cumulative sum of the excess over the reference value k, bounded below by 0. E. S. Page,
// Biometrika 41 (1954), 100-115.
struct CusumRule {
    double reference = 0.5;
    double sum = 0.0;

    double next(double value) {
        sum = std::max(0.0, sum + value - reference);
        return sum;
    }
};

// Generalized likelihood ratio of a linear trend that starts at any of the last `window` records,
// against no trend: sqrt(2 ln ratio), standard normal for one given start, 0 where all trends fall.
// T. L. Lai, J. R. Stat. Soc. B 57 (1995), 613-658, with the shift of the mean replaced by a ramp b
// j, j = 1 at its first record: b = sum j x_j / sum j^2, 2 ln ratio = (sum j x_j)^2 / sum j^2.
struct TrendRule {
    int window = 100;
    std::deque<double> last{};

    double next(double value) {
        last.push_front(value);
        if (last.size() > static_cast<std::size_t>(window)) {
            last.pop_back();
        }
        double level = 0.0, ramp = 0.0, largest = 0.0, j = 0.0;
        for (const double earlier : last) {  // from the latest record back; weights grow by one
            level += earlier;
            ramp += level;
            j += 1.0;
            largest = std::max(largest, ramp / std::sqrt(j * (j + 1.0) * (2.0 * j + 1.0) / 6.0));
        }
        return largest;
    }
};

// Detector: a rule with its parameters and its text form, and the alarms it raises.

using DetectionRule = std::variant<SingleRule, MOfNRule, EwmaRule, CusumRule, TrendRule>;

struct Detector {
    DetectionRule rule;      // initial state
    bool two_sided = false;  // also alarms on falling values
};

// Parses "single", "2 of 3", "ewma 0.1", "cusum 0.5" or "trend 100"; "two-sided" may follow after a
// space. Empty for other text.
std::optional<Detector> parse_detector(std::string_view text);
// Accepted forms, for messages: "single, 2 of 3, ...".
std::string detector_forms();

// State of a detector on one gearbox.
class DetectorState {
  public:
    explicit DetectorState(const Detector& detector);
    // Updates the state with the next value and returns the statistic of the worse side. A NaN
    // value leaves the state unchanged and returns -infinity.
    double next(double value);
    // Returns to the initial state.
    void reset();

  private:
    const Detector start_;
    DetectionRule up_, down_;
};

// Alarms of a detector on the values of one gearbox. The detector restarts after each alarm.
struct DetectorAlarms {
    std::vector<std::size_t> alarms;  // indices whose statistic lies strictly above the threshold
    // Largest statistic without an alarm.
    double largest_quiet = -std::numeric_limits<double>::infinity();
};
DetectorAlarms detector_alarms(const Detector& detector, std::span<const double> values,
                               double threshold);

}  // namespace gearpod::analysis
