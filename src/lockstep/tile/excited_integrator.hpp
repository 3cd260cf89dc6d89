// Integrates W gearboxes under a time-varying excitation (excitation.hpp), one mesh period at a
// time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

template <int W>
class ExcitedIntegrator {
  public:
    virtual ~ExcitedIntegrator() = default;
    // Integrates `state` over mesh period `mesh` and records it. `record` must have its sizes
    // (make_record). Consecutive calls must have consecutive values of `mesh`; otherwise time does
    // not continue (ExcitationRows::fill).
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

}  // namespace gearpod::lockstep
