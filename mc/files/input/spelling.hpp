// Suggestions for misspelt names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Number of insertions, deletions, substitutions and transpositions of neighbours that turn one
// word into the other (Damerau 1964, optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

// Candidate nearest to `word`, the first one of equals; "" without candidates.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

// Suggestion: "did you mean X?" if X contains the word or is near, else "use one of" all of them if
// they are few, else "".
std::string suggest(std::string_view word, const std::vector<std::string_view>& candidates);

// Name without a trailing unit, in the schema or commonly tried, e.g. "module_mm" -> "module". The
// whole name if it has none.
std::string_view without_unit(std::string_view key);

}  // namespace gearpod::mc
