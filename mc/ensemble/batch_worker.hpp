// Computes the rows of batches.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/integration_cache.hpp"
#include "mc/gearbox/realization_features.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {

// Time of one thread in seconds, by task, with counts of the work done.
struct Seconds {
    double sampling = 0.0, stiffness = 0.0, integration = 0.0, signals = 0.0, noise = 0.0,
           features = 0.0;
    long meshes = 0;  // mesh periods integrated, each for a full tile
    long superposed = 0, superposition_fallbacks = 0;  // records, as in GearboxTile
    long gearboxes = 0, records = 0;                   // of lives: number computed

    Seconds& operator+=(const Seconds& other);
    double sum() const { return sampling + stiffness + integration + signals + noise + features; }
};

// Shape of the result rows of a study.
RowShape row_shape(const Study& study);

// Data shared by all workers of a process.
struct BatchTask {
    explicit BatchTask(const Scene& shared_scene)
        : scene(shared_scene),
          path(sensor_paths(scene)),
          cache(scene),
          healthy(healthy_reference(scene, path)) {
        for (std::size_t s = 1; s < path.size(); ++s) {
            additional.push_back(healthy_reference(scene, path, s));
        }
    }

    const Scene& scene;
    const SensorPaths path;
    const IntegrationCache cache;
    const HealthyReference healthy;
    std::vector<HealthyReference> additional;  // of the additional sensors
    // Noise of test gearboxes with several records. If it is tilted, the study must use
    // importance sampling, so that its rows have a column for the weights.
    NoiseSampling graded_noise = NoiseSampling::plain;
};

// Computes rows on one thread. Holds scratch memory: use one object per thread.
class BatchWorker {
  public:
    explicit BatchWorker(const BatchTask& task);

    // Rows of a batch, and its time added to `seconds`. They depend neither on the number of lanes
    // nor on batches computed earlier, to the last bit.
    BatchRows compute(const Batch& batch, Seconds& seconds);
    // Rows of the gearboxes `ids`, with `records` records each.
    BatchRows compute(std::span<const GearboxId> ids, std::size_t records, Seconds& seconds);

  private:
    void add_rows(std::span<const GearboxId> ids, std::size_t records, BatchRows& rows,
                  Seconds& seconds);
    // Adds the row of one record of the gearbox in a lane. `other`: the record with the other
    // fault.
    void add_row(const Realization& record, const GearboxTile& computed, std::size_t lane,
                 const LaneSignals& signals, const LaneSignals& other, BatchRows& rows);

    // Features of the variants of a record: additional sensors, another fault.
    std::vector<double> variants_of(const Realization& record, const LaneSignals& signals,
                                    const LaneSignals& other);

    const BatchTask& task_;
    RealizationFeatures features_;
    std::vector<RealizationFeatures> additional_;  // of the additional sensors
    RowShape shape_;
};

}  // namespace gearpod::mc
