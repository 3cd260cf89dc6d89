#include "mc/gearbox/tile_solution.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "lockstep/steps/instability.hpp"
#include "machine/thread_clock.hpp"
#include "mc/coupling/coupled_train.hpp"
#include "mc/coupling/record_positions.hpp"
#include "mc/coupling/stage_gearbox.hpp"
#include "mc/gearbox/lane_count.hpp"
#include "mc/gearbox/random_tooth_errors.hpp"
#include "mc/gearbox/tile_random_inputs.hpp"
#include "mc/gearbox/tile_sensor_recorder.hpp"

namespace gearpod::mc {
namespace {

lockstep::FaultCurves fault_curves(const Scene& scene, std::span<const Realization> realizations) {
    lockstep::FaultCurves faults{&scene.pairs(), scene.pattern(), {}};
    faults.curve.resize(static_cast<std::size_t>(scene.fault().curves()));
    for (int c = 0; c < scene.fault().curves(); ++c) {
        for (const Realization& realization : realizations) {
            faults.curve[static_cast<std::size_t>(c)].push_back(
                scene.fault().mesh(c, realization.inputs.fault_size));
        }
    }
    if (!scene.fault().worn_pairs().empty()) {
        for (const Realization& realization : realizations) {
            faults.wear.push_back(realization.inputs.fault_size);
        }
    }
    return faults;
}

// Inputs for the integration of the gearboxes of one study. The parts refer to each other.
struct SolutionInputs {
    std::vector<Realization> realizations;  // [lane]
    std::vector<dynamics::GearboxInputs> gearboxes;
    lockstep::FaultCurves faults;
    TileLoads loads;

    SolutionInputs(const Scene& scene, std::vector<Realization> lanes)
        : realizations(std::move(lanes)),
          faults(fault_curves(scene, realizations)),
          loads{draw_tooth_errors(scene, realizations), std::nullopt} {
        for (const Realization& realization : realizations) {
            gearboxes.push_back(scene.inputs(realization.inputs));
        }
    }
    SolutionInputs(const SolutionInputs&) = delete;
    SolutionInputs& operator=(const SolutionInputs&) = delete;

    lockstep::CoupledStage stage(const Scene& scene, lockstep::RecordedSpan span) const {
        return {{scene.plan(), gearboxes, faults},
                loads.tooth_errors ? &*loads.tooth_errors : nullptr,
                std::move(span)};
    }
};

// A coupled stage next to the gearboxes of a tile, and its recorder.
struct StageTask {
    const Scene& scene;
    const SensorPaths path;
    const SolutionInputs inputs;
    TileSensorRecorder recorder;

