// Messages about unknown keys, with the key that was probably meant.
#pragma once

#include <string>

#include "mc/study/draft.hpp"

namespace gearpod::mc {

// Rejects an unknown key of a section; `prefix` is "random." in [random]. The key that was probably
// meant is marked as bad, so that it is not reported as missing.
void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry);

}  // namespace gearpod::mc
