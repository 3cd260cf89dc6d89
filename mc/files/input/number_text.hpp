// Number in a text that holds nothing else.
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace gearpod::mc {

// Number that takes the whole text, as std::from_chars() reads it: without a plus sign, blanks or a
// hexadecimal prefix.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

// Numbers given as text, for the options of all commands: in decimal notation with a point, finite,
// within a range, with nothing before or after the number.

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
