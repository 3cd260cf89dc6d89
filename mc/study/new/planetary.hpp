// Makes the study of a planetary gearbox from its datasheet.
#pragma once

#include <string>

#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {

// Makes the study of a datasheet by the rules of rules.hpp. It passes every check of `describe`;
// otherwise the result has one problem for each reason and no text. Problems name values as their
// source does. `command` goes into the study's first comment.
NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command,
                       const DatasheetSource& source = planetary_options());

}  // namespace gearpod::mc
