#include "mc/gearbox_tile.hpp"

#include <chrono>

#include "mc/instance_features.hpp"
#include "signals/averaged_te.hpp"
#include "signals/folded_signal.hpp"
#include "signals/path_window.hpp"

namespace gearpod::mc {
namespace {

using Clock = std::chrono::steady_clock;

// Seconds since `start`, which moves on to now.
double lap(Clock::time_point& start) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start).count();
    start = now;
    return seconds;
}

std::string_view window_name(PathWindow window) {
    switch (window) {
        case PathWindow::hann:
            return "hann";
        case PathWindow::rectangular:
            return "rectangular";
        case PathWindow::hamming:
            break;
    }
    return "hamming";
}

lockstep::TileSettings tile_settings(const Scene& scene, bool with_motion) {
    const Numerics& n = scene.study().numerics;
    lockstep::TileSettings settings;
    settings.tolerance = n.settle_tolerance;
    settings.max_meshes = scene.max_meshes();
    settings.march_meshes = n.horizon == Horizon::march ? scene.span_meshes() : 0;
    settings.with_motion = with_motion;
    return settings;
}

template <int W>
void march(const Scene& scene, bool with_motion, GearboxTile& tile) {
    auto start = Clock::now();
    std::vector<dynamics::PlanetaryInputs> inputs;
    lockstep::FaultCurves faults{&scene.pairs(), scene.pattern(), {{}}};
    for (const InstanceInputs& instance : tile.inputs) {
        inputs.push_back(scene.inputs(instance));
        faults.curve[0].push_back(scene.faulty_mesh(instance.fault_depth_m));
    }
    tile.stiffness_s = lap(start);
    tile.march =
        lockstep::run_tile<W>(scene.plan(), inputs, faults, tile_settings(scene, with_motion));
    tile.march_s = lap(start);
}

}  // namespace

signals::PathGrid path_grid(const Scene& scene) {
    return {signals::path_window(window_name(scene.study().effects.path)), scene.train().planets,
            scene.samples_per_mesh(), span_layout(scene)};
}

GearboxTile run_gearboxes(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, int lanes, bool with_motion) {
    auto start = Clock::now();
    GearboxTile tile;
    for (const GearboxId& id : ids) {
        tile.inputs.push_back(sampler.sample(id.group, id.index));
    }
    tile.inputs.resize(static_cast<std::size_t>(lanes), tile.inputs.back());
    tile.sampling_s = lap(start);
    if (lanes == 1) {
        march<1>(scene, with_motion, tile);
    } else {
        march<8>(scene, with_motion, tile);
    }

    start = Clock::now();
    tile.views = {lanes, scene.train().planets, scene.samples_per_mesh(), {}, {}};
    for (const lockstep::MeshRecord& record : tile.march.records) {
        tile.views.accel.push_back(record.acceleration.data());
        tile.views.te.push_back(record.te.data());
    }
    std::vector<double> exponents;
    for (const InstanceInputs& instance : tile.inputs) {
        exponents.push_back(instance.path_exponent);
    }
    const signals::SpanLayout layout = span_layout(scene);
    const signals::FoldPlan plan(tile.march.content, layout);
    signals::fold_squares(tile.views, plan, path, exponents, tile.folded);
    signals::average_te(tile.views, tile.march.content, layout, scene.te_samples_per_mesh(),
                        tile.te_turn);
    tile.signals_s = lap(start);
    return tile;
}

}  // namespace gearpod::mc
