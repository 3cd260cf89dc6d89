// Parameter of a distribution: its name in the study file, the member that stores it, and its
// range.
#pragma once

#include <limits>
#include <string_view>

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

constexpr Range kPositiveField{0.0, std::numeric_limits<double>::infinity(), true, false};

}  // namespace gearpod::mc
