// A parameter of a distribution: its name in the study file and where it is stored.
#pragma once

#include <string_view>

namespace gearpod::mc {

template <class Law, class Type>
struct Field {
    std::string_view name;
    Type Law::*member;
};

template <class Law, class Type>
Field(std::string_view, Type Law::*) -> Field<Law, Type>;

}  // namespace gearpod::mc
