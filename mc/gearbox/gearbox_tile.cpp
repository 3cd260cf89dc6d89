#include "mc/gearbox/gearbox_tile.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "lockstep/kernels/built_kernels.hpp"
#include "lockstep/steps/instability.hpp"
#include "lockstep/tile/quasi_static.hpp"
#include "machine/thread_clock.hpp"
#include "machine/wall_clock.hpp"
#include "mc/gearbox/ears.hpp"
#include "mc/gearbox/lane_count.hpp"
#include "mc/gearbox/march_cache.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/gearbox/tile_draws.hpp"
#include "mc/gearbox/tooth_draws.hpp"
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

// Optional outputs of a time integration, and the healthy states that it may start from.
struct MarchWishes {
    bool with_motion = false;
    int contact_meshes = 0;
    bool keep_states = false;
    const std::vector<lockstep::TileState>* healthy = nullptr;
    std::function<void(int, const lockstep::MeshRecord&)> hear = nullptr;
};

lockstep::TileSettings tile_settings(const Scene& scene, const MarchWishes& wishes) {
    lockstep::TileSettings settings;
    settings.tolerance = settle_tolerance(scene.study());
    settings.max_meshes = scene.max_meshes();
    settings.march_meshes =
        scene.study().numerics.horizon == Horizon::reuse ? 0 : scene.recorded_meshes();
    settings.run_in_meshes = run_in_meshes(scene);
    settings.compose = superposition(scene).healthy && wishes.healthy == nullptr;
    settings.compose_faulty = superposition(scene).faulty;
    settings.with_motion = wishes.with_motion;
    settings.contact_meshes = wishes.contact_meshes;
    settings.keep_states = wishes.keep_states;
    settings.healthy = wishes.healthy;
    settings.hear = wishes.hear;
    return settings;
}

template <int W>
void march(const Scene& scene, std::span<const GearboxId> ids, const MarchWishes& wishes,
           GearboxTile& tile) {
    auto start = WallClock::now();
    std::vector<dynamics::GearboxInputs> inputs;
    lockstep::FaultCurves faults{&scene.pairs(), scene.pattern(), {}};
    faults.curve.resize(static_cast<std::size_t>(scene.fault().curves()));
    for (const InstanceInputs& instance : tile.inputs) {
        inputs.push_back(scene.inputs(instance));
        for (int c = 0; c < scene.fault().curves(); ++c) {
            faults.curve[static_cast<std::size_t>(c)].push_back(
                scene.fault().mesh(c, instance.fault_size));
        }
    }
    const auto tooth_errors = draw_tooth_errors(scene, ids, tile.inputs);
    faults.tooth_errors = tooth_errors ? &*tooth_errors : nullptr;
    tile.stiffness_s = lap(start);
    auto settings = tile_settings(scene, wishes);
    const auto excitation = draw_excitation(scene, ids, tile.inputs);
    settings.excitation = excitation ? &*excitation : nullptr;
    const double processor_start = thread_processor_s();
    if constexpr (W <= 8) {
        tile.march = scene.study().effects.quasi_static()
                         ? lockstep::run_quasi_static<W>(scene.plan(), inputs, faults, settings)
                         : lockstep::run_tile<W>(scene.plan(), inputs, faults, settings);
    } else {
        tile.march = lockstep::run_tile<W>(scene.plan(), inputs, faults, settings);
    }
    tile.march_s = lap(start);
    tile.meshes = tile.march.marched;
    const std::size_t asked = std::min(ids.size(), tile.march.composed.size());
    tile.superposed = std::ranges::count(std::span(tile.march.composed).first(asked), true);
    tile.marched_instead = settings.compose ? std::ssize(ids) - tile.superposed : 0;
    tile.march_cpu_s = thread_processor_s() - processor_start;
}

void march(const Scene& scene, std::span<const GearboxId> ids, const MarchWishes& wishes,
           GearboxTile& tile) {
    with_lane_count(static_cast<int>(tile.inputs.size()),
                    [&](auto width) { march<width()>(scene, ids, wishes, tile); });
}

