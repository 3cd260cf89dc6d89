#include "mc/plan/modal_plan.hpp"

#include "machine/contracts.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// True if the study gives every mass and inertia that the modes need.
bool has_masses(const Study& study) {
    const Gearbox& g = study.gearbox;
    const FixedShaft& f = study.fixed_shaft;
    const auto has = [&](Member member) { return g.bodies[member].mass_kg.has_value(); };
    return g.kind == GearboxKind::planetary ? has(Member::sun) && has(Member::planet) &&
                                                  has(Member::ring) && has(Member::carrier)
                                            : has(Member::pinion) && has(Member::gear) &&
                                                  f.motor_inertia_kg_m2 && f.load_inertia_kg_m2;
}

}  // namespace

ModalPlan make_modal_plan(const Study& study) {
    if (!has_masses(study)) {
        throw SceneError("gearbox", "masses or inertias are missing, but modes need them",
                         "add them to [gearbox]");
    }
    std::shared_ptr<const Drivetrain> drivetrain;
    if (has_gears(study)) {
        drivetrain = make_drivetrain(study);
    }
    EXPECTS(drivetrain || study.gearbox.tooth_profile == StiffnessSource::constant);
    std::vector<double> mean_pairs = study.gearbox.tooth_profile == StiffnessSource::constant
                                         ? constant_pairs(study)
                                         : SceneStiffness(study, *drivetrain).mean_pairs();
    return {BodyModel(study),      nominal_inputs(study), std::move(mean_pairs),
            std::move(drivetrain), speed_member(study),   is_coupled(study)};
}

}  // namespace gearpod::mc
