// Upper limits of fault sizes set by the faulty tooth, shared by the checks of several kinds.
#pragma once

#include <string>

#include "mc/study/draft.hpp"
#include "mc/study/faults/fault_kind.hpp"

namespace gearpod::mc {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kMargin = 1.0 + 1e-12;  // for the rounding of unit conversions

// Largest size that the tooth allows, in the file's unit, and the reason.
struct SizeLimit {
    double largest;
    std::string why;  // "longer than the tooth (...)"
};

// The limit rounded down to four decimals, so that the value named in a message is allowed.
double rounded_down(double limit);

// Rejects sizes above the limit, whether nominal or random.
void check_size(StudyDraft& draft, const SizeLimit& limit);
// The same with the face width as the limit.
void check_on_face(StudyDraft& draft);

// Part of the face width that a size along it takes.
SizeShare share_of_face(const Study& study);

// Height of the faulty member's teeth, from root to tip circle, m.
double tooth_height_m(const Study& study);

}  // namespace gearpod::mc
