// Limits on the magnitude of a study's numbers and on the length of its lists.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

namespace gearpod::mc {

// True for 0 and for magnitudes that leave room for the products and high powers computed from
// them. The eighth power of a torque, a stiffness or a noise level must be a finite double.
inline bool computable(double value) {
    constexpr double kLeast = 1e-30, kMost = 1e18;
    const double size = std::abs(value);
    return size == 0.0 || (size >= kLeast && size <= kMost);
}

// Longest list. Every noise level, fault size or tone costs time in each gearbox, or memory in each
// row of the results.
inline constexpr std::size_t kMostElements = 1000;

inline constexpr std::string_view kNotComputable =
    "is outside the range that can be computed (0, or a magnitude from 1e-30 to 1e18)";

}  // namespace gearpod::mc
