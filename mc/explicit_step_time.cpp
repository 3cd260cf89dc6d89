#include "mc/explicit_step_time.hpp"

#include <algorithm>
#include <limits>

#include "lockstep/mesh_march.hpp"
#include "lockstep/sensor_filter.hpp"
#include "lockstep/step_pilot.hpp"
#include "mc/thread_clock.hpp"

namespace gearpod::mc {
namespace {

constexpr int kSteps = 2000;
constexpr int kMarches = 20;

// The scene's plan with that integrator and so many steps.
lockstep::MarchPlan explicit_plan(const Scene& scene) {
    lockstep::MarchPlan plan = scene.plan();
    plan.integrator = lockstep::Integrator::rk4;
    plan.grid = lockstep::make_phase_grid(plan.grid.samples, kSteps, {});
    plan.grid.stage_nodes = lockstep::stage_nodes(plan.integrator);
    plan.nodes = lockstep::tabulate(scene.pairs(), plan.grid, scene.study().effects.mesh_damping);
    if (plan.mesh_law != dynamics::MeshLaw::linear) {
        lockstep::add_errors(
            scene.pairs(), plan.grid,
            std::vector<lockstep::MeshError>(static_cast<std::size_t>(scene.pairs().pairs())),
            plan.nodes);
    }
    return plan;
}

}  // namespace

double explicit_step_s(const Scene& scene) {
    const lockstep::MarchPlan plan = explicit_plan(scene);
    const std::vector<dynamics::GearboxInputs> inputs(
        lockstep::kPilotLanes, scene.inputs(Sampler(scene.study()).nominal()));
    const auto march = lockstep::make_mesh_march<lockstep::kPilotLanes>(plan, inputs);
    const auto degrees = static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMarches; ++i) {
        lockstep::TileState state;
        state.q.assign(degrees * lockstep::kPilotLanes, 0.0);
        state.v.assign(degrees * lockstep::kPilotLanes, 0.0);
        state.filter.assign(static_cast<std::size_t>(plan.channels()) * lockstep::kFilterStates *
                                lockstep::kPilotLanes,
                            0.0);
        lockstep::MeshRecord record = lockstep::make_record(plan, lockstep::kPilotLanes, false);
        const double start = thread_processor_s();
        (*march)({}, state, record);
        least = std::min(least, thread_processor_s() - start);
    }
    return least / static_cast<double>(plan.grid.steps.size()) / lockstep::kPilotLanes;
}

}  // namespace gearpod::mc
