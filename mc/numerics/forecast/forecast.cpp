#include "mc/numerics/forecast/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <mutex>
#include <numeric>
#include <optional>
#include <queue>
#include <vector>

#include "features/feature.hpp"
#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/assumption_rows.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {

namespace {

std::size_t index_of(Group group) {
    return static_cast<std::size_t>(group);
}

constexpr std::size_t kTriedRecords = 4;  // per gearbox; further records cost as much

// Free blocks between used ones after many tiles: bytes per thread, and share of the memory of two
// tiles per thread, or of fewer. Measured for tiles that take 10 to 2,000 MB
// (tests/bench/prediction.py --settings).
constexpr double kFragmentsOfThread = 2.5e6, kFragmentShare = 0.05, kShareAfterFew = 0.12;

// Enumerates all tiles of a plan without storing them. The first ones come from each group; the
// order spreads every leading subset over the ensemble.
class SpreadTiles {
  public:
    SpreadTiles(const BatchPlan& plan, std::size_t lanes)
        : plan_(plan),
          lanes_(lanes),
          healthy_(tiles(plan.threshold_gearboxes())),
          all_(healthy_ + tiles(plan.test_rows())),
          // Close to the golden section of the number of tiles, and coprime to it.
          stride_(std::max<std::size_t>(1, all_ / 1000 * 618 + all_ % 1000 * 618 / 1000)) {
        while (std::gcd(stride_, all_) != 1) {
            ++stride_;
        }
    }

    std::optional<Batch> next() {
        if (given_ == all_) {
            return std::nullopt;
        }
        ++given_;
        const bool both = healthy_ > 0 && healthy_ < all_;
        if (both && given_ == 2) {
            return tile(healthy_);
        }
        const std::size_t index = advance();
        return tile(both && index == healthy_ ? advance() : index);
    }

  private:
    std::size_t advance() {
        const std::size_t index = next_;
        next_ = (next_ + stride_) % all_;
        return index;
    }

    // Full batches consist of whole tiles; only the last batch of a group may be incomplete.
    std::size_t tiles(std::size_t rows) const {
        return rows / kBatchRows * ((kBatchRows + lanes_ - 1) / lanes_) +
               (rows % kBatchRows + lanes_ - 1) / lanes_;
    }

    Batch tile(std::size_t index) const {
        const std::size_t each = (kBatchRows + lanes_ - 1) / lanes_;
        const bool healthy = index < healthy_;
        const std::size_t of_group = healthy ? index : index - healthy_;
        const std::size_t before = healthy ? 0 : plan_.threshold_batches();
        const Batch batch = plan_.batch(before + of_group / each);
        const std::size_t first = of_group % each * lanes_;
        return {batch.group, batch.first_index + first, batch.first_row + first * batch.records,
                std::min(lanes_, batch.gearboxes - first), std::min(batch.records, kTriedRecords)};
    }

    const BatchPlan plan_;
    const std::size_t lanes_, healthy_, all_;
    std::size_t stride_, next_ = 0, given_ = 0;
};

struct MeasuredTile {
    Batch tile = {};
    BatchRows rows = {};
    Seconds work = {};
    double wall_s = 0.0;
    bool first = false;     // first tile of its thread
    bool reused = false;    // its motion came from the cache
    bool repeated = false;  // repetition with the same gearboxes
};

// Measures tiles on several threads. Its members are common to all threads.
class CostMeasurement {
  public:
    CostMeasurement(BatchComputers computers, const SpreadTiles& tiles, bool reusable,
                    double budget_s)
        : computers_(std::move(computers)),
          tiles_(tiles),
          reusable_(reusable),
          budget_s_(budget_s) {}

    std::vector<MeasuredTile> run(int threads) {
        start_ = WallClock::now();
        // A team of another thread than the first, as in a run: memory of the first thread is
        // managed differently and has fewer free blocks.
        std::async(std::launch::async, [&] {
            machine::run_team(threads, [&](int granted) { work(granted); });
        }).get();
        return std::move(measured_);
    }

    int threads() const { return threads_; }
    // Peak memory of the process after the first tile.
    double peak_alone() const { return peak_alone_; }
    // The same after one tile of each thread and another. Later tiles alternate between the groups,
    // unlike in a run, and leave more free blocks.
    double early_peak() const { return early_peak_; }
    bool few_tiles() const { return measured_tiles_ < 2 * threads_; }

