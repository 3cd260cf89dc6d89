// Integrates W gearboxes over one mesh period at a time: an integrator together with the parameters
// of its gearboxes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

// Immutable; may be used by several threads.
template <int W>
class MeshIntegrator {
  public:
    virtual ~MeshIntegrator() = default;
    // Integrates `state` over one mesh period that starts at an integer phase, and records it.
    // `record` must have its sizes (make_record).
    virtual void operator()(const MeshOverrides& overrides, TileState& state,
                            MeshRecord& record) const = 0;
};

// Makes the kernel call for the plan's gearbox kind, effects and integrator. `inputs` holds W
// gearboxes of the plan's kind. The plan must outlive the result. Throws std::invalid_argument for
// single precision with an integrator that has no such kernels, and for W = 16 in double precision.
template <int W>
std::unique_ptr<const MeshIntegrator<W>> make_mesh_integrator(
    const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs);

}  // namespace gearpod::lockstep
