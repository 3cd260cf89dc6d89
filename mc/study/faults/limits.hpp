// How large the faulty tooth lets a fault be: what the checks of several kinds share.
#pragma once

#include <string>

#include "mc/study/draft.hpp"

namespace gearpod::mc {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kMargin = 1.0 + 1e-12;  // for the rounding of unit conversions

// The largest size that the tooth holds, and why, in the file's unit.
struct SizeLimit {
    double largest;
    std::string why;  // "longer than the tooth (...)"
};

// Rounded down, so that the size named is allowed.
double shown(double limit);

// Rejects sizes beyond the limit, given or random.
void check_size(StudyDraft& draft, const SizeLimit& limit);
// The same for a size along the face.
void check_on_face(StudyDraft& draft);

// Rejects a place along the face of teeth that touch all of it at once.
void check_helical(StudyDraft& draft, const std::string& key);

// Of the faulty member's tooth.
double tooth_height_m(const Study& study);

}  // namespace gearpod::mc
