#include "mc/study/distributions/range.hpp"

#include <fmt/format.h>

namespace gearpod::mc {

bool Range::contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

bool Range::contains(const Support& support) const {
    const bool low_inside = support.low_open ? support.low >= low : contains(support.low);
    const bool high_inside = support.high_open ? support.high <= high : contains(support.high);
    return low_inside && high_inside;
}

std::string Range::text() const {
    const bool has_low = low > -std::numeric_limits<double>::infinity();
    const bool has_high = high < std::numeric_limits<double>::infinity();
    if (has_low && has_high && !low_open && !high_open) {
        return fmt::format("between {} and {}", low, high);
    }
    std::string text;
    if (has_low) {
        text = fmt::format("{} {}", low_open ? ">" : ">=", low);
    }
    if (has_high) {
        text += fmt::format("{}{} {}", has_low ? " and " : "", high_open ? "<" : "<=", high);
    }
    return text;
}

std::string Range::hint() const {
    const std::string range = text();
    return range.empty() ? "" : "give a value " + range;
}

}  // namespace gearpod::mc
