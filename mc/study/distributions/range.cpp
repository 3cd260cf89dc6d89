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

std::string number_problem(const Value& value, const std::string& unit) {
    if (value.kind != Value::Kind::number && value.kind != Value::Kind::integer) {
        return fmt::format("must be a number{}, but is {}", unit, value.shown());
    }
    if (!std::isfinite(value.number)) {
        return fmt::format("must be a finite number, but is {}", value.number);
    }
    return computable(value.number) ? "" : fmt::format("{} {}", value.number, kNotComputable);
}

}  // namespace gearpod::mc
