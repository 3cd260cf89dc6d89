// Lines of the terminal reports.
#pragma once

#include <cstddef>
#include <string>

namespace gearpod::analysis {

// Width of the reports in columns: 80, or that of a wider terminal. Must be set
// before anything is written, while the program has one thread.
std::size_t text_width();
void set_text_width(std::size_t columns);

// Adds the text and an end of line. Breaks at spaces before the width; further lines are indented.
void add_wrapped(std::string& out, const std::string& text, std::size_t indent,
                 std::size_t width = text_width());

}  // namespace gearpod::analysis
