// A pilot: a few gearboxes of a study on which ways to compute it are compared. Draws, noise and
// sampling grid are the same whatever computes them, so all that differs is numerical.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::mc {

// What one way to compute gives of a pilot's gearboxes.
struct PilotRecord {
    std::vector<bool> ok;                       // by gearbox
    std::vector<std::vector<double>> sensor;    // by gearbox, m/s^2, noise-free, at every sample
    std::vector<std::vector<double>> te;        // by gearbox, rad, without its mean
    std::vector<std::vector<double>> features;  // by gearbox, [feature * noise levels + level]
    int features_used = 0, levels = 0;
    int steps = 0;             // a mesh period
    double tile_meshes = 0.0;  // mesh periods marched, of a tile of the gearboxes at once
    // Processor time of one thread and gearbox, in full tiles of as many lanes as a run has.
    double march_s = 0.0;  // the march alone
    double total_s = 0.0;  // sampling, stiffness, march, signals and features

    double meshes_per_tile() const;
    // The march's processor time of one gearbox and mesh period.
    double mesh_s() const;
};

// Gearboxes `first`, `first` + `stride`, ... of the graded group: one tile of eight, whatever
// numerics.lanes says, so that what is found does not depend on it.
std::vector<GearboxId> pilot_gearboxes(std::uint64_t first = 0, std::uint64_t stride = 1);

// Signals cover the fault's pattern (one mesh period without a fault), at most so many.
inline constexpr int kMostSignalMeshes = 200;

// Some gearboxes of a study, to be computed in several ways.
class Pilot {
  public:
    // Of the study of `scene`, whatever its numerics.
    explicit Pilot(const Scene& scene, std::vector<GearboxId> ids = pilot_gearboxes());
    std::size_t size() const { return ids_.size(); }
    // `scene`: of the same study but for its numerics.
    PilotRecord run(const Scene& scene) const;
    // What another program's march of them gives; one tile of eight lanes at a time.
    using March = std::function<lockstep::TileResult(std::span<const GearboxId>)>;
    PilotRecord of_march(const Scene& scene, const March& march) const;

  private:
    using Tile = std::function<GearboxTile(std::span<const GearboxId>)>;
    PilotRecord record(const Scene& scene, int lanes, const Tile& tile_of) const;

    std::vector<GearboxId> ids_;
    Sampler sampler_;
    signals::PathGrid path_;
};

// How far a record is from a reference.
struct PilotError {
    // Relative L2: root of the squared differences of all gearboxes and samples over that of the
    // reference's squares (of the TE: without its mean). Infinite where gearboxes failed that the
    // reference has.
    double sensor = 0.0, te = 0.0;
    // By feature and noise level, the same over the gearboxes: [feature * noise levels + level].
    std::vector<double> relative;
    // Likewise, but in the feature's unit: root mean square, and the largest of a gearbox.
    std::vector<double> rms, largest;

    // Of feature `f`, the largest over noise levels.
    double feature(int f, int levels) const;
    double largest_feature() const;
    double signals() const;  // the larger of sensor and TE
};
PilotError pilot_error(const PilotRecord& record, const PilotRecord& reference);

}  // namespace gearpod::mc
