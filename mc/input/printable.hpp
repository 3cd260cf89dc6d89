// Text from files, as a terminal may be shown it.
#pragma once

#include <string>
#include <string_view>

namespace gearpod::mc {

// Control characters, with which a terminal can be told to do things, become spaces where they are
// blanks and question marks where they are not.
std::string printable(std::string_view text);

bool is_printable(std::string_view text);

}  // namespace gearpod::mc
