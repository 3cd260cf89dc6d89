#include "mc/library/natural_frequencies.hpp"

#include <variant>

#include "dynamics/gearbox_matrices.hpp"
#include "mc/numerics/choice.hpp"
#include "mc/scene/body.hpp"
#include "mc/scene/meshes.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {
namespace {

std::vector<double> mean_pairs(const Study& study) {
    return study.gearbox.tooth_profile == ToothProfile::constant
               ? constant_pairs(study)
               : Scene(resolve_numerics(study).study).mean_pairs();
}

// Gearbox layout at rest, without inertial terms.
dynamics::GearboxLayout layout_at_rest(const Study& study) {
    dynamics::GearboxLayout layout = gearbox_layout(study);
    if (auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&layout)) {
        planetary->inertial_terms = false;
    }
    return layout;
}

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

std::vector<double> natural_frequencies_Hz(const Study& study) {
    if (!has_masses(study)) {
        throw SceneError("gearbox", "masses or inertias are missing, but modes need them",
                         "add them to [gearbox]");
    }
    const auto inputs = body_inputs(study, nominal_inputs(study));
    return dynamics::natural_frequencies_Hz(
        dynamics::assemble(layout_at_rest(study), inputs, mean_pairs(study)));
}

}  // namespace gearpod::mc
