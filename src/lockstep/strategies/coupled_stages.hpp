// Stages of a gearbox that elastic shafts couple, integrated together. Every stage keeps its own
// steps; the stage that is behind in time makes the next one. The torque of a shaft during a step
// follows from the rotation of both its ends in the middle of the step, to which the end at the
// other stage is extrapolated over less than one step with its velocity. The error is of order 2 in
// the step, as that of the central difference method.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

// The gearboxes of one stage, one per lane; lane l of every stage belongs to the same machine.
struct CoupledStage {
    TileInputs tile;
    const ToothErrors* tooth_errors = nullptr;  // or null
    RecordedSpan span = {};
    // Mesh period of this stage over that of the first stage, the same for all lanes.
    double period = 1.0;
    // Mesh periods of its own by which the stage begins earlier than the first one, 0 to 1.
    double lead = 0.0;
    // Mesh period k of the span is number k + first_mesh of the teeth's pattern.
    int first_mesh = 0;
};

// Elastic shaft between two stages. Without vibration it transmits the torques that the loads of
// both gearboxes contain. Its own torque is the deviation from these: stiffness times the change of
// its twist since the start, plus damping times the rate of the twist.
struct CouplingShaft {
    std::size_t stage[2] = {};  // different
    ShaftEnd end[2];
    machine::AlignedVector stiffness_N_m_rad, damping_N_m_s_rad;  // [lane]
};

// Integrates all stages from the moment at which the run-in of the first stage begins, until the
// span of every one is complete. Stage i records mesh period k of its span from
//     start + (k + run-in of i - lead of i) times its period,
// where start is minus the run-in of the first stage and time counts mesh periods of the first
// stage from its first recorded one. Without shafts, every stage has the bits of a FullSolution.
// Throws std::invalid_argument for plans that supports_steps() excludes.
template <int W>
std::vector<TileResult> run_coupled_stages(std::span<const CoupledStage> stages,
                                           std::span<const CouplingShaft> shafts,
                                           const Convergence& convergence);

}  // namespace gearpod::lockstep
