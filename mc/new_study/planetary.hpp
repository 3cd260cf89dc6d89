// Makes the study of a planetary gearbox from its datasheet.
#pragma once

#include <string>

#include "mc/input/problems.hpp"
#include "mc/new_study/planetary_datasheet.hpp"

namespace gearpod::mc {

struct NewStudy {
    std::string text;  // TOML with comments; empty if there are problems
    Problems problems;
};

// Makes the study of a datasheet by the rules of rules.hpp. It passes every check of `describe`;
// otherwise the result has one problem for each reason and no text. Keys of problems are the
// options that gave the value. `command` goes into the study's first comment.
NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command);

}  // namespace gearpod::mc
