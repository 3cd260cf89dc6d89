// Random inputs of a gearbox that are not among its sampled parameters: phases of interfering
// tones, excitation, and errors of the teeth. They depend on no other gearbox.
#pragma once

#include <optional>
#include <span>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/tile_plan.hpp"
#include "signals/noise/tones.hpp"

namespace gearpod::mc {

// In the functions below `realizations` has one gearbox per lane.

// Interfering tones. Their phases are uniformly distributed, because no tone is synchronous with
// the meshes. Empty without tones.
signals::Tones draw_tones(std::span<const Tone> tones, const GearboxPlan& gearbox,
                          std::uint64_t seed, std::span<const Realization> realizations);

// Gravity, and the fluctuations of torque and speed. The noise has knots from before the longest
// run-in until after the last mesh period of the signal, independent of the actual run-in. Its
// first knot has a random position. Empty if the excitation is constant.
struct ExcitedMeshes {
    int longest_run_in, signal;
};
std::optional<lockstep::Excitation> draw_excitation(const GearboxPlan& gearbox, std::uint64_t seed,
                                                    const ExcitedMeshes& meshes,
                                                    std::span<const Realization> realizations);

// Random errors of a gearbox's teeth: waves, eccentricity, scatter and slopes of every gear's
// flanks.
lockstep::ToothErrors draw_tooth_errors(const ToothErrorModel& model, const DrawPlan& draw,
                                        std::span<const Realization> realizations);

}  // namespace gearpod::mc