    StageTask(const Scene& own, std::vector<Realization> realizations, int meshes)
        : scene(own),
          path(sensor_paths(own)),
          inputs(own, std::move(realizations)),
          recorder(own, path, inputs.realizations, meshes, meshes) {}
};

std::vector<lockstep::TileResult> run_coupled(int lanes,
                                              std::span<const lockstep::CoupledStage> stages,
                                              std::span<const lockstep::CouplingShaft> shafts,
                                              const lockstep::Convergence& convergence) {
    return with_lane_count(lanes, [&](auto count) -> std::vector<lockstep::TileResult> {
        if constexpr (count() <= 8) {
            return lockstep::run_coupled_stages<count()>(stages, shafts, convergence);
        }
        throw std::invalid_argument("coupled stages need at most eight lanes");
    });
}

}  // namespace

TileSolution solve(const Scene& scene, std::span<const Realization> realizations,
                   const std::function<lockstep::Solution(const TileLoads&)>& solution_of) {
    auto start = WallClock::now();
    TileSolution solved;
    SolutionInputs inputs(scene, {realizations.begin(), realizations.end()});
    solved.stiffness_s = lap(start);
    inputs.loads.excitation = draw_excitation(scene, realizations);
    const lockstep::Solution solution = solution_of(inputs.loads);
    const double processor_start = thread_processor_s();
    solved.integration = with_lane_count(static_cast<int>(realizations.size()), [&](auto lanes) {
        return lockstep::run_tile<lanes()>(scene.plan(), inputs.gearboxes, inputs.faults, solution);
    });
    solved.integration_s = lap(start);
    solved.meshes = solved.integration.integrated_meshes;
    solved.integration_cpu_s = thread_processor_s() - processor_start;
    return solved;
}

TileSolution solve_coupled(const Scene& scene, std::span<const Realization> realizations,
                           const lockstep::RecordOptions& options, const OnRecord& on_record,
                           std::optional<std::size_t> faulty_stage) {
    auto start = WallClock::now();
    TileSolution solved;
    const GearboxId& first = realizations.front().id;
    for (const Realization& record : realizations) {
        if (!share_positions(record.id, first)) {
            throw std::logic_error("records of a coupled tile have stages at other positions");
        }
    }
    const CoupledSpan span = coupled_span(scene, run_in_meshes(scene), first);
    const SolutionInputs own(scene, {realizations.begin(), realizations.end()});
    std::vector<std::unique_ptr<StageTask>> tasks;
    std::vector<lockstep::CoupledStage> stages{
        own.stage(scene, {scene.recorded_meshes(), span.run_in, options, on_record})};
    for (const StageSpan& stage : span.stages) {
        std::vector<Realization> gearboxes;
        for (const Realization& record : realizations) {
            gearboxes.push_back(
                stage_gearbox(scene, stage.stage, record, faulty_stage == stage.stage));
        }
        tasks.push_back(std::make_unique<StageTask>(scene.stages()[stage.stage],
                                                    std::move(gearboxes), stage.meshes));
        StageTask& task = *tasks.back();
        lockstep::CoupledStage& added = stages.emplace_back(task.inputs.stage(
            task.scene, {stage.meshes, stage.run_in, {}, std::ref(task.recorder)}));
        added.period = stage.period;
        added.lead = stage.lead;
        added.first_mesh = stage.first_mesh;
    }
    solved.stiffness_s = lap(start);
    const double processor_start = thread_processor_s();
    const std::size_t lanes = realizations.size();
    std::vector<lockstep::TileResult> results =
        run_coupled(static_cast<int>(lanes), stages, coupling_shafts(scene, span, lanes),
                    convergence_of(scene));
    solved.integration_s = lap(start);
    solved.integration_cpu_s = thread_processor_s() - processor_start;
    solved.integration = std::move(results[0]);
    solved.meshes = solved.integration.integrated_meshes;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const SensorRecorders recorders = tasks[i]->recorder.take_recorders();
        solved.coupled.push_back(recorders.front().front()->signals(lanes, span.stages[i].meshes));
        solved.meshes += results[i + 1].integrated_meshes;
        // A gearbox fails if any of its stages does.
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (solved.integration.status[lane] == lockstep::LaneStatus::ok) {
                solved.integration.status[lane] = results[i + 1].status[lane];
            }
        }
    }
    return solved;
}

Status status_of(const Scene& scene, const InstanceInputs& instance, lockstep::LaneStatus status) {
    const bool ok = status == lockstep::LaneStatus::ok;
    const bool diverged = status == lockstep::LaneStatus::diverged;
    if (scene.study().effects.quasi_static()) {
        return ok ? Status::ok : diverged ? Status::no_equilibrium : Status::not_converged;
    }
    if (ok) {
        // A solution without excitation does not grow even if it is unstable.
        return lockstep::above_critical_speed(scene.plan().layout, scene.inputs(instance),
                                              scene.mean_pairs())
                   ? Status::supercritical
                   : Status::ok;
    }
    switch (lockstep::find_instability(scene.plan(), scene.inputs(instance))) {
        case lockstep::Instability::rotating_frame:
            return Status::supercritical;
        case lockstep::Instability::parametric:
            return Status::parametric;
        case lockstep::Instability::step:
            return Status::step_too_long;
        case lockstep::Instability::none:
            break;
    }
    return diverged ? Status::diverged : Status::not_converged;
}

}  // namespace gearpod::mc
