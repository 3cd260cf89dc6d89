// Reads a study that the user has written, as opposed to one stored in a results file.
#pragma once

#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Reads as read_study_text() does. Python files that the study names are run to find their
// features; read_study() does this, too. Studies stored in results name the features instead, and
// read_study_text() refuses files, so that reading results runs nobody's code.
StudyReading read_user_study_text(const std::string& text, const std::string& name,
                                  const std::vector<std::string>& overrides);

}  // namespace gearpod::mc
