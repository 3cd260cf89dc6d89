// Selection of the foundation model of one gear.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gears/gear.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

// Warnings, one sentence each, if the root's half angle or the ratio of root and fixed radius lies
// outside the range of the model's fit; empty otherwise.
std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m);

// Foundation of one gear. body_radius_m: radius of the circle on which the gear body is fixed, the
// bore of an external gear or the outer circle of an internal one. Null for FoundationModel::none,
// and for an internal gear under Sainsot's formula, which is fitted to external gears. Throws
// std::invalid_argument if the circle does not lie within the body (external: inside the root
// circle; internal: outside it).
std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m);

}  // namespace gearpod::stiffness
