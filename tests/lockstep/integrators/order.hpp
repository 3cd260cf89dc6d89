// Shared by tests of an integrator's order: integration of one realization, the difference of two
// final states, and a realization without contact transitions.
#pragma once

#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test {

// All explicit integrators, or all implicit ones.
inline std::vector<lockstep::Integrator> integrators(bool explicit_ones) {
    std::vector<lockstep::Integrator> chosen;
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        if (lockstep::is_explicit(integrator) == explicit_ones) {
            chosen.push_back(integrator);
        }
    }
    return chosen;
}

struct Integrated {
    lockstep::TileState state;
    lockstep::MeshRecord record;  // of the last mesh period
};

// Integrates `meshes` mesh periods from `start`.
inline Integrated integrate_meshes(const lockstep::IntegrationPlan& plan,
                                   const dynamics::GearboxInputs& in, lockstep::TileState start,
                                   int meshes) {
    const auto mesh_integrator = lockstep::make_mesh_integrator<1>(plan, std::span(&in, 1));
    Integrated m{std::move(start), lockstep::make_record(plan, 1, false)};
    for (int mesh = 0; mesh < meshes; ++mesh) {
        (*mesh_integrator)({}, m.state, m.record);
    }
    return m;
}

// Tian's gearbox in which only the gear pair is stiff.
inline dynamics::FixedShaftInputs soft_tian() {
    dynamics::FixedShaftInputs in = TianGearbox::instance().inputs();
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.coupling_damping_N_m_s_rad[g] = 5.0;
        in.bearing_damping_N_s_m[g] = 1.8e3;
    }
    return in;
}

// The pair's stiffness varies as a sine about 8e8 N/m, without transitions.
inline lockstep::IntegrationPlan smooth_plan(int steps, lockstep::Integrator integrator) {
    lockstep::IntegrationPlan plan = TianGearbox::instance().plan(20, steps, integrator);
    plan.grid = lockstep::make_phase_grid(20, steps, {});
    plan.grid.stage_nodes = lockstep::stage_nodes(integrator);
    plan.nodes.stiffness.clear();
    for (const lockstep::Step& step : plan.grid.steps) {
        for (const double node : plan.grid.stage_nodes) {
            const double phase = step.phase + node * step.length;
            plan.nodes.stiffness.push_back(8e8 *
                                           (1.0 + 0.3 * std::sin(2 * std::numbers::pi * phase)));
        }
    }
    plan.nodes.damping_shape = plan.nodes.stiffness;
    return plan;
}

}  // namespace gearpod::test
