// Computes batches: from a batch's place in the ensemble to its rows.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/instance_features.hpp"
#include "mc/gearbox/march_cache.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {

// Seconds of one thread, by what it did.
struct Seconds {
    double sampling = 0.0, stiffness = 0.0, march = 0.0, signals = 0.0, noise = 0.0, features = 0.0;
    long meshes = 0;  // no time: mesh periods marched, each of as many gearboxes as there are lanes
    long superposed = 0, marched_instead = 0;  // no time: records (GearboxTile)
    long gearboxes = 0, records = 0;           // of lives, no time: how many were computed

    Seconds& operator+=(const Seconds& other);
    double sum() const { return sampling + stiffness + march + signals + noise + features; }
};

// The rows' shape for a scene.
RowShape row_shape(const Sampler& sampler, const Study& study);

// What all workers share, made once.
struct BatchTask {
    explicit BatchTask(const Scene& shared_scene)
        : scene(shared_scene),
          sampler(scene.study()),
          path(path_grid(scene)),
          marches(scene),
          healthy(healthy_reference(scene, sampler, path)) {}

    const Scene& scene;
    const Sampler sampler;
    const signals::PathGrid path;
    const MarchCache marches;
    const HealthyReference healthy;
    // Of graded gearboxes of several records; the sampler must have a column for their weights.
    NoiseDraws graded_draws = NoiseDraws::plain;
};

// Holds scratch memory: one object per thread.
class BatchWorker {
  public:
    explicit BatchWorker(const BatchTask& task);

    // The same bits whatever the lanes and whatever was computed before. Adds its time to
    // `seconds`.
    BatchRows compute(const Batch& batch, Seconds& seconds);
    // Of any gearboxes, so many records of each.
    BatchRows compute(std::span<const GearboxId> ids, std::size_t records, Seconds& seconds);

  private:
    void add_rows(std::span<const GearboxId> ids, std::size_t records, BatchRows& rows,
                  Seconds& seconds);
    void add_features(const GearboxId& id, const GearboxTile& computed, std::size_t lane,
                      const LaneSignals& signals, BatchRows& rows);

    const BatchTask& task_;
    InstanceFeatures features_;
    RowShape shape_;
};

}  // namespace gearpod::mc
