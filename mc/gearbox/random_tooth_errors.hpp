// Random errors of a gearbox's teeth: waves, eccentricity, scatter and slopes of every gear's
// flanks.
#pragma once

#include <optional>
#include <span>

#include "lockstep/plan/tooth_errors.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// `realizations` has one gearbox per lane. The errors of a gearbox depend on no other gearbox.
// Empty without tooth errors.
std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const Realization> realizations);

}  // namespace gearpod::mc