  private:
    // `used_s`: processor time of the thread so far.
    std::optional<Batch> next(int had, double used_s) {
        const std::scoped_lock lock(mutex_);
        const bool more =
            had == 0 || seconds_since(start_) < budget_s_ || (had == 1 && used_s < 2.0 * budget_s_);
        return more ? tiles_.next() : std::nullopt;
    }

    void work(int threads) {
        int had = 0;
        {
            const std::scoped_lock lock(mutex_);
            threads_ = threads;
        }
        BatchComputer computer;
        const double processor_start_s = thread_processor_s();
        const auto compute_next = [&] {
            auto start = WallClock::now();
            if (!computer) {
                computer = computers_();
            }
            const std::optional<Batch> tile = next(had, thread_processor_s() - processor_start_s);
            if (tile) {
                compute(computer, {.tile = *tile, .first = had++ == 0}, start);
                if (reusable_) {
                    compute(computer, {.tile = *tile, .repeated = true}, WallClock::now());
                }
            }
            return tile.has_value();
        };
        // The other threads wait for the first tile, so that its memory is that of one thread.
        std::call_once(alone_, [&] {
            compute_next();
            peak_alone_ = peak_memory_bytes();
            start_ = WallClock::now();
        });
        while (compute_next()) {
        }
    }

    void compute(const BatchComputer& computer, MeasuredTile measured,
                 WallClock::time_point start) {
        measured.rows = computer(measured.tile, measured.work);
        measured.wall_s = seconds_since(start);
        measured.reused = measured.work.meshes == 0;
        const std::scoped_lock lock(mutex_);
        if (!measured.repeated && ++measured_tiles_ <= threads_ + 1) {
            early_peak_ = peak_memory_bytes();
        }
        measured_.push_back(std::move(measured));
    }

    const BatchComputers computers_;
    SpreadTiles tiles_;
    const bool reusable_;
    const double budget_s_;
    WallClock::time_point start_;
    std::mutex mutex_;
    std::once_flag alone_;
    double peak_alone_ = 0.0, early_peak_ = 0.0;
    int threads_ = 0, measured_tiles_ = 0;
    std::vector<MeasuredTile> measured_;
};

// Mean cost of tiles of one kind.
class Mean {
  public:
    void add(const MeasuredTile& tile) {
        work_ += tile.work;
        rest_ += tile.wall_s - tile.work.sum();
        rows_ += tile.tile.rows();
        ++tiles_;
    }
    bool empty() const { return tiles_ == 0; }
    TileCost cost() const {
        const double n = tiles_, rows = static_cast<double>(rows_);
        TileCost cost;
        cost.whole = {work_.sampling / n, work_.stiffness / n, work_.integration / n,
                      work_.signals / n};
        cost.row.noise = work_.noise / rows;
        cost.row.features = work_.features / rows;
        cost.whole.meshes = work_.meshes / tiles_;
        cost.rest = rest_ / n;
        return cost;
    }

