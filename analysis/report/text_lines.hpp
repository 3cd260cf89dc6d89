// Lines of the terminal reports.
#pragma once

#include <string>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

// Width of the reports in columns: 120, or a value set for the terminal, at least 80. Must be set
// before anything is written, while the program has one thread.
std::size_t text_width();
void set_text_width(std::size_t columns);
// Significance level of the tests named in the text.
inline constexpr double kTestLevel = 0.05;

// Adds the text and an end of line. Breaks at spaces before the width; further lines are indented.
void add_wrapped(std::string& out, const std::string& text, std::size_t indent,
                 std::size_t width = text_width());

std::string with_unit(double size, const SizeUnit& unit);  // for example "1.24 mm"
// For example "0.5 mm to 1 mm".
std::string range_text(const SizeGroup& range, const SizeUnit& unit);

// Size in the displayed unit, such as "1.24"; "< 0.5" and "> 4.28" beyond the tested sizes.
std::string size_estimate_text(const SizeEstimate& estimate, double smallest, double largest,
                               const SizeUnit& unit, int digits = 3);

}  // namespace gearpod::analysis
