// Distinguishes parts of a signal from the rounding errors of their separation.
#pragma once

#include <numeric>
#include <span>

namespace gearpod::features {

// True if the RMS of a part is at most 1e-12 of the RMS of the signal that it was separated from.
// Double-precision arithmetic leaves at least 1e-16 of it, times the root of the number of samples.
inline bool is_rounding(std::span<const double> part, std::span<const double> whole) {
    constexpr double kRelative = 1e-12;
    const auto sum_of_squares = [](std::span<const double> values) {
        return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    };
    return !(sum_of_squares(part) > kRelative * kRelative * sum_of_squares(whole));
}

}  // namespace gearpod::features