  private:
    Seconds work_;
    double rest_ = 0.0;
    std::size_t rows_ = 0;
    int tiles_ = 0;
};

// Mean cost of a group's tiles. First tiles of threads count only if there are no others.
TileCost cost_of(const std::vector<MeasuredTile>& all, Group group, bool reused,
                 const TileCost& otherwise) {
    for (const bool first : {false, true}) {
        Mean mean;
        for (const MeasuredTile& tile : all) {
            if (tile.tile.group == group && tile.reused == reused && tile.first == first) {
                mean.add(tile);
            }
        }
        if (!mean.empty()) {
            return mean.cost();
        }
    }
    return otherwise;
}

double start_of_thread(const std::vector<MeasuredTile>& all, const std::array<GroupCost, 2>& cost) {
    double sum = 0.0;
    int threads = 0;
    for (const MeasuredTile& tile : all) {
        const GroupCost& group = cost[index_of(tile.tile.group)];
        if (tile.first) {
            sum += tile.wall_s -
                   (tile.reused ? group.reused : group.integrated).seconds(tile.tile.rows());
            ++threads;
        }
    }
    return threads == 0 ? 0.0 : std::max(0.0, sum / threads);
}

// Mesh periods that a tile records and integrates.
struct TileMeshes {
    int recorded;
    double integrated;
};

// Converts the cost of a tile that recorded the mesh periods of `measured` to that of all mesh
// periods of `whole`. Test and baseline records scale alike.
void complete(TileCost& cost, const TileMeshes& measured, const TileMeshes& whole) {
    if (measured.recorded == whole.recorded) {
        return;
    }
    const bool integrated = cost.whole.meshes > 0;  // otherwise copied from the cache
    cost.whole.integration *= integrated ? whole.integrated / measured.integrated
                                         : static_cast<double>(whole.recorded) / measured.recorded;
}

// Number of mesh periods that a tile may record within the budget if every one is integrated.
int affordable_meshes(const TileMeshes& whole, double mesh_s, double budget_s) {
    const double before = whole.integrated - whole.recorded;
    const double affordable = budget_s / mesh_s - before;
    return affordable >= whole.recorded
               ? whole.recorded
               : std::min(whole.recorded, std::max(kFewestMeshes, static_cast<int>(affordable)));
}

void measure(const TilePlan& plan, const EnsemblePlan& ensemble, const BatchPlan& batches,
             double budget_s, RunCost& result) {
    auto start = WallClock::now();
    const BatchTask task(plan, ensemble);
    result.task_s = seconds_since(start);
    const bool reusable = plan.solve->settings.distinct_integrations.has_value();
    const auto computers = [&task]() -> BatchComputer {
        return
            [worker = std::make_shared<BatchWorker>(task)](const Batch& batch, Seconds& seconds) {
                return worker->compute(batch, seconds);
            };
    };
    start = WallClock::now();
    CostMeasurement measurement(computers, SpreadTiles(batches, result.lanes), reusable, budget_s);
    const std::vector<MeasuredTile> all = measurement.run(result.threads);
    result.threads = measurement.threads();
    result.wall_s = seconds_since(start);
    // In a run all threads reach the peak of a tile together at some time.
    const double of_thread = measurement.peak_alone() - result.memory.before;
    result.memory.peak =
        std::max(measurement.early_peak(), result.memory.before + result.threads * of_thread);
    result.memory.held = resident_memory_bytes();
    result.memory.fragments = kFragmentsOfThread * result.threads +
                              (measurement.few_tiles() ? kShareAfterFew : kFragmentShare) *
                                  (result.memory.peak - result.memory.before);
    result.memory.kept = -motion_bytes(plan) * static_cast<double>(task.cache.kept());

    std::array<GroupCost, 2>& cost = result.cost;
    for (const Group group : {Group::threshold, Group::test}) {
        const Group other = group == Group::test ? Group::threshold : Group::test;
        const TileCost alike = cost_of(all, other, false, {});
        cost[index_of(group)].integrated = cost_of(all, group, false, alike);
        cost[index_of(group)].reused = cost_of(all, group, true, cost[index_of(group)].integrated);
    }
    result.start_s = start_of_thread(all, cost);
    for (const MeasuredTile& tile : all) {
        result.meshes += tile.work.meshes;
        if (tile.repeated) {
            continue;
        }
        for (std::size_t i = 0; i < tile.tile.rows(); ++i) {
            result.gearboxes.push_back({tile.tile.group,
                                        tile.tile.first_index + i / tile.tile.records, Record::test,
                                        i % tile.tile.records});
        }
        result.rows.status.insert(result.rows.status.end(), tile.rows.status.begin(),
                                  tile.rows.status.end());
        result.rows.values.insert(result.rows.values.end(), tile.rows.values.begin(),
                                  tile.rows.values.end());
    }
}

}  // namespace

