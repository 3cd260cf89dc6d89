#include "mc/ensemble/gearbox/gearbox_tile.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "lockstep/kernels/kernel_table.hpp"
#include "lockstep/steps/stability.hpp"
#include "mc/ensemble/coupling/neighbour_stages.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "signals/spectra/synchronous_average.hpp"
#include "signals/windowing/folded_signal.hpp"

namespace gearpod::mc {
namespace {

lockstep::FaultCurves fault_curves(const SceneStiffness& stiffness,
                                   std::span<const Realization> realizations) {
    const SceneFault& fault = stiffness.fault();
    lockstep::FaultCurves faults{&stiffness.pairs(), fault.pattern(), {}};
    faults.curve.resize(static_cast<std::size_t>(fault.curves()));
    for (int c = 0; c < fault.curves(); ++c) {
        for (const Realization& realization : realizations) {
            faults.curve[static_cast<std::size_t>(c)].push_back(
                fault.mesh(c, realization.inputs.fault_size));
        }
    }
    if (!fault.worn_pairs().empty()) {
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

    SolutionInputs(const DrawPlan& draw, const GearboxPlan& gearbox, std::vector<Realization> lanes)
        : realizations(std::move(lanes)),
          faults(fault_curves(*gearbox.stiffness, realizations)),
          loads{gearbox.tooth_errors
                    ? std::optional(draw_tooth_errors(*gearbox.tooth_errors, draw, realizations))
                    : std::nullopt,
                std::nullopt} {
        for (const Realization& realization : realizations) {
            gearboxes.push_back(gearbox.inputs(realization.inputs));
        }
    }
    SolutionInputs(const SolutionInputs&) = delete;
    SolutionInputs& operator=(const SolutionInputs&) = delete;

    lockstep::CoupledStage stage(const lockstep::IntegrationPlan& plan,
                                 lockstep::RecordedSpan span) const {
        return {{plan, gearboxes, faults},
                loads.tooth_errors ? &*loads.tooth_errors : nullptr,
                std::move(span)};
    }
};

signals::Tones tones_of(const TilePlan& plan, std::span<const Realization> realizations) {
    return draw_tones(plan.sensors->front().tones(), *plan.gearbox, plan.draw().seed, realizations);
}

// A coupled stage next to the gearboxes of a tile, and its recorder.
struct StageTask {
    const lockstep::IntegrationPlan& integration;
    const SolutionInputs inputs;
    TileSensorRecorder recorder;

    StageTask(const TilePlan& plan, std::vector<Realization> realizations, int meshes)
        : integration(plan.solve->integration()),
          inputs(plan.draw(), *plan.gearbox, std::move(realizations)),
          recorder(plan.record, *plan.sensors, tones_of(plan, inputs.realizations),
                   inputs.realizations, meshes, meshes) {}
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

TileSolution solve(const TilePlan& plan, std::span<const Realization> realizations,
                   const std::function<lockstep::Solution(const TileLoads&)>& solution_of) {
    auto start = WallClock::now();
    TileSolution solved;
    SolutionInputs inputs(plan.draw(), *plan.gearbox, {realizations.begin(), realizations.end()});
    solved.stiffness_s = lap(start);
    inputs.loads.excitation =
        draw_excitation(*plan.gearbox, plan.draw().seed,
                        {plan.solve->longest_run_in(), plan.record.signal_meshes}, realizations);
    const lockstep::Solution solution = solution_of(inputs.loads);
    const double processor_start = thread_processor_s();
    solved.integration = with_lane_count(static_cast<int>(realizations.size()), [&](auto lanes) {
        return lockstep::run_tile<lanes()>(plan.solve->integration(), inputs.gearboxes,
                                           inputs.faults, solution);
    });
    solved.integration_s = lap(start);
    solved.meshes = solved.integration.integrated_meshes;
    solved.integration_cpu_s = thread_processor_s() - processor_start;
    return solved;
}

TileSolution solve_coupled(const TilePlan& plan, const CoupledStages& coupled,
                           std::span<const Realization> realizations,
                           const lockstep::RecordOptions& options, const OnRecord& on_record,
                           std::optional<std::size_t> faulty_stage) {
    auto start = WallClock::now();
    TileSolution solved;
    const GearboxId& first = realizations.front().id;
    for (const Realization& record : realizations) {
        if (!share_positions(record.id, first, plan.record.same_positions)) {
            throw std::logic_error("records of a coupled tile have stages at other positions");
        }
    }
    const SolvePlan& solve = *plan.solve;
    const GearboxPlan& gearbox = *plan.gearbox;
    const CoupledSpan span = coupled_span(plan.draw(), gearbox, plan.record, coupled, first);
    const SolutionInputs inputs(plan.draw(), *plan.gearbox,
                                {realizations.begin(), realizations.end()});
    std::vector<std::unique_ptr<StageTask>> tasks;
    std::vector<lockstep::CoupledStage> stages{inputs.stage(
        solve.integration(), {plan.record.recorded_meshes, span.run_in, options, on_record})};
    for (const StageSpan& stage : span.stages) {
        const StagePlan& neighbour = gearbox.stages[stage.stage];
        std::vector<Realization> gearboxes;
        for (const Realization& record : realizations) {
            gearboxes.push_back(
                stage_gearbox(gearbox, neighbour, record, faulty_stage == stage.stage));
        }
        tasks.push_back(
            std::make_unique<StageTask>(*neighbour.tile, std::move(gearboxes), stage.meshes));
        StageTask& task = *tasks.back();
        lockstep::CoupledStage& added = stages.emplace_back(task.inputs.stage(
            task.integration, {stage.meshes, stage.run_in, {}, std::ref(task.recorder)}));
        added.period = stage.period;
        added.lead = stage.lead;
        added.first_mesh = stage.first_mesh;
    }
    solved.stiffness_s = lap(start);
    const double processor_start = thread_processor_s();
    const std::size_t lanes = realizations.size();
    std::vector<lockstep::TileResult> results = run_coupled(
        static_cast<int>(lanes), stages, coupling_shafts(gearbox, span, lanes), solve.convergence);
    solved.integration_s = lap(start);
    solved.integration_cpu_s = thread_processor_s() - processor_start;
    solved.integration = std::move(results[0]);
    solved.meshes = solved.integration.integrated_meshes;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const SensorRecorders recorders = tasks[i]->recorder.take_recorders();
        solved.coupled.push_back(recorders.front().front()->signals(lanes, span.stages[i].meshes));
        solved.meshes += results[i + 1].integrated_meshes;
        // A gearbox fails if any of its stages does.
        for (LaneId lane{0}; lane < lanes; ++lane) {
            if (solved.integration.status[lane] == lockstep::LaneStatus::ok) {
                solved.integration.status[lane] = results[i + 1].status[lane];
            }
        }
    }
    return solved;
}

Status status_of(const GearboxPlan& gearbox, const SolvePlan& solve, const InstanceInputs& instance,
                 lockstep::LaneStatus status) {
    const bool ok = status == lockstep::LaneStatus::ok;
    const bool diverged = status == lockstep::LaneStatus::diverged;
    if (std::holds_alternative<StaticEquilibrium>(solve.strategy)) {
        return ok ? Status::ok : diverged ? Status::no_equilibrium : Status::not_converged;
    }
    if (ok) {
        // A solution without excitation does not grow even if it is unstable.
        return lockstep::above_critical_speed(gearbox.bodies.layout, gearbox.inputs(instance),
                                              gearbox.stiffness->mean_pairs())
                   ? Status::supercritical
                   : Status::ok;
    }
    switch (lockstep::find_instability(solve.integration(), gearbox.inputs(instance))) {
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

namespace {

GearboxTile tile_of(std::vector<Realization> realizations, int lanes) {
    GearboxTile tile;
    tile.gearboxes = realizations.size();
    tile.realizations = std::move(realizations);
    const Realization last = tile.realizations.back();
    tile.realizations.resize(static_cast<std::size_t>(lanes), last);
    return tile;
}

GearboxTile drawn_tile(const Sampler& sampler, std::span<const GearboxId> ids, int lanes) {
    auto start = WallClock::now();
    std::vector<Realization> realizations;
    for (const GearboxId& id : ids) {
        realizations.push_back(sampler.draw(id));
    }
    GearboxTile tile = tile_of(std::move(realizations), lanes);
    tile.sampling_s = lap(start);
    return tile;
}

void add_status(const GearboxPlan& gearbox, const SolvePlan& solve, GearboxTile& tile) {
    for (LaneId lane{0}; lane < tile.gearboxes; ++lane) {
        tile.status.push_back(status_of(gearbox, solve, tile.realizations[lane].inputs,
                                        tile.integration.status[lane]));
    }
}

void keep_solution(TileSolution solved, GearboxTile& tile) {
    static_cast<TileSolution&>(tile) = std::move(solved);
    if (const std::vector<char>& superposed = tile.integration.superposed; !superposed.empty()) {
        tile.superposed = std::ranges::count(std::span(superposed).first(tile.gearboxes), true);
        tile.superposition_fallbacks =
            static_cast<std::ptrdiff_t>(tile.gearboxes) - tile.superposed;
    }
}

void solve_by_choice(const TilePlan& plan, const lockstep::RecordOptions& records,
                     const OnRecord& on_record, const TileOptions& options, GearboxTile& tile) {
    const auto* coupled = std::get_if<CoupledStages>(&plan.solve->strategy);
    keep_solution(coupled != nullptr ? solve_coupled(plan, *coupled, tile.realizations, records,
                                                     on_record, options.faulty_stage)
                                     : solve(plan, tile.realizations,
                                             [&](const TileLoads& loads) {
                                                 return choose_solution(*plan.solve, plan.record,
                                                                        loads, records, on_record,
                                                                        tile.parts);
                                             }),
                  tile);
}

void solve_and_record(const TilePlan& plan, const TileOptions& options, GearboxTile& tile) {
    TileSensorRecorder recorder(plan.record, *plan.sensors, tones_of(plan, tile.realizations),
                                tile.realizations, options.signal_meshes);
    recorder.record_only(tile.parts);
    solve_by_choice(plan, {}, std::ref(recorder), options, tile);
    tile.sensor_recorders = recorder.take_recorders();
    tile.integration_s -= recorder.spent_s();
    tile.integration_cpu_s -= recorder.spent_s();
    tile.signals_s += recorder.spent_s();
}

void add_signals(const TilePlan& plan, GearboxTile& tile) {
    add_status(*plan.gearbox, *plan.solve, tile);
    auto start = WallClock::now();
    tile.views = views_of(plan.record, tile);
    if (plan.features.sensor) {
        tile.tones = tones_of(plan, tile.realizations);
    }
    if (!tile.sensor_recorders.empty()) {
        for (const SensorPlan& sensor : *plan.sensors) {
            tile.folded.push_back(sensor.find<PathStage>() != nullptr
                                      ? tile.sensor_recorders[sensor.number].front()->folded()
                                      : machine::AlignedVector());
        }
        tile.te_turn = tile.sensor_recorders.front().front()->averaged_te();
        tile.signals_s += lap(start);
        return;
    }
    if (has_gain(tile.realizations)) {
        for (lockstep::MeshRecord& record : tile.integration.records) {
            apply_gain(tile.realizations, record.acceleration);
        }
    }
    // A quasi-static gearbox has no inertia and therefore no acceleration.
    if (plan.features.sensor) {
        const signals::FoldPlan fold(tile.integration.content, plan.record.span);
        const std::vector<double> exponents = path_exponents(tile.realizations, 0);
        for (const SensorPlan& sensor : *plan.sensors) {
            machine::AlignedVector& folded = tile.folded.emplace_back();
            if (sensor.find<PathStage>() != nullptr) {
                signals::fold_squares(tile.views, fold, sensor.paths.front(), exponents, tile.tones,
                                      folded);
            }
        }
    }
    signals::average_te(tile.views, tile.integration.content, plan.record.span,
                        plan.record.te_samples, tile.te_turn);
    tile.signals_s += lap(start);
}

void run_tile(const TilePlan& plan, const TileOptions& options, GearboxTile& tile) {
    const IntegrationCache* const cache = options.records ? nullptr : options.cache;
    auto start = WallClock::now();
    if (const auto before = cache != nullptr ? cache->find(tile.realizations) : nullptr) {
        tile.integration = *before;
        tile.integration_s = lap(start);
    } else if (plan.solve->records_during_integration && !options.records) {
        solve_and_record(plan, options, tile);
    } else {
        solve_by_choice(plan, options.records.value_or(lockstep::RecordOptions{}), nullptr, options,
                        tile);
        if (cache != nullptr) {
            cache->keep(tile.realizations, tile.integration);
        }
    }
    add_signals(plan, tile);
}

GearboxTile run_records(const TilePlan& plan, std::span<const GearboxId> ids, int fewest,
                        const TileOptions& options) {
    GearboxTile tile = drawn_tile(*plan.sampler, ids,
                                  lockstep::lanes_for(plan.solve->integration().precision, fewest));
    const auto* every_mesh = std::get_if<EveryMeshPeriod>(&plan.solve->strategy);
    if (every_mesh != nullptr && every_mesh->records_only) {
        tile.parts =
            parts_of_records(plan.record, plan.features, tile.realizations, options.repeats);
    }
    run_tile(plan, options, tile);
    return tile;
}

// Adds the times and counts of one tile to those of another.
void add_costs(const GearboxTile& of, GearboxTile& tile) {
    tile.sampling_s += of.sampling_s;
    tile.stiffness_s += of.stiffness_s;
    tile.integration_s += of.integration_s;
    tile.signals_s += of.signals_s;
    tile.integration_cpu_s += of.integration_cpu_s;
    tile.meshes += of.meshes;
    tile.superposed += of.superposed;
    tile.superposition_fallbacks += of.superposition_fallbacks;
}

// Baseline records of the gearboxes, one gearbox after the other.
std::vector<GearboxId> baselines_of(const RecordPlan& record, std::span<const GearboxId> ids) {
    std::vector<GearboxId> earlier;
    for (GearboxId id : ids) {
        id.record = Record::baseline;
        for (id.baseline = 0; id.baseline < record.computed_baselines; ++id.baseline) {
            earlier.push_back(id);
        }
    }
    return earlier;
}

// Computes signals, status and times of the baseline records, at most as many at a time as there
// are lanes. Their motion is freed before the test records are integrated.
GearboxTile run_baselines(const TilePlan& plan, std::span<const GearboxId> ids, int fewest,
                          const TileOptions& options) {
    const int meshes = plan.record.sensor_meshes(plan.features.needs.all());
    const std::vector<GearboxId> earlier = baselines_of(plan.record, ids);
    const auto lanes =
        static_cast<std::size_t>(lockstep::lanes_for(plan.solve->integration().precision, fewest));
    // Order in which they are computed: records at the same positions follow each other.
    std::vector<std::size_t> order(earlier.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (plan.record.same_positions > 1) {
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return earlier[i].baseline; });
    }
    std::vector<GearboxId> ordered;
    std::ranges::transform(order, std::back_inserter(ordered),
                           [&](std::size_t i) { return earlier[i]; });
    GearboxTile all;
    all.baseline.resize(earlier.size());
    all.status.resize(earlier.size());
    for (std::size_t first = 0; first < order.size();) {
        const auto left = std::span<const GearboxId>(ordered).subspan(first);
        const auto some = left.first(shared_records(plan.record, left, lanes));
        GearboxTile tile = run_records(
            plan, some, fewest,
            {.signal_meshes = meshes, .cache = options.cache, .repeats = options.repeats});
        auto start = WallClock::now();
        std::vector<LaneSignals> signals = all_lane_signals(plan, tile, meshes);
        tile.signals_s += lap(start);
        for (std::size_t i = 0; i < some.size(); ++i) {
            all.baseline[order[first + i]] = std::move(signals[i]);
            all.status[order[first + i]] = tile.status[i];
        }
        add_costs(tile, all);
        first += some.size();
    }
    return all;
}

// Replaces the status `ok` of each test record by the first other status of its baseline records.
void merge_baseline_status(std::span<const Status> earlier, GearboxTile& tile) {
    const std::size_t each = earlier.size() / tile.status.size();
    for (std::size_t i = 0; i < earlier.size(); ++i) {
        if (tile.status[i / each] == Status::ok) {
            tile.status[i / each] = earlier[i];
        }
    }
}

void add_baselines(GearboxTile earlier, GearboxTile& tile) {
    tile.baseline = std::move(earlier.baseline);
    merge_baseline_status(earlier.status, tile);
    add_costs(earlier, tile);
}

// Runs gearboxes that leave lanes free for all of their baseline records, which follow the test
// records in the same tile.
GearboxTile run_side_by_side(const TilePlan& plan, std::span<const GearboxId> ids, int lanes,
                             TileOptions options) {
    std::vector<GearboxId> both(ids.begin(), ids.end());
    const std::vector<GearboxId> earlier = baselines_of(plan.record, ids);
    both.insert(both.end(), earlier.begin(), earlier.end());
    if (options.signal_meshes >= 0) {
        options.signal_meshes =
            std::max(options.signal_meshes, plan.record.sensor_meshes(plan.features.needs.all()));
    }
    GearboxTile tile = run_records(plan, both, lanes, options);
    auto start = WallClock::now();
    std::vector<LaneSignals> baseline;
    for (LaneId lane{ids.size()}; lane < both.size(); ++lane) {
        baseline.push_back(
            lane_signals(plan, tile, lane, plan.record.sensor_meshes(plan.features.needs.all())));
    }
    tile.baseline = std::move(baseline);
    tile.signals_s += lap(start);
    const std::vector<Status> all = std::move(tile.status);
    tile.status.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(ids.size()));
    merge_baseline_status(std::span(all).subspan(ids.size()), tile);
    return tile;
}

}  // namespace

GearboxTile run_gearboxes(const TilePlan& plan, std::span<const GearboxId> ids, int fewest,
                          const TileOptions& options) {
    if (plan.record.baselines == 0) {
        return run_records(plan, ids, fewest, options);
    }
    const int lanes = lockstep::lanes_for(plan.solve->integration().precision, fewest);
    const std::size_t records = 1 + plan.record.computed_baselines;
    if (plan.record.same_positions == 1 &&
        records * ids.size() <= static_cast<std::size_t>(lanes)) {
        return run_side_by_side(plan, ids, lanes, options);
    }
    GearboxTile earlier = run_baselines(plan, ids, fewest, options);
    GearboxTile tile = run_records(plan, ids, fewest, options);
    add_baselines(std::move(earlier), tile);
    return tile;
}

std::vector<double> contact_loss(const GearboxTile& tile, LaneId lane, std::size_t meshes) {
    const machine::AlignedVector& ratio = tile.integration.contact_loss;  // [gear pair][lane]
    const std::size_t lanes = tile.realizations.size();
    const std::size_t pairs = ratio.size() / lanes / std::max<std::size_t>(1, meshes);
    std::vector<double> mean(meshes, 0.0);
    for (std::size_t mesh = 0; mesh < meshes; ++mesh) {
        for (PairId pair{mesh * pairs}; pair < (mesh + 1) * pairs; ++pair) {
            mean[mesh] += ratio[pair * lanes + lane];
        }
        mean[mesh] /= static_cast<double>(pairs);
    }
    return mean;
}

GearboxTile run_realizations(const TilePlan& plan, std::vector<Realization> realizations,
                             int fewest, const TileOptions& options) {
    GearboxTile tile = tile_of(std::move(realizations),
                               lockstep::lanes_for(plan.solve->integration().precision, fewest));
    run_tile(plan, options, tile);
    return tile;
}

GearboxTile run_fault_perturbations(const TilePlan& plan, std::vector<Realization> realizations,
                                    int lanes, const lockstep::SpanStates& healthy) {
    GearboxTile tile = tile_of(std::move(realizations), lanes);
    keep_solution(solve(plan, tile.realizations,
                        [&](const TileLoads& loads) {
                            return fault_perturbation(*plan.solve, loads, healthy);
                        }),
                  tile);
    add_status(*plan.gearbox, *plan.solve, tile);
    return tile;
}

GearboxTile complete_tile(const TilePlan& plan, std::span<const GearboxId> ids,
                          lockstep::TileResult integration) {
    GearboxTile tile = drawn_tile(*plan.sampler, ids, static_cast<int>(integration.status.size()));
    tile.integration = std::move(integration);
    add_signals(plan, tile);
    if (plan.record.baselines > 0) {
        add_baselines(run_baselines(plan, ids, static_cast<int>(tile.realizations.size()), {}),
                      tile);
    }
    return tile;
}

}  // namespace gearpod::mc
