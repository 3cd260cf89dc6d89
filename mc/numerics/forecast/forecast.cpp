#include "mc/numerics/forecast/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "machine/clocks.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

// Peak memory of the assessment in bytes per value (gearbox, feature and noise level): at first
// while thresholds are set, which holds up to 64 MB of values at once, later for the columns of all
// values and of the pairs in work. Measured with 0.2, 2.6, 4 and 40 million values.
constexpr double kFirstBytesOfValue = 40.0, kBytesOfValue = 22.0, kBytesBeyond = 70e6;

// Memory in bytes per record while the rates of a feature are counted at one noise level, and per
// value of its columns (result_rows.hpp), which grow by doubling.
constexpr double kBytesOfRecord = 60.0, kBytesOfColumns = 16.0;

// Analysed are as many measured gearboxes as have this number of values, but at least so many.
constexpr std::size_t kMostAnalysedValues = 100'000, kFewestAnalysed = 200;

// Number of gearboxes, on which areas and curves are based, independent of the number of records.
std::size_t gearboxes_of(const BatchPlan& plan) {
    return plan.threshold_gearboxes() + plan.test_rows();
}

std::size_t values_of(const RowShape& shape, const BatchPlan& plan) {
    return gearboxes_of(plan) * shape.features * shape.levels;
}

}  // namespace

double assessment_bytes(const RowShape& shape, const BatchPlan& plan) {
    const auto assessed = [](std::size_t count) {
        const auto values = static_cast<double>(count);
        return std::min(kFirstBytesOfValue * values, kBytesBeyond + kBytesOfValue * values);
    };
    const double gearboxes = assessed(std::min(values_of(shape, plan), kMostAssessedValues));
    if (plan.threshold_records() == 1) {
        return gearboxes;
    }
    // With several records per gearbox, all records count if they fit into memory.
    const std::size_t of_feature = plan.rows() * shape.levels;
    const std::size_t all = of_feature * shape.features;
    if (all <= kMostAssessedValues) {
        return assessed(all);
    }
    const double at_once = std::max(64e6 / 8.0, static_cast<double>(of_feature));
    return std::max(gearboxes,
                    kBytesOfColumns * at_once + kBytesOfRecord * static_cast<double>(plan.rows()));
}

void MeasuredRows::visit(const std::function<void(const RowBlock&)>& use) const {
    use(block_);
}

MeasuredRows::MeasuredRows(const RunCost& cost, std::size_t most) {
    const std::size_t values =
        cost.rows.count() == 0 ? 0 : cost.rows.values.size() / cost.rows.count();
    for (std::size_t row = 0; row < cost.gearboxes.size() && block_.count() < most; ++row) {
        if (cost.gearboxes[row].repeat == 0) {
            block_.group.push_back(static_cast<int>(cost.gearboxes[row].group));
            block_.status.push_back(cost.rows.status[row]);
            const auto first = cost.rows.values.begin() + static_cast<std::ptrdiff_t>(row * values);
            block_.values.insert(block_.values.end(), first,
                                 first + static_cast<std::ptrdiff_t>(values));
        }
    }
}

AnalysisCost measure_analysis(const EnsemblePlan& ensemble, const RunCost& measured,
                              const BatchPlan& plan, int threads) {
    AnalysisCost cost;
    const RowShape& shape = ensemble.shape;
    cost.bytes = assessment_bytes(shape, plan);
    const MeasuredRows rows(
        measured,
        std::max(kFewestAnalysed,
                 kMostAnalysedValues / std::max<std::size_t>(1, shape.features * shape.levels)));
    if (rows.rows() == 0) {
        return cost;
    }
    const auto start = WallClock::now();
    Results results = results_frame(ensemble);
    results.request.threshold_records = 1;
    results.detection = detect_all(results, rows);
    if (values_of(shape, plan) <= kMostAssessedValues) {
        reliability_of(results, rows, "", threads);
    }
    cost.measured_s = seconds_since(start);
    cost.total_s = cost.measured_s * static_cast<double>(gearboxes_of(plan)) /
                   static_cast<double>(rows.rows());
    return cost;
}

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

Seconds all_work(const RunCost& calibration, const BatchPlan& plan) {
    auto tiles = tiles_of(calibration, calibration.integrations);
    Seconds work;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        const Batch batch = plan.batch(b);
        for_each_tile(batch, calibration.lanes, tiles[static_cast<std::size_t>(batch.group)],
                      [&](const TileCost& cost, std::size_t rows) {
                          work += cost.whole;
                          work.noise += static_cast<double>(rows) * cost.row.noise;
                          work.features += static_cast<double>(rows) * cost.row.features;
                      });
    }
    return work;
}

}  // namespace

double gearboxes_s(const RunCost& calibration, const BatchPlan& plan,
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
            batch, calibration.lanes, tiles[static_cast<std::size_t>(batch.group)],
            [&](const TileCost& cost, std::size_t rows) { seconds += cost.seconds(rows); });
        const double done = free.top() + seconds;
        free.pop();
        free.push(done);
        last = std::max(last, done);
    }
    return last;
}

double verification_s(const Planner& planner, const RunCost& cost) {
    const auto start = WallClock::now();
    const SolverFacts& facts = planner.facts();
    const auto finer = facts.verified ? finer_setting(planner, facts.numerics) : std::nullopt;
    if (!finer) {
        return 0.0;
    }
    const TilePlan fine = planner.tile(finer->numerics);
    const double setup_s = seconds_since(start);
    const TileCost& tile = cost.cost[static_cast<std::size_t>(Group::test)].integrated;
    const double integration_s =
        mesh_period_s(fine.draw(), *fine.gearbox, *fine.solve, fine.record) *
        fine.solve->integrated_meshes;
    const std::int64_t pairs = facts.numerics.paired_gearboxes;
    const auto batches = static_cast<double>((2 * pairs + kBatchRows - 1) / kBatchRows);
    const double tiles =
        pairs > 0 ? std::ceil(batches / cost.threads) * kBatchRows / static_cast<double>(cost.lanes)
                  : 1.0;
    return setup_s +
           tiles * (2.0 * tile.seconds(cost.lanes) - tile.whole.integration + integration_s);
}

double memory_bytes(const MemoryUse& memory, const IntegrationCounts& integrations,
                    double motion_bytes, double analysis_bytes) {
    const double kept =
        std::max(0.0, memory.kept + static_cast<double>(integrations.kept) * motion_bytes);
    const double held = memory.before + (1.0 - kReused) * (memory.held - memory.before);
    return memory.fragments +
           std::max(memory.peak + memory.records + kept, held + analysis_bytes + kFileBytes);
}

double least_memory_bytes(double motion_bytes, const RowShape& shape, const BatchPlan& plan,
                          int threads) {
    const auto teams = std::min(static_cast<std::size_t>(threads), plan.batches());
    return std::max(static_cast<double>(teams) * motion_bytes, assessment_bytes(shape, plan));
}

RunForecast forecast_run(const RunCost& cost, const BatchPlan& plan, const AnalysisCost& analysis,
                         double verification_s, double setup_s) {
    RunForecast forecast;
    forecast.setup_s = setup_s + cost.task_s + kFiles_s;
    forecast.gearboxes_s = gearboxes_s(cost, plan, cost.integrations);
    forecast.work = all_work(cost, plan);
    forecast.detection_s = analysis.total_s + verification_s;
    forecast.memory_bytes =
        memory_bytes(cost.memory, cost.integrations, cost.motion_bytes, analysis.bytes);
    return forecast;
}

}  // namespace gearpod::mc
