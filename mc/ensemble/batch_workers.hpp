// Computes the rows of batches.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "machine/fields.hpp"
#include "machine/ids.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/results/result_rows.hpp"

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
GEARPOD_FIELDS(Seconds, sampling, stiffness, integration, signals, noise, features, meshes_,
               superposed_, superposition_fallbacks_, gearboxes_, records_)

// Data shared by all workers of a process.
struct BatchTask {
    // Both plans must outlive the object.
    BatchTask(const TilePlan& tile_plan, const EnsemblePlan& ensemble_plan)
        : tile(tile_plan),
          ensemble(ensemble_plan),
          cache(*tile.solve),
          healthy(healthy_reference(tile)) {
        for (std::size_t s = 1; s < tile.sensors->size(); ++s) {
            additional.push_back(healthy_reference(tile, s));
        }
    }

    const TilePlan& tile;
    const EnsemblePlan& ensemble;
    const IntegrationCache cache;
    const HealthyReference healthy;
    std::vector<HealthyReference> additional;  // of the additional sensors
    // Noise of test gearboxes with several records. If it is tilted, the study must use
    // importance sampling, so that its rows have a column for the weights.
    NoiseSampling test_noise = NoiseSampling::plain;
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
    void add_row(const Realization& record, const GearboxTile& computed, LaneId lane,
                 const LaneSignals& signals, const LaneSignals& other, BatchRows& rows);

    // Features of the variants of a record: additional sensors, another fault.
    std::vector<double> variants_of(const Realization& record, const LaneSignals& signals,
                                    const LaneSignals& other);

    const BatchTask& task_;
    RealizationFeatures features_;
    std::vector<RealizationFeatures> additional_;  // of the additional sensors
};

// Result rows of single gearboxes, outside of an ensemble run.

// Rows of the given gearboxes, in their order, one record each, computed on the threads of this
// process. They have the bits of a run with these numerics.
BatchRows rows_of_gearboxes(const TilePlan& tile, const EnsemblePlan& ensemble,
                            std::span<const GearboxId> gearboxes);

// OpenMP team of one process that computes batches. Finished batches come out in arbitrary order.

struct FinishedBatch {
    std::size_t batch = 0;
    BatchRows rows;
    double seconds = 0.0;
    std::string failure;   // error message, or "" on success
    bool stopped = false;  // true if the batch was cancelled and has no rows
};
GEARPOD_FIELDS(FinishedBatch, batch, rows, seconds, failure, stopped)

// Times of the threads of one process, summed over the threads.
struct TeamTimes {
    Seconds work;
    double waiting = 0.0;  // everything except work: waiting for batches or for a processor
    double output = 0.0;   // time of rank 0's main thread for writing finished batches
    int threads = 0;
};

// Computes batches one after another on one thread and adds the times to the seconds. The result
// does not depend on batches computed earlier, to the last bit.
using BatchComputer = std::function<BatchRows(const Batch&, Seconds&)>;
// Creates the BatchComputer of a thread. Must be thread-safe.
using BatchComputers = std::function<BatchComputer()>;

// Runs the team in threads other than the caller's. The caller is free for messages and files, and
// the team uses all places of OMP_PLACES. Waiting threads do not use processor time.
class WorkerTeam {
  public:
    // Starts a team of `threads` threads, or as many as OpenMP grants.
    WorkerTeam(const BatchComputers& computers, const BatchPlan& plan, int threads);
    WorkerTeam(const WorkerTeam&) = delete;
    WorkerTeam& operator=(const WorkerTeam&) = delete;
    ~WorkerTeam();

    int threads() const { return times_.threads; }
    void give(std::size_t batch);
    // Takes back the batches that no thread has started, and returns their number.
    std::size_t drop();
    std::optional<FinishedBatch> take();
    // Waits until a batch is finished, at most for this time.
    void wait(std::chrono::milliseconds most);
    // Ends the team when its batches are finished.
    TeamTimes close();

  private:
    void set_thread_count(int threads);
    void work(const BatchComputers& computers, const BatchPlan& plan) noexcept;
    std::optional<std::size_t> next_batch();
    void submit_finished(FinishedBatch finished);

    std::mutex mutex_;
    std::condition_variable started_condition_, queue_condition_, finished_condition_;
    std::deque<std::size_t> given_;
    std::deque<FinishedBatch> finished_;
    bool closed_ = false;
    TeamTimes times_;
    std::thread first_;  // master thread of the OpenMP team
};

}  // namespace gearpod::mc
