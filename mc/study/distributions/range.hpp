// Ranges of numbers: the support of a distribution, and the values allowed in a study file.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/input/document.hpp"

namespace gearpod::mc {

// Infimum and supremum of the values; +-infinity where unbounded.
struct Support {
    double low = 0.0;
    double high = 0.0;
    bool low_open = false;  // the bound itself never occurs
    bool high_open = false;
};

// Interval of values allowed for a number in a study file, in the unit of the file.
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

// Problem of a value that must be a computable number; "" without one. `unit`: "" or " in mm".
std::string number_problem(const Value& value, const std::string& unit = "");

// Parameter of a distribution: its name in the study file, the member that stores it, and its
// range. Functions that most distributions share.

template <class Law, class Type>
struct Field {
    std::string_view name;
    Type Law::*member;
    Range range = {};
    bool optional = false;  // if missing, the member keeps its default
};

template <class Law, class Type>
Field(std::string_view, Type Law::*) -> Field<Law, Type>;
template <class Law, class Type>
Field(std::string_view, Type Law::*, Range) -> Field<Law, Type>;
template <class Law, class Type>
Field(std::string_view, Type Law::*, Range, bool) -> Field<Law, Type>;

// Functions of a distribution that most do not define themselves.
struct LawDefaults {
    std::string problem() const { return ""; }         // contradiction between parameters
    std::vector<double> levels() const { return {}; }  // values that are taken in turn
    bool operator==(const LawDefaults&) const = default;
};

constexpr Range kPositiveField{0.0, std::numeric_limits<double>::infinity(), true, false};

}  // namespace gearpod::mc
