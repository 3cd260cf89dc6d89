// Options with numbers, which all commands read by the rules of mc/input/number_text.hpp.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "mc/input/number_text.hpp"

namespace gearpod::mc {

// Check of CLI11 with number_problem(); its description is the range.
CLI::Validator number_check(NumberForm form, NumberRange range);

// Type of a number that may be optional.
template <class Value>
struct NumberOf {
    using type = Value;
};
template <class Value>
struct NumberOf<std::optional<Value>> {
    using type = Value;
};

// Adds an option with a number: double, int or long, or std::optional of these.
template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& name, Value& target,
                        const std::string& description, NumberRange range = {}) {
    using Number = typename NumberOf<Value>::type;
    constexpr bool kWhole = std::is_integral_v<Number>;
    if constexpr (kWhole) {
        range.low = std::max(range.low, static_cast<double>(std::numeric_limits<Number>::min()));
        range.high = std::min(range.high, static_cast<double>(std::numeric_limits<Number>::max()));
    }
    return command
        .add_option_function<std::string>(
            name,
            [&target](const std::string& text) {
                if constexpr (kWhole) {
                    target = static_cast<Number>(whole_number(text));
                } else {
                    target = real_number(text);
                }
            },
            description)
        ->type_name(kWhole ? "INT" : "FLOAT")
        ->check(number_check(kWhole ? NumberForm::whole : NumberForm::real, range));
}

}  // namespace gearpod::mc
