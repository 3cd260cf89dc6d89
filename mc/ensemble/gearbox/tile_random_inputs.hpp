// Random inputs of a gearbox that are not among its sampled parameters: phases of interfering
// tones, excitation, and errors of the teeth. The random inputs of a gearbox depend on no other gearbox.
#pragma once

#include <optional>
#include <span>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/scene.hpp"
#include "signals/noise/tones.hpp"

namespace gearpod::mc {

// In the functions below `realizations` has one gearbox per lane.

// Interfering tones. Their phases are uniformly distributed, because no tone is synchronous with
// the meshes. Empty without tones.
signals::Tones draw_tones(const Scene& scene, std::span<const Realization> realizations);

// Run-in: mesh periods that are integrated before the first recorded one. In this time, the
// transient from the onset of tooth errors or variable excitation decays to the convergence
// tolerance.
int run_in_meshes(const Scene& scene);

// Gravity, and the fluctuations of torque and speed. The noise has knots from before the longest
// run-in until after the last mesh of scene.signal_meshes(), independent of the actual run-in. Its
// first knot has a random position. Empty if the excitation is constant.
std::optional<lockstep::Excitation> draw_excitation(const Scene& scene,
                                                    std::span<const Realization> realizations);

// Random errors of a gearbox's teeth: waves, eccentricity, scatter and slopes of every gear's
// flanks.

// `realizations` has one gearbox per lane. The errors of a gearbox depend on no other gearbox.
// Empty without tooth errors.
std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const Realization> realizations);

}  // namespace gearpod::mc
