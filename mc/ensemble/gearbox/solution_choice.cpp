#include "mc/ensemble/gearbox/solution_choice.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "machine/clocks.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"

namespace gearpod::mc {
namespace {

// Processor seconds of one thread for a healthy mesh period of W nominal gearboxes: the minimum of
// several integrations from rest. The motion may grow without bound, which does not change the
// cost.
template <int W>
double least_mesh_s(const GearboxPlan& gearbox, const lockstep::IntegrationPlan& plan,
                    const std::optional<lockstep::Excitation>& excitation, int repetitions) {
    const std::vector<dynamics::GearboxInputs> inputs(W, gearbox.inputs(gearbox.nominal));
    lockstep::MeshRecord record = lockstep::make_record(plan, W, false);
    std::function<void(lockstep::TileState&)> integrate;
    if constexpr (W <= 8) {  // there is no kernel with variable excitation for 16 lanes
        if (excitation) {
            integrate = [&, variable_kernel = std::shared_ptr<lockstep::ExcitedIntegrator<W>>(
                                lockstep::make_excited_integrator<W>(plan, *excitation, inputs))](
                            lockstep::TileState& state) {
                (*variable_kernel)(0, {}, state, record);
            };
        }
    }
    if (!integrate) {
        integrate = [&, steady = std::shared_ptr<const lockstep::MeshIntegrator<W>>(
                            lockstep::make_mesh_integrator<W>(plan, inputs))](
                        lockstep::TileState& state) { (*steady)({}, state, record); };
    }
    const auto degrees = static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repetitions; ++i) {
        lockstep::TileState state = lockstep::zero_state(degrees, plan.channels(), W);
        const double start = thread_processor_s();
        integrate(state);
        least = std::min(least, thread_processor_s() - start);
    }
    return least;
}

lockstep::IntegrationPlan explicit_plan(lockstep::IntegrationPlan plan,
                                        const lockstep::PairSet& pairs, int steps) {
    plan.integrator = lockstep::kUsualExplicit;
    plan.grid = lockstep::make_phase_grid(plan.grid.samples, steps, {});
    plan.grid.stage_nodes = lockstep::stage_nodes(plan.integrator);
    plan.nodes = lockstep::tabulate(pairs, plan.grid, dynamics::mesh_damping(plan.layout));
    if (dynamics::has_error(plan.mesh_law)) {
        lockstep::add_errors(
            pairs, plan.grid,
            std::vector<lockstep::MeshError>(static_cast<std::size_t>(pairs.pairs())), plan.nodes);
    }
    return plan;
}

template <class T>
const T* pointer_to(const std::optional<T>& value) {
    return value ? &*value : nullptr;
}

struct SolutionMaker {
    const SolvePlan& solve;
    const RecordPlan& record;
    const TileLoads& loads;
    const lockstep::RecordOptions& options;
    std::function<void(int, const lockstep::MeshRecord&)> on_record;
    std::vector<lockstep::SpanPart> parts;

    lockstep::Solution operator()(const PeriodicOrbit&) const {
        return lockstep::PeriodicSolution{solve.convergence, options.motion_meshes > 0, gravity()};
    }
    lockstep::Solution operator()(const EveryMeshPeriod&) {
        lockstep::RecordedSpan recorded = span();
        recorded.parts = std::move(parts);
        return lockstep::FullSolution{solve.convergence, std::move(recorded),
                                      pointer_to(loads.tooth_errors), pointer_to(loads.excitation)};
    }
    lockstep::Solution operator()(const Superposed& superposed) {
        return lockstep::SuperposedSolution{*loads.tooth_errors, solve.convergence, span(),
                                            superposed.faulty};
    }
    lockstep::Solution operator()(const StaticEquilibrium& equilibrium) const {
        if (equilibrium.periodic) {
            return lockstep::QuasiStaticSolution{
                lockstep::StaticPattern{options.motion_meshes > 0, gravity()}};
        }
        return lockstep::QuasiStaticSolution{
            lockstep::StaticSpan{record.recorded_meshes, options.motion_meshes,
                                 pointer_to(loads.tooth_errors), pointer_to(loads.excitation)}};
    }
    lockstep::Solution operator()(const CoupledStages&) const {
        throw std::logic_error("coupled stages are solved together");
    }

  private:
    std::optional<lockstep::ConstantGravity> gravity() const {
        return loads.excitation
                   ? std::optional<lockstep::ConstantGravity>(loads.excitation->gravity)
                   : std::nullopt;
    }
    lockstep::RecordedSpan span() {
        return {record.recorded_meshes, solve.run_in_meshes, options, std::move(on_record)};
    }
};

}  // namespace

double motion_bytes(const TilePlan& plan) {
    const SolvePlan& solve = *plan.solve;
    if (!solve.records_during_integration) {
        return solve.record_bytes;
    }
    // Copies: samples as recorded and by lane, plus those of the baseline records.
    const double copies = 2.0 + static_cast<double>(plan.record.baselines);
    const double samples =
        static_cast<double>(plan.record.sensor_meshes(plan.features.needs.all())) *
        plan.record.samples;
    return copies * 8.0 * samples * solve.settings.numerics.lanes +
           (std::holds_alternative<Superposed>(solve.strategy) ? solve.record_bytes
                                                               : 2.0 * solve.mesh_record_bytes);
}

double mesh_period_s(const DrawPlan& draw, const GearboxPlan& gearbox, const SolvePlan& solve,
                     const RecordPlan& record) {
    constexpr int kRepetitions = 5;
    return with_lane_count(solve.settings.numerics.lanes, [&](auto lanes) {
        const std::vector<Realization> gearboxes(lanes(), {{}, gearbox.nominal});
        return least_mesh_s<lanes()>(
            gearbox, solve.integration(),
            draw_excitation(gearbox, draw.seed, {solve.longest_run_in(), record.signal_meshes},
                            gearboxes),
            kRepetitions);
    });
}

double explicit_step_s(const GearboxPlan& gearbox, const SolvePlan& solve) {
    constexpr int kSteps = 2000, kRepetitions = 20;
    const lockstep::IntegrationPlan plan =
        lockstep::in_double_precision(explicit_plan(solve.integration(), gearbox.pairs(), kSteps));
    return least_mesh_s<lockstep::kPilotLanes>(gearbox, plan, std::nullopt, kRepetitions) /
           static_cast<double>(plan.grid.steps.size()) / lockstep::kPilotLanes;
}

lockstep::Solution choose_solution(const SolvePlan& solve, const RecordPlan& record,
                                   const TileLoads& loads, const lockstep::RecordOptions& options,
                                   std::function<void(int, const lockstep::MeshRecord&)> on_record,
                                   std::vector<lockstep::SpanPart> parts) {
    return std::visit(
        SolutionMaker{solve, record, loads, options, std::move(on_record), std::move(parts)},
        solve.strategy);
}

lockstep::FaultPerturbation fault_perturbation(const SolvePlan& solve, const TileLoads& loads,
                                               const lockstep::SpanStates& healthy) {
    return {healthy, solve.convergence, pointer_to(loads.tooth_errors)};
}

}  // namespace gearpod::mc
