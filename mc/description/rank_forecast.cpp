#include "mc/description/rank_forecast.hpp"

#include <algorithm>
#include <array>

#include "mc/gearbox/mesh_time.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {
namespace {

// Size of the HDF5 file without its rows: names, attributes, the study's text, detection.
constexpr double kFrame_bytes = 45e3;

// Number of integrated tiles. Every rank caches only the solutions that it integrated itself.
IntegrationCounts integrations_of_ranks(const Scene& scene, const BatchPlan& plan,
                                        double motion_bytes, int ranks) {
    IntegrationCounts counts = count_integrations(scene, plan, motion_bytes);
    const auto lanes = static_cast<std::size_t>(scene.study().numerics.lanes);
    const std::array<std::size_t, 2> gearboxes{plan.threshold_gearboxes(), plan.graded_rows()};
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const std::size_t tiles = (gearboxes[g] + lanes - 1) / lanes;
        counts.integrated[g] =
            std::min(tiles, counts.integrated[g] * static_cast<std::size_t>(ranks));
    }
    return counts;
}

}  // namespace

double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each batch has a mark, a count and a checksum; each row has a status
    // (docs/reference/results-file.md).
    const double row = 8.0 * (1.0 + static_cast<double>(shape.values()));
    const auto healthy = static_cast<double>(plan.threshold_batches() * plan.threshold_records());
    const auto graded = static_cast<double>(plan.batches() - plan.threshold_batches());
    return 24.0 * static_cast<double>(plan.batches()) + kBatchRows * row * (healthy + graded);
}

double results_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each row also has a group and a status.
    return kFrame_bytes +
           static_cast<double>(plan.rows()) * 8.0 * (2.0 + static_cast<double>(shape.values()));
}

double leader_time_s(double batch_bytes) {
    constexpr double kBatch_s = 14e-6, kByte_s = 2.2e-9;
    return kBatch_s + kByte_s * batch_bytes;
}

RankForecast forecast_ranks(const Scene& scene, const BatchPlan& plan, const RunCost& calibration,
                            const AnalysisTrial& analysis, const RunForecast& alone, int ranks) {
    const auto lanes = static_cast<std::size_t>(scene.study().numerics.lanes);
    const double motion = motion_bytes(scene);
    const IntegrationCounts integrations = integrations_of_ranks(scene, plan, motion, ranks);
    const RowShape shape = row_shape(scene.study());
    const auto batches = static_cast<double>(plan.batches());

    RankForecast forecast;
    RunCost all = calibration;
    all.threads = static_cast<int>(
        std::min(static_cast<double>(calibration.threads) * ranks, std::max(1.0, batches)));
    forecast.busy_threads = all.threads;
    forecast.checkpoint_bytes = checkpoint_bytes(plan, shape);
    forecast.results_bytes = results_bytes(plan, shape);

    const double computing_s = gearboxes_s(all, plan, lanes, integrations);
    const double leading_s =
        batches * leader_time_s(forecast.checkpoint_bytes / std::max(1.0, batches));
    forecast.gearboxes_s = std::max(computing_s, leading_s);
    forecast.total_s = alone.setup_s + forecast.gearboxes_s + alone.detection_s;
    forecast.batches_per_s = batches / forecast.gearboxes_s;
    forecast.leader_share = leading_s / forecast.gearboxes_s;
    // Number of ranks that together finish a batch in the time that rank 0 needs to receive one.
    const double thread_s =
        gearboxes_s(calibration, plan, lanes, count_integrations(scene, plan, motion)) *
        calibration.threads;
    forecast.bounding_ranks = thread_s / leading_s / calibration.threads;
    forecast.rank_bytes = memory_bytes(calibration.memory, integrations, motion, 0.0);
    forecast.leader_bytes = memory_bytes(calibration.memory, integrations, motion, analysis.bytes);
    return forecast;
}

}  // namespace gearpod::mc
