#include "mc/forecast/forecast.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <vector>

#include "machine/wall_clock.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/numerics/numerical_error.hpp"

namespace gearpod::mc {
namespace {

// Costs of a run that `describe` does not have: writing a checkpoint and a results file, and the
// HDF5 library. Measured for runs of two gearboxes; syncing to a slow disk takes longer.
constexpr double kFiles_s = 0.01, kFileBytes = 4.5e6;

// Share of the memory of the gearboxes that the analysis reuses. The rest lies between used blocks.
constexpr double kReused = 0.5;

// Costs of the tiles of a group in order: first those to integrate, then those found in the cache.
class Tiles {
  public:
    Tiles(const GroupCost& cost, std::size_t integrated)
        : cost_(cost), integrations_left_(integrated) {}

    const TileCost& next() {
        if (integrations_left_ == 0) {
            return cost_.reused;
        }
        --integrations_left_;
        return cost_.integrated;
    }

  private:
    const GroupCost& cost_;
    std::size_t integrations_left_;
};

// Calls visit(cost, rows) for the tiles of a batch.
template <class Visit>
void for_each_tile(const Batch& batch, std::size_t lanes, Tiles& tiles, Visit visit) {
    for (std::size_t first = 0; first < batch.gearboxes; first += lanes) {
        visit(tiles.next(), std::min(lanes, batch.gearboxes - first) * batch.records);
    }
}

std::array<Tiles, 2> tiles_of(const RunCost& calibration, const IntegrationCounts& integrations) {
    return {Tiles(calibration.cost[0], integrations.integrated[0]),
            Tiles(calibration.cost[1], integrations.integrated[1])};
}

Seconds all_work(const RunCost& calibration, const BatchPlan& plan, std::size_t lanes,
                 const IntegrationCounts& integrations) {
    auto tiles = tiles_of(calibration, integrations);
    Seconds work;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        const Batch batch = plan.batch(b);
        for_each_tile(batch, lanes, tiles[static_cast<std::size_t>(batch.group)],
                      [&](const TileCost& cost, std::size_t rows) {
                          work += cost.whole;
                          work.noise += static_cast<double>(rows) * cost.row.noise;
                          work.features += static_cast<double>(rows) * cost.row.features;
                      });
    }
    return work;
}

}  // namespace

double gearboxes_s(const RunCost& calibration, const BatchPlan& plan, std::size_t lanes,
                   const IntegrationCounts& integrations) {
    auto tiles = tiles_of(calibration, integrations);
    // Times at which the threads become free; the earliest is on top.
    std::priority_queue<double, std::vector<double>, std::greater<>> free(
        {},
        std::vector<double>(static_cast<std::size_t>(calibration.threads), calibration.start_s));
    double last = calibration.start_s;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        const Batch batch = plan.batch(b);
        double seconds = 0.0;
        for_each_tile(
            batch, lanes, tiles[static_cast<std::size_t>(batch.group)],
            [&](const TileCost& cost, std::size_t rows) { seconds += cost.seconds(rows); });
        const double done = free.top() + seconds;
        free.pop();
        free.push(done);
        last = std::max(last, done);
    }
    return last;
}

double verification_s(const Scene& scene, const RunCost& calibration) {
    const auto start = WallClock::now();
    const FinerScene finer = finer_scene(scene);
    if (!finer.scene) {
        return 0.0;
    }
    const double setup_s = seconds_since(start);
    const TileCost& own = calibration.cost[static_cast<std::size_t>(Group::graded)].integrated;
    const auto lanes = static_cast<std::size_t>(scene.study().numerics.lanes);
    const double integration_s = mesh_period_s(*finer.scene) * integrated_meshes(*finer.scene);
    const std::int64_t pairs = scene.study().numerics.paired_gearboxes;
    const auto batches = static_cast<double>((2 * pairs + kBatchRows - 1) / kBatchRows);
    const double tiles = pairs > 0 ? std::ceil(batches / calibration.threads) * kBatchRows /
                                         static_cast<double>(lanes)
                                   : 1.0;
    return setup_s + tiles * (2.0 * own.seconds(lanes) - own.whole.integration + integration_s);
}

double memory_bytes(const MemoryUse& memory, const IntegrationCounts& integrations,
                    double motion_bytes, double analysis_bytes) {
    const double kept =
        std::max(0.0, memory.kept + static_cast<double>(integrations.kept) * motion_bytes);
    const double held = memory.before + (1.0 - kReused) * (memory.held - memory.before);
    return memory.fragments +
           std::max(memory.peak + memory.records + kept, held + analysis_bytes + kFileBytes);
}

double least_memory_bytes(const Scene& scene, const BatchPlan& plan, int threads) {
    const auto teams = std::min(static_cast<std::size_t>(threads), plan.batches());
    return std::max(static_cast<double>(teams) * motion_bytes(scene),
                    assessment_bytes(scene.study(), plan));
}

RunForecast forecast_run(const Scene& scene, const BatchPlan& plan, const RunCost& calibration,
                         const AnalysisTrial& analysis, double setup_s) {
    const auto lanes = static_cast<std::size_t>(scene.study().numerics.lanes);
    const double motion = motion_bytes(scene);
    const IntegrationCounts integrations = count_integrations(scene, plan, motion);
    RunForecast forecast;
    forecast.setup_s = setup_s + calibration.task_s + kFiles_s;
    forecast.gearboxes_s = gearboxes_s(calibration, plan, lanes, integrations);
    forecast.work = all_work(calibration, plan, lanes, integrations);
    forecast.detection_s = analysis.total_s + verification_s(scene, calibration);
    forecast.memory_bytes = memory_bytes(calibration.memory, integrations, motion, analysis.bytes);
    return forecast;
}

}  // namespace gearpod::mc
