// Makes text from files safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace gearpod::mc {

// The text as valid UTF-8 (utf8.hpp) without control characters, which can control a terminal: they
// are replaced by a space if they are blanks, else by a question mark.
std::string printable(std::string_view bytes);

bool is_printable(std::string_view text);

}  // namespace gearpod::mc
