// A study of a planetary gearbox from what its datasheet says.
#pragma once

#include <string>

#include "mc/input/problems.hpp"
#include "mc/new_study/planetary_datasheet.hpp"

namespace gearpod::mc {

struct NewStudy {
    std::string text;  // TOML with comments; only without problems
    Problems problems;
};

// The study that follows by rules.hpp; `command` says in its first comment how it was made. The
// problems' keys are the options that gave the value.
NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command);

}  // namespace gearpod::mc