Status status_of(const Scene& scene, const InstanceInputs& instance, lockstep::LaneStatus status) {
    const bool ok = status == lockstep::LaneStatus::ok;
    const bool diverged = status == lockstep::LaneStatus::diverged;
    if (scene.study().effects.quasi_static()) {
        return ok ? Status::ok : diverged ? Status::no_equilibrium : Status::not_settled;
    }
    if (ok) {
        // A solution without excitation does not grow even if it is unstable.
        return lockstep::above_critical_speed(scene.plan().layout, scene.inputs(instance),
                                              scene.mean_pairs())
                   ? Status::supercritical
                   : Status::ok;
    }
    switch (lockstep::find_instability(scene.plan(), scene.inputs(instance))) {
        case lockstep::Instability::turning_frame:
            return Status::supercritical;
        case lockstep::Instability::parametric:
            return Status::parametric;
        case lockstep::Instability::step:
            return Status::step_too_long;
        case lockstep::Instability::none:
            break;
    }
    return diverged ? Status::diverged : Status::not_settled;
}

}  // namespace

signals::PathGrid path_grid(const Scene& scene) {
    const auto* planetary = dynamic_cast<const PlanetaryDrive*>(&scene.drive());
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
        tile.status.push_back(status_of(scene, tile.inputs[lane], tile.march.status[lane]));
    }
}

void march_and_hear(const Scene& scene, const signals::PathGrid& path,
                    std::span<const GearboxId> ids, int signal_meshes, MarchWishes wishes,
                    GearboxTile& tile) {
    Ears ears(scene, path, ids, tile.inputs, signal_meshes);
    wishes.hear = std::ref(ears);
    march(scene, ids, wishes, tile);
    tile.heard = ears.take_heard();
    tile.march_s -= ears.spent_s();
    tile.march_cpu_s -= ears.spent_s();
    tile.signals_s += ears.spent_s();
}

// Computes the signals of the sensors from an integrated tile.
void add_signals(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
                 GearboxTile& tile) {
    add_status(scene, ids, tile);
    auto start = WallClock::now();
    tile.views = views_of(scene, tile);
    if (tile.heard != nullptr) {
        tile.folded = tile.heard->folded();
        tile.te_turn = tile.heard->averaged_te();
        tile.signals_s += lap(start);
        return;
    }
    if (has_gain(tile.inputs)) {
        for (lockstep::MeshRecord& record : tile.march.records) {
            amplify(tile.inputs, record.acceleration);
        }
    }
    // A quasi-static gearbox has no inertia and therefore no acceleration.
    if (!scene.study().effects.quasi_static()) {
        tile.tones = draw_tones(scene, ids, tile.inputs);
        const signals::FoldPlan plan(tile.march.content, scene.span());
        signals::fold_squares(tile.views, plan, path, path_exponents(tile.inputs), tile.tones,
                              tile.folded);
    }
    signals::average_te(tile.views, tile.march.content, scene.span(), scene.te_samples_per_mesh(),
                        tile.te_turn);
    tile.signals_s += lap(start);
}

void run_sampled(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
                 const TileWishes& wanted, GearboxTile& tile) {
    const MarchCache* const kept = wanted.with_motion ? nullptr : wanted.marches;
    const MarchWishes wishes{.with_motion = wanted.with_motion,
                             .contact_meshes = wanted.contact_meshes,
                             .keep_states = wanted.keep_states};
    const bool recorded = wanted.with_motion || wanted.keep_states || wanted.with_records;
    auto start = WallClock::now();
    if (const auto before = kept != nullptr ? kept->find(tile.inputs) : nullptr) {
        tile.march = *before;
        tile.march_s = lap(start);
    } else if (hears_march(scene) && !recorded) {
        march_and_hear(scene, path, ids, wanted.signal_meshes, wishes, tile);
    } else {
        march(scene, ids, wishes, tile);
        if (kept != nullptr) {
            kept->keep(tile.inputs, tile.march);
        }
    }
    add_signals(scene, path, ids, tile);
}

GearboxTile run_records(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                        std::span<const GearboxId> ids, int fewest, const TileWishes& wishes) {
    GearboxTile tile =
        sampled_tile(sampler, ids, lockstep::lanes_for(scene.plan().precision, fewest));
    run_sampled(scene, path, ids, wishes, tile);
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
                          std::span<const GearboxId> ids, int fewest, const MarchCache* marches) {
    const int meshes = looked_at_meshes(scene);
    GearboxTile tile = run_records(scene, sampler, path, baselines_of(ids), fewest,
                                   {.signal_meshes = meshes, .marches = marches});
    auto start = WallClock::now();
    tile.baseline = all_lane_signals(scene, path, tile, meshes);
    tile.signals_s += lap(start);
    tile.heard = nullptr;
    tile.march = {};
    tile.views = {};
    tile.folded = {};
    tile.te_turn = {};
    return tile;
}

