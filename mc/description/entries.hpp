// Headings, entries and paragraphs of the text printed by `describe`.
#pragma once

#include <string>

namespace gearpod::mc {

void print_heading(const std::string& text);

// Prints a name and a value in two columns, with long values in several lines. Names longer than 25
// characters shift the value to the right.
void print_entry(const std::string& name, const std::string& value);

// Prints a text as indented lines.
void print_paragraph(const std::string& text);

}  // namespace gearpod::mc
