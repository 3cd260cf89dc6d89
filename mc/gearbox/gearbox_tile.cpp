#include "mc/gearbox/gearbox_tile.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "lockstep/kernels/built_kernels.hpp"
#include "lockstep/steps/instability.hpp"
#include "machine/thread_clock.hpp"
#include "machine/wall_clock.hpp"
#include "mc/gearbox/integration_cache.hpp"
#include "mc/gearbox/lane_count.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/gearbox/random_tooth_errors.hpp"
#include "mc/gearbox/solution_choice.hpp"
#include "mc/gearbox/tile_random_inputs.hpp"
#include "mc/gearbox/tile_sensor_recorder.hpp"
#include "signals/path/path_window.hpp"
#include "signals/sensor/sensor.hpp"
#include "signals/spectra/averaged_te.hpp"
#include "signals/windowing/folded_signal.hpp"

namespace gearpod::mc {
namespace {

// Returns the seconds since `start` and sets `start` to now.
double lap(WallClock::time_point& start) {
    const auto now = WallClock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

lockstep::FaultCurves fault_curves(const Scene& scene, std::span<const InstanceInputs> inputs) {
    lockstep::FaultCurves faults{&scene.pairs(), scene.pattern(), {}};
    faults.curve.resize(static_cast<std::size_t>(scene.fault().curves()));
    for (int c = 0; c < scene.fault().curves(); ++c) {
        for (const InstanceInputs& instance : inputs) {
            faults.curve[static_cast<std::size_t>(c)].push_back(
                scene.fault().mesh(c, instance.fault_size));
        }
    }
    return faults;
}

// Solves the tile by the strategy that solution_of(loads) returns.
template <class SolutionOf>
void solve(const Scene& scene, std::span<const GearboxId> ids, SolutionOf solution_of,
           GearboxTile& tile) {
    auto start = WallClock::now();
    std::vector<dynamics::GearboxInputs> inputs;
    for (const InstanceInputs& instance : tile.inputs) {
        inputs.push_back(scene.inputs(instance));
    }
    const lockstep::FaultCurves faults = fault_curves(scene, tile.inputs);
    TileLoads loads{draw_tooth_errors(scene, ids, tile.inputs), std::nullopt};
    tile.stiffness_s = lap(start);
    loads.excitation = draw_excitation(scene, ids, tile.inputs);
    const lockstep::Solution solution = solution_of(loads);
    const double processor_start = thread_processor_s();
    tile.integration = with_lane_count(static_cast<int>(inputs.size()), [&](auto lanes) {
        return lockstep::run_tile<lanes()>(scene.plan(), inputs, faults, solution);
    });
    tile.integration_s = lap(start);
    tile.meshes = tile.integration.integrated_meshes;
    if (const std::vector<char>& superposed = tile.integration.superposed; !superposed.empty()) {
        tile.superposed = std::ranges::count(std::span(superposed).first(ids.size()), true);
        tile.superposition_fallbacks = std::ssize(ids) - tile.superposed;
    }
    tile.integration_cpu_s = thread_processor_s() - processor_start;
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

}  // namespace

signals::PathGrid path_grid(const Scene& scene) {
    const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(&scene.drivetrain());
    if (planetary == nullptr || scene.study().effects.path == nullptr) {
        // A sensor on the housing: one window with constant weight.
        return {signals::path_window("rectangular"), 1, scene.samples_per_mesh(), scene.span()};
    }
    const auto sense = planetary->carrier_turns_backwards() ? signals::CarrierSense::negative
                                                            : signals::CarrierSense::positive;
    return {*scene.study().effects.path, gears::planet_places(planetary->train()),
            scene.samples_per_mesh(), scene.span(), sense};
}

namespace {

GearboxTile sampled_tile(const Sampler& sampler, std::span<const GearboxId> ids, int lanes) {
    auto start = WallClock::now();
    GearboxTile tile;
    for (const GearboxId& id : ids) {
        tile.inputs.push_back(sampler.sample(id));
    }
    tile.inputs.resize(static_cast<std::size_t>(lanes), tile.inputs.back());
    tile.sampling_s = lap(start);
    return tile;
}

void add_status(const Scene& scene, std::span<const GearboxId> ids, GearboxTile& tile) {
    for (std::size_t lane = 0; lane < ids.size(); ++lane) {
        tile.status.push_back(status_of(scene, tile.inputs[lane], tile.integration.status[lane]));
    }
}

// Solves the tile and records its sensor signals meanwhile.
void solve_and_record(const Scene& scene, const signals::PathGrid& path,
                      std::span<const GearboxId> ids, int signal_meshes, GearboxTile& tile) {
    TileSensorRecorder recorder(scene, path, ids, tile.inputs, signal_meshes);
    solve(
        scene, ids,
        [&](const TileLoads& loads) {
            return choose_solution(scene, loads, {}, std::ref(recorder));
        },
        tile);
    tile.sensor_response = recorder.take_response();
    tile.integration_s -= recorder.spent_s();
    tile.integration_cpu_s -= recorder.spent_s();
    tile.signals_s += recorder.spent_s();
}

// Computes the signals of the sensors from an integrated tile.
void add_signals(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
                 GearboxTile& tile) {
    add_status(scene, ids, tile);
    auto start = WallClock::now();
    tile.views = views_of(scene, tile);
    if (tile.sensor_response != nullptr) {
        tile.folded = tile.sensor_response->folded();
        tile.te_turn = tile.sensor_response->averaged_te();
        tile.signals_s += lap(start);
        return;
    }
    if (has_gain(tile.inputs)) {
        for (lockstep::MeshRecord& record : tile.integration.records) {
            apply_gain(tile.inputs, record.acceleration);
        }
    }
    // A quasi-static gearbox has no inertia and therefore no acceleration.
    if (!scene.study().effects.quasi_static()) {
        tile.tones = draw_tones(scene, ids, tile.inputs);
        const signals::FoldPlan plan(tile.integration.content, scene.span());
        signals::fold_squares(tile.views, plan, path, path_exponents(tile.inputs), tile.tones,
                              tile.folded);
    }
    signals::average_te(tile.views, tile.integration.content, scene.span(),
                        scene.te_samples_per_mesh(), tile.te_turn);
    tile.signals_s += lap(start);
}

void run_sampled(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
                 const TileOptions& options, GearboxTile& tile) {
    const IntegrationCache* const cache = options.records ? nullptr : options.cache;
    auto start = WallClock::now();
    if (const auto before = cache != nullptr ? cache->find(tile.inputs) : nullptr) {
        tile.integration = *before;
        tile.integration_s = lap(start);
    } else if (records_during_integration(scene) && !options.records) {
        solve_and_record(scene, path, ids, options.signal_meshes, tile);
    } else {
        const auto records = options.records.value_or(lockstep::RecordOptions{});
        solve(
            scene, ids,
            [&](const TileLoads& loads) { return choose_solution(scene, loads, records, nullptr); },
            tile);
        if (cache != nullptr) {
            cache->keep(tile.inputs, tile.integration);
        }
    }
    add_signals(scene, path, ids, tile);
}

GearboxTile run_records(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                        std::span<const GearboxId> ids, int fewest, const TileOptions& options) {
    GearboxTile tile =
        sampled_tile(sampler, ids, lockstep::lanes_for(scene.plan().precision, fewest));
    run_sampled(scene, path, ids, options, tile);
    return tile;
}

std::vector<GearboxId> baselines_of(std::span<const GearboxId> ids) {
    std::vector<GearboxId> earlier(ids.begin(), ids.end());
    for (GearboxId& id : earlier) {
        id.record = Record::baseline;
    }
    return earlier;
}

// Computes signals, status and times of the baseline records. Their motion is freed before the test
// records are integrated.
GearboxTile run_baselines(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, int fewest,
                          const IntegrationCache* cache) {
    const int meshes = needed_sensor_meshes(scene);
    GearboxTile tile = run_records(scene, sampler, path, baselines_of(ids), fewest,
                                   {.signal_meshes = meshes, .cache = cache});
    auto start = WallClock::now();
    tile.baseline = all_lane_signals(scene, path, tile, meshes);
    tile.signals_s += lap(start);
    tile.sensor_response = nullptr;
    tile.integration = {};
    tile.views = {};
    tile.folded = {};
    tile.te_turn = {};
    return tile;
}

// Replaces the status `ok` of each test record by the status of its baseline record.
void merge_baseline_status(std::span<const Status> earlier, GearboxTile& tile) {
    for (std::size_t lane = 0; lane < tile.status.size(); ++lane) {
        if (tile.status[lane] == Status::ok) {
            tile.status[lane] = earlier[lane];
        }
    }
}

void add_baselines(GearboxTile earlier, GearboxTile& tile) {
    tile.baseline = std::move(earlier.baseline);
    merge_baseline_status(earlier.status, tile);
    tile.sampling_s += earlier.sampling_s;
    tile.stiffness_s += earlier.stiffness_s;
    tile.integration_s += earlier.integration_s;
    tile.signals_s += earlier.signals_s;
    tile.integration_cpu_s += earlier.integration_cpu_s;
    tile.meshes += earlier.meshes;
    tile.superposed += earlier.superposed;
    tile.superposition_fallbacks += earlier.superposition_fallbacks;
}

// Runs gearboxes that fill at most half of the lanes. Their baseline records take further lanes of
// the same tile, after the test records.
GearboxTile run_side_by_side(const Scene& scene, const Sampler& sampler,
                             const signals::PathGrid& path, std::span<const GearboxId> ids,
                             int lanes, TileOptions options) {
    std::vector<GearboxId> both(ids.begin(), ids.end());
    const std::vector<GearboxId> earlier = baselines_of(ids);
    both.insert(both.end(), earlier.begin(), earlier.end());
    if (options.signal_meshes >= 0) {
        options.signal_meshes = std::max(options.signal_meshes, needed_sensor_meshes(scene));
    }
    GearboxTile tile = run_records(scene, sampler, path, both, lanes, options);
    auto start = WallClock::now();
    std::vector<LaneSignals> baseline;
    for (std::size_t lane = ids.size(); lane < both.size(); ++lane) {
        baseline.push_back(
            lane_signals(scene, path, tile, static_cast<int>(lane), needed_sensor_meshes(scene)));
    }
    tile.baseline = std::move(baseline);
    tile.signals_s += lap(start);
    const std::vector<Status> all = std::move(tile.status);
    tile.status.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(ids.size()));
    merge_baseline_status(std::span(all).subspan(ids.size()), tile);
    return tile;
}

}  // namespace

GearboxTile run_gearboxes(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, int fewest, const TileOptions& options) {
    if (!compares_records(scene.study())) {
        return run_records(scene, sampler, path, ids, fewest, options);
    }
    const int lanes = lockstep::lanes_for(scene.plan().precision, fewest);
    if (2 * ids.size() <= static_cast<std::size_t>(lanes)) {
        return run_side_by_side(scene, sampler, path, ids, lanes, options);
    }
    GearboxTile earlier = run_baselines(scene, sampler, path, ids, fewest, options.cache);
    GearboxTile tile = run_records(scene, sampler, path, ids, fewest, options);
    add_baselines(std::move(earlier), tile);
    return tile;
}

std::vector<double> contact_loss(const GearboxTile& tile, std::size_t lane, std::size_t meshes) {
    const machine::AlignedVector& ratio = tile.integration.contact_loss;  // [gear pair][lane]
    const std::size_t lanes = tile.inputs.size();
    const std::size_t pairs = ratio.size() / lanes / std::max<std::size_t>(1, meshes);
    std::vector<double> mean(meshes, 0.0);
    for (std::size_t mesh = 0; mesh < meshes; ++mesh) {
        for (std::size_t pair = mesh * pairs; pair < (mesh + 1) * pairs; ++pair) {
            mean[mesh] += ratio[pair * lanes + lane];
        }
        mean[mesh] /= static_cast<double>(pairs);
    }
    return mean;
}

GearboxTile run_with_inputs(const Scene& scene, const signals::PathGrid& path,
                            std::span<const GearboxId> ids, std::vector<InstanceInputs> inputs,
                            int fewest, const TileOptions& options) {
    GearboxTile tile;
    tile.inputs = std::move(inputs);
    tile.inputs.resize(
        static_cast<std::size_t>(lockstep::lanes_for(scene.plan().precision, fewest)),
        tile.inputs.back());
    run_sampled(scene, path, ids, options, tile);
    return tile;
}

GearboxTile run_fault_perturbations(const Scene& scene, std::span<const GearboxId> ids,
                                    std::vector<InstanceInputs> inputs,
                                    const lockstep::SpanStates& healthy) {
    GearboxTile tile;
    tile.inputs = std::move(inputs);
    solve(
        scene, ids,
        [&](const TileLoads& loads) { return fault_perturbation(scene, loads, healthy); }, tile);
    add_status(scene, ids, tile);
    return tile;
}

GearboxTile complete_tile(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, lockstep::TileResult integration) {
    GearboxTile tile = sampled_tile(sampler, ids, static_cast<int>(integration.status.size()));
    tile.integration = std::move(integration);
    add_signals(scene, path, ids, tile);
    if (compares_records(scene.study())) {
        add_baselines(
            run_baselines(scene, sampler, path, ids, static_cast<int>(tile.inputs.size()), nullptr),
            tile);
    }
    return tile;
}

}  // namespace gearpod::mc
