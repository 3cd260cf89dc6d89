// Which numbers a study may hold, and how many.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

namespace gearpod::mc {

// 0, and what leaves room for the products and high powers that are computed from it: the eighth
// power of a torque, a stiffness or a noise at its level is a finite double.
inline bool computable(double value) {
    constexpr double kLeast = 1e-30, kMost = 1e18;
    const double size = std::abs(value);
    return size == 0.0 || (size >= kLeast && size <= kMost);
}

// Of a list: every noise level, fault size or tone costs time in each gearbox, or memory in each
// row.
inline constexpr std::size_t kMostElements = 1000;

inline constexpr std::string_view kNotComputable =
    "is beyond the numbers that can be computed with (0, or 1e-30 to 1e18 in size)";

}  // namespace gearpod::mc
