// Numbers, rates and features in the words of reports.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/pod_curve.hpp"

namespace gearpod::analysis {

// Kind of the rows of a report, and the words for them.
enum class Subject { gearboxes, recordings };

inline std::string singular(Subject subject) {
    return subject == Subject::gearboxes ? "gearbox" : "recording";
}

inline std::string plural(Subject subject) {
    return subject == Subject::gearboxes ? "gearboxes" : "recordings";
}

// Name of the size where faults have no size, only a label.
inline constexpr const char* kNoSize = "label";
inline bool has_sizes(const DetectionRequest& request) {
    return request.size.name != kNoSize;
}

// Significance level of the tests named in a report.
inline constexpr double kTestLevel = 0.05;

// Number with significant digits and a complete integer part; with an exponent only where that is
// shorter. "-" if it is not finite.
std::string number_text(double value, int digits = 3);
// Probability with two decimals, more next to 0 and 1; with its bounds where they are numbers.
std::string rate_text(double value);
std::string rate_text(double value, double lower, double upper);
std::string rate_text(double value, const Interval& bounds);
// Rate and its bounds in percent, "78 [55, 91]"; bounds are rounded outwards.
std::string percent_rate_text(double value, const Interval& bounds);
// Interval of a rate; with significant digits if it is small. "-" without bounds.
std::string rate_interval_text(const Interval& bounds);
// Area under an ROC with three decimals, and its bounds.
std::string area_text(double area, const Interval& bounds);
std::string p_text(double p);            // "< 0.0001" or two digits
std::string percent_text(double share);  // "95 %"
// Enumeration: "a", "a and b", "a, b and c".
std::string joined(const std::vector<std::string>& texts);
// With the first letter as a capital.
std::string capitalised(std::string text);

// Explains the mark "*" of a size.
inline constexpr const char* kTestedAlone =
    "* a tested size; there is no detection curve for sizes in between.";
// Feature for a headline, in plain language with its name: "the overall vibration level
// (sensor_rms)"; only the name if the program does not define the feature.
std::string feature_text(const std::string& name);
// Number with as many significant digits, at least `digits`, as distinguish it from the other.
std::string distinct_text(double value, double other, int digits);

// Name of a random input without its unit: planet_bearing_stiffness_N_m gives planet bearing
// stiffness.
std::string input_name(const std::string& name, const std::string& unit);
// Unit as shown: none for a pure number.
std::string quantity_unit(const std::string& unit);
// Number with its unit.
std::string quantity_text(double value, const std::string& unit, int digits = 3);

std::string with_unit(double size, const SizeUnit& unit, int digits = 3);  // "1.24 mm"
// For example "0.5 to 1 mm".
std::string range_text(const SizeGroup& range, const SizeUnit& unit);
// "a90, mm"
std::string in_unit(const std::string& name, const SizeUnit& unit);
// Size in the displayed unit, such as "1.24"; "< 0.5" and "> 4.28" beyond the tested sizes.
std::string size_estimate_text(const SizeEstimate& estimate, double smallest, double largest,
                               const SizeUnit& unit, int digits = 3);

}  // namespace gearpod::analysis
