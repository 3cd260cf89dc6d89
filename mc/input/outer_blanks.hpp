// Removes the blanks around a text.
#pragma once

#include <string_view>

namespace gearpod::mc {

inline std::string_view without_outer_blanks(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace gearpod::mc
