#include "mc/files/input/number_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

// Reads the whole text. std::from_chars accepts no plus sign, blank or hexadecimal prefix.
template <class Number>
std::errc read_whole_text(std::string_view text, Number& number) {
    if (text.starts_with('+') && !text.starts_with("+-")) {
        text.remove_prefix(1);
    }
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return stop == end ? error : std::errc::invalid_argument;
}

std::string unit_text(const NumberRange& range) {
    return range.unit.empty() ? "" : " " + range.unit;
}

std::string notation_problem(const std::string& text, NumberForm form) {
    double real = 0.0;
    const std::string shown = printable(text);
    if (text.empty()) {
        return "the number is missing";
    }
    const std::errc error = read_whole_text(text, real);
    if (error == std::errc::result_out_of_range) {
        return shown + " is beyond the range of numbers in double precision";
    }
    if (error == std::errc() && !std::isfinite(real)) {
        return shown + " is not a finite number";
    }
    if (error == std::errc()) {
        return form == NumberForm::real ? ""
               : real == std::floor(real) && std::abs(real) < 1e15
                   ? fmt::format("{} is not written as a whole number; write {:.0f}", shown, real)
                   : shown + " is not a whole number";
    }
    std::string with_point = text;
    if (const std::size_t comma = with_point.find(','); comma != std::string::npos) {
        with_point[comma] = '.';
        if (read_whole_text(with_point, real) == std::errc()) {
            return fmt::format("{} is not a number; the decimal separator is a point", shown);
        }
    }
    return fmt::format("\"{}\" is not a number in decimal notation", shown);
}

}  // namespace

std::string range_text(const NumberRange& range) {
    // Bounds of the number types are no bounds of the option.
    constexpr double kInt = 2147483647.0;
    const bool low = range.low > -kInt - 1.0, high = range.high < kInt;
    const std::string unit = unit_text(range);
    if (low && high) {
        return range.without_low
                   ? fmt::format("above {}, at most {}{}", range.low, range.high, unit)
                   : fmt::format("{} to {}{}", range.low, range.high, unit);
    }
    if (low) {
        return fmt::format("{} {}{}", range.without_low ? "above" : "at least", range.low, unit);
    }
    return high ? fmt::format("at most {}{}", range.high, unit) : "";
}

NumberRange from_to(double low, double high, const std::string& unit) {
    return {low, high, false, unit};
}

NumberRange at_least(double low, const std::string& unit) {
    return {low, std::numeric_limits<double>::infinity(), false, unit};
}

NumberRange above(double low, const std::string& unit) {
    return {low, std::numeric_limits<double>::infinity(), true, unit};
}

std::string number_problem(const std::string& text, NumberForm form, const NumberRange& range) {
    double value = 0.0;
    if (form == NumberForm::whole) {
        long whole = 0;
        const std::errc error = read_whole_text(text, whole);
        if (error == std::errc::result_out_of_range) {
            return printable(text) + " is beyond the range of whole numbers";
        }
        if (error != std::errc()) {
            return notation_problem(text, form);
        }
        value = static_cast<double>(whole);
    } else {
        if (std::string problem = notation_problem(text, form); !problem.empty()) {
            return problem;
        }
        value = real_number(text);
    }
    const bool good =
        (range.without_low ? value > range.low : value >= range.low) && value <= range.high;
    if (good) {
        return "";
    }
    const std::string bounds = range_text(range);
    return bounds.empty() ? printable(text) + " is beyond the range of whole numbers"
                          : fmt::format("must be {}, but is {}", bounds, printable(text));
}

double real_number(const std::string& text) {
    double value = 0.0;
    read_whole_text(text, value);
    return value;
}

long whole_number(const std::string& text) {
    long value = 0;
    read_whole_text(text, value);
    return value;
}

}  // namespace gearpod::mc
