// Makes the study of one stage of a REXS model.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {

// Reads the model with analysis/python/gearpod/rexs.py and makes the study of a planetary stage, or
// of a cylindrical one as a gear pair. The study's first comment and the notices list what the
// model lacks and what the study does not take. Contradictions within the model are problems, with
// both values. `options`: stage, load_case, input, planets and values of StageDatasheet that are
// given in addition; loads replace the model's.
NewStudy new_from_rexs(const std::string& path, nlohmann::json options, const std::string& command);

}  // namespace gearpod::mc
