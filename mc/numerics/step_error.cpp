#include "mc/numerics/step_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lockstep/kernels/built_kernels.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

constexpr int kMeshes = 16;

// Sums of the squared deviation from a reference, and of the reference and its squares.
struct Squares {
    double deviation = 0.0, sum = 0.0, squares = 0.0, count = 0.0;

    void add(double value, double reference) {
        deviation += (value - reference) * (value - reference);
        sum += reference;
        squares += reference * reference;
        count += 1.0;
    }
    // Relative root mean square error; `about_mean`: relative to the reference without its mean,
    // for signals whose mean has no meaning.
    double relative(bool about_mean) const {
        const double own = squares - (about_mean ? sum * sum / std::max(1.0, count) : 0.0);
        return own > 0.0 ? std::sqrt(deviation / own) : 0.0;
    }
};

class StepPilot {
  public:
    explicit StepPilot(const Scene& scene) {
        for (const GearboxId& id : pilot_gearboxes()) {
            gearboxes_.push_back(scene.sampler().draw(id));
        }
    }

    GearboxTile run(const Scene& scene) const {
        const int lanes =
            lockstep::lanes_for(scene.plan().precision, static_cast<int>(gearboxes_.size()));
        return run_realizations(scene, sensor_paths(scene), gearboxes_, lanes,
                                {.records = lockstep::RecordOptions{}});
    }

    std::size_t size() const { return gearboxes_.size(); }

  private:
    std::vector<Realization> gearboxes_;
};

const lockstep::MeshRecord& record_of(const GearboxTile& tile, int mesh) {
    const std::vector<int>& content = tile.integration.content;
    return tile.integration.records[static_cast<std::size_t>(
        content[static_cast<std::size_t>(mesh) % content.size()])];
}

void add_lane(const machine::AlignedVector& values, std::size_t lanes,
              const machine::AlignedVector& reference, std::size_t reference_lanes,
              std::size_t lane, Squares& squares) {
    for (std::size_t row = 0; row < values.size() / lanes; ++row) {
        squares.add(values[row * lanes + lane], reference[row * reference_lanes + lane]);
    }
}

}  // namespace

std::optional<StepError> find_step_error(const Scene& scene, double most_meshes) {
    if (scene.study().effects.quasi_static() || !teeth_can_separate(scene.study())) {
        return std::nullopt;
    }
    FinerScene finer = with_finer_steps(scene);
    if (!finer.scene) {
        return std::nullopt;
    }
    Numerics in_double_precision = finer.scene->study().numerics;
    in_double_precision.precision = Precision::double_precision;
    const Scene coarse = scene.recording_at_most(kMeshes);
    const Scene fine = finer.scene->with(in_double_precision).recording_at_most(kMeshes);
    const double ratio = static_cast<double>(fine.plan().grid.steps.size()) /
                         static_cast<double>(coarse.plan().grid.steps.size());
    if (integrated_meshes(coarse) * (1.0 + ratio) > most_meshes) {
        return std::nullopt;
    }
    const StepPilot pilot(scene);
    const GearboxTile own = pilot.run(coarse), reference = pilot.run(fine);
    Squares sensor, te;
    StepError error;
    error.meshes = std::min(kMeshes, coarse.recorded_meshes());
    for (std::size_t lane = 0; lane < pilot.size(); ++lane) {
        if (own.status[lane] != Status::ok || reference.status[lane] != Status::ok) {
            continue;
        }
        ++error.gearboxes;
        for (int mesh = 0; mesh < error.meshes; ++mesh) {
            const lockstep::MeshRecord &a = record_of(own, mesh), &b = record_of(reference, mesh);
            add_lane(a.acceleration, own.realizations.size(), b.acceleration,
                     reference.realizations.size(), lane, sensor);
            add_lane(a.te, own.realizations.size(), b.te, reference.realizations.size(), lane, te);
        }
    }
    if (error.gearboxes == 0) {
        return std::nullopt;
    }
    error.sensor = sensor.relative(false);
    error.te = te.relative(true);
    error.steps = static_cast<int>(coarse.plan().grid.steps.size());
    error.finer_steps = static_cast<int>(fine.plan().grid.steps.size());
    return error;
}

std::optional<StepError> find_step_error_of_run(const Scene& scene, std::size_t gearboxes) {
    constexpr double kShare = 0.02;
    const double tiles = static_cast<double>(gearboxes) / scene.study().numerics.lanes;
    return find_step_error(scene, kShare * tiles * integrated_meshes(scene));
}

std::string step_error_text(const StepError& error) {
    return fmt::format(
        "relative rms {:.1e} of the acceleration in the sensor's band and {:.1e} of the "
        "transmission error (difference between {} and {} steps per mesh period; {} gearboxes, "
        "{} mesh periods)",
        error.sensor, error.te, error.steps, error.finer_steps, error.gearboxes, error.meshes);
}

}  // namespace gearpod::mc
