// Makes the study of a gear pair on fixed shafts from its datasheet.
#pragma once

#include <string>

#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {

// Makes the study of a datasheet by the rules of rules.hpp, as new_planetary() does.
NewStudy new_pair(const PairDatasheet& data, const std::string& command,
                  const DatasheetSource& source);

}  // namespace gearpod::mc
