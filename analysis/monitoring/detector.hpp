// Detector: a rule (rules.hpp) with its parameters and its text form, and the alarms it raises.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analysis/monitoring/rules.hpp"

namespace gearpod::analysis {

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
