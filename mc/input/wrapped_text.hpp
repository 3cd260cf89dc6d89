// Line breaks for text on the terminal.
#pragma once

#include <cstddef>
#include <string>

namespace gearpod::mc {

// Columns that help texts and descriptions may take.
inline constexpr std::size_t kLineWidth = 80;

// Breaks a text at its spaces into lines that fit between the column `indent` and kLineWidth. All
// lines but the first are indented. Adds no newline at the end. Words are never broken.
std::string wrapped_text(const std::string& text, std::size_t indent);

}  // namespace gearpod::mc
