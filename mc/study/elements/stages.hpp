// Reads neighbouring stages as a study file lists them: [{ name = "first", study = "first.toml",
// shaft = "sun", stage_shaft = "carrier", gain = 0.5 }].
#pragma once

#include <string>
#include <vector>

#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

inline constexpr TableField kStageFields[] = {
    {"name", TableField::Kind::word, true},
    {"study", TableField::Kind::text},
    {"text", TableField::Kind::text},
    {"shaft", TableField::Kind::text, true, kShafts},
    {"stage_shaft", TableField::Kind::text, true, kShafts},
    {"of", TableField::Kind::word},
    {"gain"},
    {"shaft_stiffness_N_m_rad"},
    {"shaft_damping_ratio"},
    {"role", TableField::Kind::text, false, kSourceRoles}};
// Problems name the stage by its position in the list. `study` is a file relative to the folder of
// the study; `text` is such a file's content, as results store it.
std::vector<NeighbourStage> read_stages(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same stage.
std::string stage_table(const NeighbourStage& stage);

}  // namespace gearpod::mc
