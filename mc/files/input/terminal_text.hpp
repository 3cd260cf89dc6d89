// Makes text from files safe to print on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gearpod::mc {

// The text as valid UTF-8 (input_file.hpp) without control characters, which can control a
// terminal: they are replaced by a space if they are blanks, else by a question mark.
std::string printable(std::string_view bytes);

bool is_printable(std::string_view text);

// Line breaks for text on the terminal.

// Columns that help texts and descriptions may take.
inline constexpr std::size_t kLineWidth = 80;

// Breaks a text at its spaces into lines that fit between the column `indent` and kLineWidth. All
// lines but the first are indented. Adds no newline at the end. Words are never broken.
std::string wrapped_text(const std::string& text, std::size_t indent);

}  // namespace gearpod::mc
