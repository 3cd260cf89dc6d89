// What a misspelt name was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other
// (Damerau 1964, optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to `word`, the first of equals; "" without candidates.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

// A suggestion in words: "did you mean X?" if X is near, else "the nearest valid one is X".
std::string suggest(std::string_view word, const std::vector<std::string_view>& candidates);

// "module_mm" -> "module": the name without a trailing unit, known or commonly tried; the name
// itself if it has none.
std::string_view without_unit(std::string_view key);

}  // namespace gearpod::mc
