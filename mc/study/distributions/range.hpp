// Interval of values allowed for a number in a study file, in the unit of the file.
#pragma once

#include <limits>
#include <string>

#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;
    bool high_open = false;

    bool contains(double value) const;
    bool contains(const Support& support) const;
    std::string text() const;  // "> 0", "between 0 and 1", ...
    // Remedy text, e.g. "give a value > 0"; empty if every value is allowed.
    std::string hint() const;
};

}  // namespace gearpod::mc
