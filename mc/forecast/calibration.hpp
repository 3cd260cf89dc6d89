// What a run of a study costs, measured on some of its gearboxes by the code that runs them.
#pragma once

#include <array>
#include <vector>

#include "mc/ensemble/batch_worker.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Seconds of one thread for a tile: as many gearboxes as there are lanes, computed at once.
struct TileCost {
    Seconds whole;      // of any tile, full or not: sampling, stiffness, march, signals
    Seconds row;        // of each of its gearboxes: noise, features
    double rest = 0.0;  // of any tile: asking gearboxes that failed why, waiting for a processor

    double seconds(std::size_t rows) const {
        return whole.sum() + rest + static_cast<double>(rows) * row.sum();
    }
};

// Of the gearboxes of one group.
struct GroupCost {
    TileCost fresh;   // marched
    TileCost reused;  // with a motion that an earlier tile left behind (march_cache.hpp)
};

// Process memory, bytes.
struct MemoryUse {
    double before = 0.0;   // the most before any gearbox was computed
    double peak = 0.0;     // and after
    double records = 0.0;  // that a run has beside it: motion that was not recorded
    double kept = 0.0;     // likewise: motions kept for later tiles
};

struct RunCalibration {
    int threads = 0;
    double wall_s = 0.0;  // of the tiles
    double task_s = 0.0;  // what all threads share: path tables, healthy records
    // A thread's first tile takes so much longer: its tables, cold caches, fresh memory.
    double start_s = 0.0;
    std::array<GroupCost, 2> cost;  // by Group
    // The gearboxes that were computed, an entry each; rows as BatchRows has them.
    std::vector<GearboxId> gearboxes;
    BatchRows rows;
    // Mesh periods recorded one by one of those that a run records; fewer only where every mesh is
    // marched and a tile would take too long. `cost` is that of all of them.
    int recorded = 0, to_record = 0;
    long meshes = 0;  // marched in all
    MemoryUse memory;
    // Where even a tile of the fewest mesh periods takes too long, nothing is computed but one
    // healthy mesh period, and `cost` has a march of as many as it takes.
    bool march_alone = false;
};

inline constexpr int kFewestMeshes = 8;
// The longest tile that is computed, seconds by the time of a mesh period.
inline constexpr double kLongestTile_s = 5.0;

// Computes tiles from all over the ensemble on all threads at once: two a thread (unless there
// are fewer, or they are slow), and more until `budget_s` seconds are over. A tile that would take
// longer than that because every mesh is marched records fewer meshes, kFewestMeshes at least; its
// march then counts for what all of them take.
RunCalibration calibrate_run(const Scene& scene, const BatchPlan& plan, int threads,
                             double budget_s);

}  // namespace gearpod::mc
