// Numbers given as text, for the options of all commands: in decimal notation with a point, finite,
// within a range, with nothing before or after the number.
#pragma once

#include <limits>
#include <string>

namespace gearpod::mc {

// Values that are accepted. The unit appears in messages.
struct NumberRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool without_low = false;  // true if `low` itself is refused
    std::string unit = {};
};
NumberRange from_to(double low, double high, const std::string& unit = "");
NumberRange at_least(double low, const std::string& unit = "");
NumberRange above(double low, const std::string& unit = "");

// "0.5 to 0.9999", "above 0 Hz"; "" without bounds.
std::string range_text(const NumberRange& range);

enum class NumberForm { real, whole };

// Reason why the text is no number of this form and range, for example "nan is not a finite
// number", or "".
std::string number_problem(const std::string& text, NumberForm form, const NumberRange& range);

// Values of texts without a problem.
double real_number(const std::string& text);
long whole_number(const std::string& text);

}  // namespace gearpod::mc
