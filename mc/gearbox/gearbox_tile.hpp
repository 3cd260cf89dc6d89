// W gearboxes of a study from their sampled inputs to recorded motion and folded signals.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/tile/tile.hpp"
#include "mc/results/results_file.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/sensor/heard_span.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

class MarchCache;  // march_cache.hpp

// One lane of a tile.
struct LaneSignals {
    std::vector<double> folded;   // as GearboxTile::folded
    std::vector<double> te_turn;  // as GearboxTile::te_turn
    std::vector<double> sensor;   // m/s^2 without noise, [mesh * P + p]
    // Of the gearbox's baseline record, kept by the tile; null unless features compare with it.
    const LaneSignals* baseline = nullptr;
};

// A tile's results; `march.records` owns what `views` shows: the healthy mesh alone where `heard`
// has taken the others.
struct GearboxTile {
    std::vector<InstanceInputs> inputs;  // one per lane
    lockstep::TileResult march;
    std::vector<Status> status;  // of the gearboxes asked for
    signals::TileSignals views;
    std::unique_ptr<signals::HeardSpan> heard;  // or null
    signals::Tones tones;                       // interfering; empty without
    machine::AlignedVector folded;   // [bin][lane], (m/s^2)^2; empty for a quasi-static gearbox
    machine::AlignedVector te_turn;  // [sample][lane], rad
    // Of the gearboxes asked for; none unless features compare with it.
    std::vector<LaneSignals> baseline;

    double sampling_s = 0.0, stiffness_s = 0.0, march_s = 0.0, signals_s = 0.0;
    // Records of the gearboxes asked for, baselines among them, that were superposed, and those
    // that were to be but were marched.
    std::ptrdiff_t superposed = 0, marched_instead = 0;
    int meshes = 0;            // mesh periods marched for it, 0 if `march` was there before
    double march_cpu_s = 0.0;  // the march's share of this thread's processor time
};

// The path's tables for a scene.
signals::PathGrid path_grid(const Scene& scene);

// What is wanted of a tile beside its signals.
struct TileWishes {
    // With either, or for its own sake, the records of every mesh.
    bool with_motion = false, keep_states = false;  // as in lockstep::TileSettings
    int contact_meshes = 0;                         // likewise
    bool with_records = false;
    // Mesh periods of the sensor's samples that will be looked at where these are heard; -1: all.
    int signal_meshes = -1;
    const MarchCache* marches = nullptr;  // what was marched before is not marched again
};

// Runs the gearboxes in `ids` (and before them, or beside them where half of the lanes are free,
// their baseline records, where features compare with them: a gearbox whose baseline fails has
// failed), at most as many as there are lanes: `fewest` (16, 8, 4 or 1) or the next number that the
// program has kernels for. Missing lanes repeat the last one. Where every mesh is marched, the
// sensors hear it as it comes, and it is not kept.
GearboxTile run_gearboxes(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, int fewest,
                          const TileWishes& wishes = {});

// The judged records of gearboxes with these inputs, whatever the study's distributions say,
// without baselines.
GearboxTile run_given(const Scene& scene, const signals::PathGrid& path,
                      std::span<const GearboxId> ids, std::vector<InstanceInputs> inputs,
                      int fewest, const TileWishes& wishes = {});

// Of gearboxes with these inputs, as many as there were lanes, the meshes that their faults change,
// marched from the states that were kept of the same without: inputs, march and status alone.
GearboxTile run_changes(const Scene& scene, std::span<const GearboxId> ids,
                        std::vector<InstanceInputs> inputs,
                        const std::vector<lockstep::TileState>& healthy);

// Of what was recorded of the tile's march, which must outlive them.
signals::TileSignals views_of(const Scene& scene, const GearboxTile& tile);

// As run_gearboxes from a march made elsewhere, of as many lanes as it has a status.
GearboxTile tile_of_march(const Scene& scene, const Sampler& sampler, const signals::PathGrid& path,
                          std::span<const GearboxId> ids, lockstep::TileResult march);

// The contact loss ratio of each of the gearbox's meshes: means over the gear pairs of a mesh,
// whose number is `meshes`. None of no meshes.
std::vector<double> contact_loss(const GearboxTile& tile, std::size_t lane, std::size_t meshes);

// `meshes`: mesh periods of sensor signal, 0 for none.
LaneSignals lane_signals(const Scene& scene, const signals::PathGrid& path, const GearboxTile& tile,
                         int lane, int meshes);
// The same of all gearboxes asked for, at once.
std::vector<LaneSignals> all_lane_signals(const Scene& scene, const signals::PathGrid& path,
                                          const GearboxTile& tile, int meshes);

}  // namespace gearpod::mc
