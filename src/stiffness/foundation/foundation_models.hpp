// The foundation that a study names, for one gear.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gears/gear.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

// The root's half angle and the ratio of root and clamped radius where they lie outside the range
// for which the model is fitted, one sentence each; empty if it covers them.
std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m);

// body_radius_m: the circle on which the gear body is held, the bore of an external gear and the
// outer circle of an internal one. Null without a foundation: for FoundationModel::none, and for an
// internal gear under Sainsot's formula, which is fitted to external ones. Throws
// std::invalid_argument if the circle does not lie within the body (external: inside the root
// circle; internal: outside it).
std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m);

}  // namespace gearpod::stiffness
