// Kind of the rows of a report, and the words for them.
#pragma once

#include <string>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

enum class Subject { gearboxes, recordings };

inline std::string one(Subject subject) {
    return subject == Subject::gearboxes ? "gearbox" : "recording";
}

inline std::string many(Subject subject) {
    return subject == Subject::gearboxes ? "gearboxes" : "recordings";
}

// Name of the size where faults have no size, only a label.
inline constexpr const char* kNoSize = "label";
inline bool has_sizes(const DetectionRequest& request) {
    return request.size.name != kNoSize;
}

}  // namespace gearpod::analysis
