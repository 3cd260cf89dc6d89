// Number in a text that holds nothing else.
#pragma once

#include <charconv>
#include <optional>
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

}  // namespace gearpod::mc