// Replaces the status `ok` of each test record by the status of its baseline record.
void judge_with_baselines(std::span<const Status> earlier, GearboxTile& tile) {
    for (std::size_t lane = 0; lane < tile.status.size(); ++lane) {
        if (tile.status[lane] == Status::ok) {
            tile.status[lane] = earlier[lane];
        }
    }
}

void add_baselines(GearboxTile earlier, GearboxTile& tile) {
    tile.baseline = std::move(earlier.baseline);
    judge_with_baselines(earlier.status, tile);
    tile.sampling_s += earlier.sampling_s;
    tile.stiffness_s += earlier.stiffness_s;
    tile.march_s += earlier.march_s;
    tile.signals_s += earlier.signals_s;
    tile.march_cpu_s += earlier.march_cpu_s;
    tile.meshes += earlier.meshes;
    tile.superposed += earlier.superposed;
    tile.marched_instead += earlier.marched_instead;
}

// Runs gearboxes that fill at most half of the lanes. Their baseline records take further lanes of
// the same tile, after the test records.
GearboxTile run_side_by_side(const Scene& scene, const Sampler& sampler,
                             const signals::PathGrid& path, std::span<const GearboxId> ids,
                             int lanes, TileWishes wishes) {
    std::vector<GearboxId> both(ids.begin(), ids.end());
    const std::vector<GearboxId> earlier = baselines_of(ids);
    both.insert(both.end(), earlier.begin(), earlier.end());
    if (wishes.signal_meshes >= 0) {
        wishes.signal_meshes = std::max(wishes.signal_meshes, looked_at_meshes(scene));
    }
    GearboxTile tile = run_records(scene, sampler, path, both, lanes, wishes);
    auto start = WallClock::now();
    std::vector<LaneSignals> baseline;
    for (std::size_t lane = ids.size(); lane < both.size(); ++lane) {
        baseline.push_back(
            lane_signals(scene, path, tile, static_cast<int>(lane), looked_at_meshes(scene)));
    }
    tile.baseline = std::move(baseline);
    tile.signals_s += lap(start);
    const std::vector<Status> all = std::move(tile.status);
    tile.status.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(ids.size()));
    judge_with_baselines(std::span(all).subspan(ids.size()), tile);
    return tile;
}

}  // namespace

GearboxTile run_gearboxes(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, int fewest, const TileWishes& wishes) {
    if (!compares_records(scene.study())) {
        return run_records(scene, sampler, path, ids, fewest, wishes);
    }
    const int lanes = lockstep::lanes_for(scene.plan().precision, fewest);
    if (2 * ids.size() <= static_cast<std::size_t>(lanes)) {
        return run_side_by_side(scene, sampler, path, ids, lanes, wishes);
    }
    GearboxTile earlier = run_baselines(scene, sampler, path, ids, fewest, wishes.marches);
    GearboxTile tile = run_records(scene, sampler, path, ids, fewest, wishes);
    add_baselines(std::move(earlier), tile);
    return tile;
}

std::vector<double> contact_loss(const GearboxTile& tile, std::size_t lane, std::size_t meshes) {
    const machine::AlignedVector& ratio = tile.march.contact_loss;  // [gear pair][lane]
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

GearboxTile run_given(const Scene& scene, const signals::PathGrid& path,
                      std::span<const GearboxId> ids, std::vector<InstanceInputs> inputs,
                      int fewest, const TileWishes& wishes) {
    GearboxTile tile;
    tile.inputs = std::move(inputs);
    tile.inputs.resize(
        static_cast<std::size_t>(lockstep::lanes_for(scene.plan().precision, fewest)),
        tile.inputs.back());
    run_sampled(scene, path, ids, wishes, tile);
    return tile;
}

GearboxTile run_changes(const Scene& scene, std::span<const GearboxId> ids,
                        std::vector<InstanceInputs> inputs,
                        const std::vector<lockstep::TileState>& healthy) {
    GearboxTile tile;
    tile.inputs = std::move(inputs);
    march(scene, ids, {.healthy = &healthy}, tile);
    add_status(scene, ids, tile);
    return tile;
}

GearboxTile tile_of_march(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, lockstep::TileResult march) {
    GearboxTile tile = sampled_tile(sampler, ids, static_cast<int>(march.status.size()));
    tile.march = std::move(march);
    add_signals(scene, path, ids, tile);
    if (compares_records(scene.study())) {
        add_baselines(
            run_baselines(scene, sampler, path, ids, static_cast<int>(tile.inputs.size()), nullptr),
            tile);
    }
    return tile;
}

}  // namespace gearpod::mc
