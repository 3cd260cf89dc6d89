// Makes the study of one stage of a REXS model.
#pragma once

#include <string>

#include "mc/new_study/datasheet_problems.hpp"
#include "mc/new_study/rexs_choices.hpp"

namespace gearpod::mc {

// Reads the model and makes the study of a planetary stage, or of a cylindrical one as a gear pair.
// The study's first comment and the notices list what the model lacks and what the study does not
// take. Contradictions within the model are problems, with both values.
NewStudy new_from_rexs(const std::string& path, const RexsChoices& choices,
                       const std::string& command);

}  // namespace gearpod::mc
