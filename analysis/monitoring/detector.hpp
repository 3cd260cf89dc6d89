// A rule (rules.hpp) with its parameters, how it is written, and what it alarms at.
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
    DetectionRule rule;      // at its start
    bool two_sided = false;  // alarms on falling values too
};

// "single", "2 of 3", "ewma 0.1", "cusum 0.5", "trend 100", each perhaps with " two-sided" behind
// it. Nothing for other text.
std::optional<Detector> parse_detector(std::string_view text);
std::string detector_text(const Detector& detector);
// Ways to write one, for messages: "single, 2 of 3, ...".
std::string detector_forms();

// A detector at work on one gearbox.
class DetectorState {
  public:
    explicit DetectorState(const Detector& detector);
    // The statistic after the next value, of the worse side; -infinity for a value that is NaN,
    // which the rule does not see.
    double next(double value);
    // As at the start.
    void reset();

  private:
    const Detector start_;
    DetectionRule up_, down_;
};

// What a detector says of the values of one gearbox: after each alarm it starts anew.
struct Watch {
    std::vector<std::size_t> alarms;  // places whose statistic lies strictly above the threshold
    // Of all others.
    double largest_quiet = -std::numeric_limits<double>::infinity();
};
Watch watch(const Detector& detector, std::span<const double> values, double threshold);

}  // namespace gearpod::analysis
