#include "mc/numerics/forecast/run_cost.hpp"

#include <algorithm>
#include <future>
#include <mutex>
#include <numeric>
#include <optional>

#include "features/feature.hpp"
#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/forecast/memory.hpp"

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
    if (mesh_s * measured.integrated > std::max(kLongestTile_s, budget_s)) {
        result.integration_only = true;
        for (GroupCost& group : result.cost) {
            group.integrated.whole.integration = group.reused.whole.integration =
                mesh_s * all.integrated;
        }
        result.memory.peak = peak_memory_bytes();
        result.memory.held = resident_memory_bytes();
        result.memory.records = result.threads * result.motion_bytes;
    } else {
        measure(part, ensemble, batches, budget_s, result);
        result.memory.records = result.threads * (result.motion_bytes - motion_bytes(part));
        for (GroupCost& group : result.cost) {
            complete(group.integrated, measured, all);
            complete(group.reused, measured, all);
        }
    }
    result.integrations = count_integrations(*whole.sampler, solve, batches, result.motion_bytes);
    return result;
}

}  // namespace gearpod::mc
