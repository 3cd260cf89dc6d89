// A key that no section has, and what was probably meant.
#pragma once

#include <string>

#include "mc/study/draft.hpp"

namespace gearpod::mc {

// Rejects an unknown key of a section, "random." + section in [random]. The key that was probably
// meant counts as bad, not as missing.
void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry);

}  // namespace gearpod::mc
