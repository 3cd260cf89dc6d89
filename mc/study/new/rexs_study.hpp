// Choices and values given in addition to a REXS model.
#pragma once

#include <optional>
#include <string>

#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {

// Loads replace the model's.
struct RexsChoices {
    std::string stage, load_case;  // ids; empty: the only one
    std::optional<std::string> input;
    std::optional<int> planets;
    std::optional<double> face_width_mm, addendum, quality;
    std::optional<double> torque_N_m, speed_rpm, power_kW;
};

// Makes the study of one stage of a REXS model.

// Reads the model and makes the study of a planetary stage, or of a cylindrical one as a gear pair.
// The study's first comment and the notices list what the model lacks and what the study does not
// take. Contradictions within the model are problems, with both values.
NewStudy new_from_rexs(const std::string& path, const RexsChoices& choices,
                       const std::string& command);

}  // namespace gearpod::mc
