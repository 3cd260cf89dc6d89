// Integrates W gearboxes step by step under the torques of shafts, which may depend on the motion
// after the previous step.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

template <int W>
class StepIntegrator {
  public:
    virtual ~StepIntegrator() = default;
    // Torque of each shaft in its positive sense during the next step, [shaft][lane], N m.
    virtual machine::AlignedVector& torques() = 0;
    // Integrates `state` over step number `step` of a mesh period, and records it. The steps of a
    // mesh period must follow each other. `record` must have its sizes (make_record).
    virtual void operator()(int step, const MeshOverrides& overrides, TileState& state,
                            MeshRecord& record) = 0;
};

// True if the plan can be integrated by a StepIntegrator: the central difference method, whose
// steps need forces at their midpoints only, in double precision.
bool supports_steps(const IntegrationPlan& plan);

// `inputs` holds W gearboxes of the plan's kind. The plan must outlive the result. Throws
// std::invalid_argument if there is no kernel, or for more than kMostShafts shafts.
template <int W>
std::unique_ptr<StepIntegrator<W>> make_step_integrator(
    const IntegrationPlan& plan, const std::vector<ShaftEnd>& shafts,
    std::span<const dynamics::GearboxInputs> inputs);

}  // namespace gearpod::lockstep