RunCost measure_run_cost(const TilePlan& whole, const EnsemblePlan& ensemble,
                         const BatchPlan& batches, int threads, double budget_s) {
    RunCost result;
    result.threads = static_cast<int>(
        std::min(static_cast<std::size_t>(std::max(1, threads)), batches.batches()));
    result.lanes = static_cast<std::size_t>(ensemble.lanes);
    const SolvePlan& solve = *whole.solve;
    const double mesh_s = solve.settings.quasi_static
                              ? 0.0
                              : mesh_period_s(whole.draw(), *whole.gearbox, solve, whole.record);
    const TileMeshes all{solve.test_record_meshes, solve.integrated_meshes};
    result.to_record = all.recorded;
    // Half of the budget, so that a thread can compute two tiles.
    result.recorded = solve.settings.numerics.horizon == Horizon::periodic || mesh_s == 0.0
                          ? all.recorded
                          : affordable_meshes(all, mesh_s, 0.5 * budget_s);
    result.motion_bytes = motion_bytes(whole);
    const TilePlan part = whole.recording_at_most(result.recorded);
    const TileMeshes measured{part.solve->test_record_meshes, part.solve->integrated_meshes};
    result.memory.before = peak_memory_bytes();
    measure(part, ensemble, batches, budget_s, result);
    result.memory.records = result.threads * (result.motion_bytes - motion_bytes(part));
    for (GroupCost& group : result.cost) {
        complete(group.integrated, measured, all);
        complete(group.reused, measured, all);
    }
    result.integrations = count_integrations(*whole.sampler, solve, batches, result.motion_bytes);
    return result;
}

namespace {

// Peak memory of the assessment in bytes per value (gearbox, feature and noise level): at first
// while thresholds are set, which holds up to 64 MB of values at once, later for the columns of all
// values and of the pairs in work. Measured with 0.2, 2.6, 4 and 40 million values.
constexpr double kFirstBytesOfValue = 40.0, kBytesOfValue = 22.0, kBytesBeyond = 70e6;

// Memory in bytes per record while the rates of a feature are counted at one noise level, and per
// value of its columns (result_rows.hpp), which grow by doubling.
constexpr double kBytesOfRecord = 60.0, kBytesOfColumns = 16.0;

// Processor seconds for thresholds, rates, areas and POD: start, and each value. Measured with
// 4,200 to 192,500 values, and with 40 million (docs/validation/performance.md).
constexpr double kAnalysis_s = 0.3, kValue_s = 9e-6;

// Number of gearboxes, on which areas and curves are based, independent of the number of records.
std::size_t gearboxes_of(const BatchPlan& plan) {
    return plan.threshold_gearboxes() + plan.test_rows();
}

std::size_t values_of(const RowShape& shape, const BatchPlan& plan) {
    return gearboxes_of(plan) * shape.features * shape.levels;
}

}  // namespace

double analysis_s(const RowShape& shape, const BatchPlan& plan, int threads) {
    return kAnalysis_s + kValue_s * static_cast<double>(values_of(shape, plan)) / threads;
}

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

double assumptions_s(const Planner& planner, const RunCost& cost) {
    const auto [variants, pairs] = assumption_pairs(planner);
    const double batches = std::ceil(2.0 * pairs / kBatchRows / cost.threads);
    return static_cast<double>(variants.size()) * batches * kBatchRows /
           static_cast<double>(cost.lanes) *
           cost.cost[static_cast<std::size_t>(Group::test)].integrated.seconds(cost.lanes);
}

double verification_s(const Planner& planner, const RunCost& cost, bool chosen) {
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
    if (pairs > 0 && chosen && cost.threads > 1) {
        return 0.0;
    }
    const auto batches =
        static_cast<double>(((chosen ? 1 : 2) * pairs + kBatchRows - 1) / kBatchRows);
    const double tiles =
        pairs > 0 ? std::ceil(batches / cost.threads) * kBatchRows / static_cast<double>(cost.lanes)
                  : 1.0;
    return setup_s + tiles * (tile.seconds(cost.lanes) - tile.whole.integration + integration_s);
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

RunForecast forecast_run(const RunCost& cost, const RowShape& shape, const BatchPlan& plan,
                         double verification_s, double setup_s) {
    RunForecast forecast;
    forecast.setup_s = setup_s + cost.task_s + kFiles_s;
    forecast.gearboxes_s = gearboxes_s(cost, plan, cost.integrations);
    forecast.work = all_work(cost, plan);
    forecast.detection_s = analysis_s(shape, plan, cost.threads) + verification_s;
    forecast.memory_bytes = memory_bytes(cost.memory, cost.integrations, cost.motion_bytes,
                                         assessment_bytes(shape, plan));
    return forecast;
}

}  // namespace gearpod::mc
