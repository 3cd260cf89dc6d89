// Makes text from files safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace gearpod::mc {

// Replaces control characters, which can control a terminal: by a space if they are blanks, else by
// a question mark.
std::string printable(std::string_view text);

bool is_printable(std::string_view text);

}  // namespace gearpod::mc
