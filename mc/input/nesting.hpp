// Nesting depth of a TOML text, checked before a recursive parser reads it. TOML_MAX_NESTED_VALUES
// of toml++ limits lists and inline tables only, not dotted keys and headers, whose tables are
// destroyed recursively.
#pragma once

#include <string_view>

namespace gearpod::mc {

// Largest depth; valid studies nest at most four deep.
inline constexpr int kMostNesting = 32;

// First line (from 1) that is nested too deep; 0 if there is none. That is a dotted key or header
// with more than kMostNesting parts, or lists and tables nested deeper than kMostNesting. Strings
// and comments are ignored. Linear in the length of the text; after a syntax error the result may
// be wrong.
int line_nested_too_deep(std::string_view text);

}  // namespace gearpod::mc
