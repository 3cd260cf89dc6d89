// States at the ends of the steps of a mesh period, recorded on request.
#pragma once

#include "lockstep/integrators/integration_state.hpp"

namespace gearpod::lockstep {

// Fraction of a step by which an integrator's positions are ahead of its velocities, between steps
// without a sample.
template <class Integrator>
constexpr double position_lead() {
    if constexpr (requires { Integrator::kPositionLead; }) {
        return Integrator::kPositionLead;
    }
    return 0.0;
}

// Writes row `step` of MeshRecord::step_states: the state at the start of that step, or after the
// last one.
template <class Integrator, class Model, class State, int W = Model::kWidth>
GEARPOD_INLINE void write_step_state(const IntegrationPlan& plan,
                                     const typename Model::Lanes& lanes, int step,
                                     const State& state, MeshRecord& record) {
    const int size = static_cast<int>(plan.te_weight.size()) * W;
    double* __restrict q = record.step_states.data() + 2 * step * size;
    double* __restrict v = q + size;
    const auto at = static_cast<std::size_t>(step);
    const bool parted =
        step == 0 || at == plan.grid.steps.size() || plan.grid.steps[at].sample >= 0;
    const double ahead = parted ? 0.0 : position_lead<Integrator>() * plan.grid.steps[at].length;
    for (int i = 0; i < size; ++i) {
        v[i] = double{state.v[static_cast<std::size_t>(i)]};
        q[i] = position(state, i) - ahead * double{lanes.mesh_period[i % W]} * v[i];
    }
}

}  // namespace gearpod::lockstep
