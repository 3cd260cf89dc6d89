// How deep a TOML text nests, known before a parser that recurses reads it.
#pragma once

#include <string_view>

namespace gearpod::mc {

// No study nests deeper than four.
inline constexpr int kMostNesting = 32;

// The first line (from 1) on which a dotted key or header has more than kMostNesting parts, or
// lists and tables lie more than kMostNesting deep in each other; 0 if there is none. Strings and
// comments do not count. Linear in the text; what follows a syntax error may be misjudged.
int line_nested_too_deep(std::string_view text);

}  // namespace gearpod::mc
