// Description of a plan in sentences for `describe`: the nominal gearbox, the effects simulated
// with their nominal sizes, and the effects omitted.
#pragma once

#include <string>
#include <vector>

#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

struct GearboxPlan;
struct Study;

struct DescriptionEntry {
    std::string name, text;  // without a name: a paragraph
};
struct DescriptionSection {
    std::string heading;
    std::vector<DescriptionEntry> entries;
};
// `decay_meshes`: Stepping::decay_meshes.
std::vector<DescriptionSection> description_of(const Study& study, const GearboxPlan& gearbox,
                                               double decay_meshes);

// States whether the number of healthy gearboxes suffices for the false-alarm rate. This needs no
// plan.
DescriptionSection false_alarm_description(const Study& study);

// Contact ratio on the nominal path, its parts for helical teeth, and the time that a tooth pair
// may touch if corner contact extends the path.
std::string contact_ratio_text(const stiffness::MeshStiffness& mesh);

}  // namespace gearpod::mc
