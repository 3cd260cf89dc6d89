// Study text for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace gearpod::mc {

// Breaks lines of a study that are longer than 80 characters where TOML allows it: an inline table
// becomes dotted keys, and an array takes several lines. Strings stay whole. The meaning is the
// same.
std::string wrapped_study(std::string_view toml);

}  // namespace gearpod::mc
