// Integrators of W gearboxes with their parameters: by mesh period, under a time-varying
// excitation, or step by step.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

// Immutable; may be used by several threads.
template <int W>
class MeshIntegrator {
  public:
    virtual ~MeshIntegrator() = default;
    // Integrates `state` over one mesh period that starts at an integer phase, and records it in a
    // record of make_record().
    virtual void operator()(const MeshOverrides& overrides, TileState& state,
                            MeshRecord& record) const = 0;
};

// Makes the kernel call for the plan's gearbox kind, effects and integrator. `inputs` holds W
// gearboxes of the plan's kind. The plan must outlive the result. Throws std::invalid_argument for
// single precision with an integrator that has no such kernels, and for W = 16 in double precision.
template <int W>
std::unique_ptr<const MeshIntegrator<W>> make_mesh_integrator(
    const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs);

// Integrates W gearboxes under a time-varying excitation (excitation.hpp), one mesh period at a
// time.
template <int W>
class ExcitedIntegrator {
  public:
    virtual ~ExcitedIntegrator() = default;
    // Integrates `state` over mesh period `mesh` and records it in a record of make_record(). Time
    // continues from the previous call only if that was mesh - 1 (ExcitationRows::fill).
    virtual void operator()(int mesh, const MeshOverrides& overrides, TileState& state,
                            MeshRecord& record) = 0;
};

// True if kernels exist. Time-varying forces need double precision and an integrator that supports
// them (IntegratorFacts). Variable speed also needs a step boundary on every sample.
bool supports_excitation(const IntegrationPlan& plan, const Excitation& excitation);

// `inputs` holds W gearboxes of the plan's kind. Plan and excitation must outlive the result.
// Throws std::invalid_argument if there is no kernel.
template <int W>
std::unique_ptr<ExcitedIntegrator<W>> make_excited_integrator(
    const IntegrationPlan& plan, const Excitation& excitation,
    std::span<const dynamics::GearboxInputs> inputs);

// Integrates W gearboxes step by step under the torques of shafts, which may depend on the motion
// after the previous step.
template <int W>
class StepIntegrator {
  public:
    virtual ~StepIntegrator() = default;
    // Torque of each shaft in its positive sense during the next step, [shaft][lane], N m.
    virtual machine::AlignedVector& torques() = 0;
    // Integrates `state` over step number `step` of a mesh period, and records it in a record of
    // make_record(). Calls follow the steps from 0 on.
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
