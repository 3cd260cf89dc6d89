// Stages that elastic shafts couple with the study's gearbox: the data of their common integration,
// and the gearboxes of neighbouring stages next to those of a study.
#pragma once

#include <span>
#include <vector>

#include "lockstep/strategies/coupled_stages.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/solve_plan.hpp"

namespace gearpod::mc {

// One stage in the common integration, in mesh periods of that stage except for the times.
struct StageSpan {
    std::size_t stage = 0;       // in GearboxPlan::stages
    double period = 0.0;         // its mesh period, mesh periods of the study's gearbox
    int run_in = 0, meshes = 0;  // before the recorded ones, and recorded
    double start = 0.0;          // of its record, mesh periods of the study's gearbox
    double lead = 0.0;           // by which it begins earlier than the study's gearbox, 0 to 1
    int first_mesh = 0;          // of its record in the pattern of its teeth
};
// Common integration: run-in of the study's gearbox, and its stages. The records of the stages
// begin before that of the study's gearbox and end after it, by kMarginMeshes at least.
struct CoupledSpan {
    int run_in = 0;
    std::vector<StageSpan> stages;
};
// Every record has stages at random positions of
// their teeth and of their carriers. Lanes of a tile share them: eight gearboxes with consecutive
// numbers have the same position in the same record.
CoupledSpan coupled_span(const DrawPlan& draw, const GearboxPlan& gearbox, const RecordPlan& record,
                         const CoupledStages& coupled, const GearboxId& id);

// Shafts in a tile of that many lanes; stage i + 1 of the integration is number i of
// CoupledSpan::stages.
std::vector<lockstep::CouplingShaft> coupling_shafts(const GearboxPlan& gearbox,
                                                     const CoupledSpan& span, std::size_t lanes);

// Gearbox of a stage next to the study's gearbox of a record, with the stage's fault if `faulty`.
// Torque and speed differ from their nominal values by the same factors as in the study's gearbox;
// the torque of a coupled stage balances that of its shaft. Next to a nominal torque of 0 it has
// the torque of its study.
Realization stage_gearbox(const GearboxPlan& gearbox, const StagePlan& stage,
                          const Realization& record, bool faulty = false);

}  // namespace gearpod::mc
