// Parameter of a distribution: its name in the study file, the member that stores it, and its
// range. Functions that most distributions share.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mc/study/distributions/range.hpp"

namespace gearpod::mc {

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
