// What the rows of a report are, and so what it calls them.
#pragma once

#include <string>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

enum class Subject { gearboxes, recordings };

inline std::string many(Subject subject) {
    return subject == Subject::gearboxes ? "gearboxes" : "recordings";
}

// The size's name where faults have none, only a label.
inline constexpr const char* kNoSize = "label";
inline bool has_sizes(const DetectionRequest& request) {
    return request.size.name != kNoSize;
}

}  // namespace gearpod::analysis
