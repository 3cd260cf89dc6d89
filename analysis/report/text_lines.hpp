// Lines of the terminal's reports.
#pragma once

#include <string>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

// Columns that the reports may take: 120, or what was set (of a terminal), 80 at least. Set before
// anything is written, by the one thread that there is then.
std::size_t text_width();
void set_text_width(std::size_t columns);
// Of the tests named in the text.
inline constexpr double kTestLevel = 0.05;

// Adds the text and an end of line. Breaks at spaces before the width; further lines are indented.
void add_wrapped(std::string& out, const std::string& text, std::size_t indent,
                 std::size_t width = text_width());

std::string with_unit(double size, const SizeUnit& unit);              // "1.24 mm"
std::string range_text(const SizeGroup& range, const SizeUnit& unit);  // "0.5 mm to 1 mm"

// "1.24" in the unit shown, "< 0.5" and "> 4.28" beyond the tested sizes.
std::string size_estimate_text(const SizeEstimate& estimate, double smallest, double largest,
                               const SizeUnit& unit, int digits = 3);

}  // namespace gearpod::analysis
