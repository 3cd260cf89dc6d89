// Gearbox of a study as far as its vibration modes depend on it.
#pragma once

#include <memory>
#include <vector>

#include "mc/plan/gearbox_plan.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct ModalPlan {
    BodyModel bodies;
    InstanceInputs nominal;          // inputs of the nominal gearbox
    std::vector<double> mean_pairs;  // mean stiffness of every gear pair, N/m
    // Null without tooth numbers: modes then are those at rest only.
    std::shared_ptr<const Drivetrain> drivetrain;
    Member speed_member;  // whose speed the study gives
    bool coupled;         // true if elastic shafts couple the gearbox to neighbouring stages
};

// The study may lack tooth numbers if its mesh stiffness is constant. Throws SceneError if masses
// or inertias are missing.
ModalPlan make_modal_plan(const Study& study);

}  // namespace gearpod::mc
