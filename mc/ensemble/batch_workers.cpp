#include "mc/ensemble/batch_workers.hpp"

#include <algorithm>
#include <exception>

#include "machine/clocks.hpp"
#include "machine/no_value.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

Seconds& Seconds::operator+=(const Seconds& other) {
    const auto added = fields_of(other);
    for_each_field(
        *this, [&](auto field, auto& value) { value += std::get<decltype(field)::index>(added); });
    return *this;
}

BatchWorker::BatchWorker(const BatchTask& task) : task_(task), features_(task.tile, &task.healthy) {
    for (std::size_t s = 0; s < task.additional.size(); ++s) {
        additional_.emplace_back(task.tile, &task.additional[s], true, s + 1);
    }
}
BatchRows BatchWorker::compute(const Batch& batch, Seconds& seconds) {
    const NoiseSampling noise_sampling =
        batch.group == Group::threshold ? task_.tile.draw().rows.threshold_noise : task_.test_noise;
    std::vector<GearboxId> ids;
    for (std::size_t i = 0; i < batch.gearboxes; ++i) {
        ids.push_back({batch.group, batch.first_index + i, Record::test, 0, noise_sampling});
    }
    return compute(ids, batch.records, seconds);
}

BatchRows BatchWorker::compute(std::span<const GearboxId> ids, std::size_t records,
                               Seconds& seconds) {
    BatchRows rows;
    const auto lanes = static_cast<std::size_t>(task_.tile.solve->settings.numerics.lanes);
    while (!ids.empty()) {
        const std::size_t count = shared_records(task_.tile.record, ids, lanes);
        add_rows(ids.first(count), records, rows, seconds);
        ids = ids.subspan(count);
    }
    return rows;
}

// Adds the rows of at most as many gearboxes as there are lanes.
void BatchWorker::add_rows(std::span<const GearboxId> ids, std::size_t records, BatchRows& rows,
                           Seconds& seconds) {
    GearboxTile computed = run_gearboxes(
        task_.tile, ids, task_.tile.solve->settings.numerics.lanes,
        {.signal_meshes = features_.meshes(), .cache = &task_.cache, .repeats = records});
    const auto start = WallClock::now();
    const double noise_before = features_.noise_s();
    std::vector<LaneSignals> signals = all_lane_signals(task_.tile, computed, features_.meshes());
    computed.sensor_recorders.clear();  // frees memory: `signals` holds copies
    std::vector<LaneSignals> others;
    if (std::ranges::count(ids, Group::threshold, &GearboxId::group) > 0) {
        others = with_other_fault(task_.tile, std::span(computed.realizations).first(ids.size()),
                                  signals);
    }
    others.resize(ids.size());
    for (LaneId lane{0}; lane < ids.size(); ++lane) {
        machine::throw_if_cancelled();
        // freed when the rows of this gearbox are done
        const LaneSignals computed_signals = std::move(signals[lane]);
        const LaneSignals other = std::move(others[lane]);
        Realization& record = computed.realizations[lane];
        for (record.id.repeat = 0; record.id.repeat < records; ++record.id.repeat) {
            add_row(record, computed, lane, computed_signals, other, rows);
        }
    }
    const double spent_s = seconds_since(start);
    const double noise = features_.noise_s() - noise_before;
    seconds += {computed.sampling_s,
                computed.stiffness_s,
                computed.integration_s,
                computed.signals_s,
                noise,
                spent_s - noise,
                computed.meshes,
                computed.superposed,
                computed.superposition_fallbacks};
}

std::vector<double> BatchWorker::variants_of(const Realization& record, const LaneSignals& signals,
                                             const LaneSignals& other) {
    const EnsemblePlan& plan = task_.ensemble;
    std::vector<double> all;
    for (const VariantColumns& variant : plan.variants) {
        std::vector<double> values(plan.shape.features * plan.shape.levels, kNan);
        if (variant.sensor) {
            const SensorPlan& sensor = (*task_.tile.sensors)[*variant.sensor + 1];
            SensorSignals measured = signals_of_sensor(sensor, signals);
            values =
                additional_[*variant.sensor].compute(measured.linked(), sensor.realization(record));
        } else if (record.id.group == Group::threshold) {
            values = features_.compute(other, record);
        }
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

void BatchWorker::add_row(const Realization& record, const GearboxTile& computed, LaneId lane,
                          const LaneSignals& signals, const LaneSignals& other, BatchRows& rows) {
    const Status status = computed.status[lane];
    rows.status.push_back(static_cast<int>(status));

    const EnsemblePlan& plan = task_.ensemble;
    const RowShape& shape = plan.shape;
    std::vector<double> values(shape.features * shape.levels, kNan);
    std::vector<double> variants(shape.variants * values.size(), kNan);
    double noise_weight = 1.0;
    if (status == Status::ok) {
        values = features_.compute(signals, record);
        noise_weight = features_.noise_weight();
        variants = variants_of(record, signals, other);
    }
    plan.append_inputs(record.random_values, noise_weight, rows.values);
    rows.values.push_back(record.inputs.fault_size);
    rows.values.insert(rows.values.end(), values.begin(), values.end());
    std::vector<double> loss = contact_loss(computed, lane, shape.meshes);
    if (status != Status::ok) {
        std::ranges::fill(loss, kNan);
    }
    rows.values.insert(rows.values.end(), loss.begin(), loss.end());
    if (shape.integration > 0) {
        const std::vector<char>& superposed = computed.integration.superposed;
        rows.values.push_back(status != Status::ok                           ? kNan
                              : !superposed.empty() && superposed[lane] != 0 ? 1.0
                                                                             : 0.0);
    }
    rows.values.insert(rows.values.end(), variants.begin(), variants.end());
}

BatchRows rows_of_gearboxes(const TilePlan& tile, const EnsemblePlan& ensemble,
                            std::span<const GearboxId> gearboxes) {
    const BatchTask task(tile, ensemble);
    const std::size_t size = kBatchRows, batches = (gearboxes.size() + size - 1) / size;
    std::vector<BatchRows> parts(batches);
    machine::for_each_index(batches, thread_count(ensemble), [&](std::size_t batch) {
        Seconds seconds;
        const std::size_t first = batch * size;
        parts[batch] = BatchWorker(task).compute(
            gearboxes.subspan(first, std::min(size, gearboxes.size() - first)), 1, seconds);
    });
    BatchRows all;
    for (const BatchRows& part : parts) {
        all.status.insert(all.status.end(), part.status.begin(), part.status.end());
        all.values.insert(all.values.end(), part.values.begin(), part.values.end());
    }
    return all;
}

WorkerTeam::WorkerTeam(const BatchComputers& computers, const BatchPlan& plan, int threads)
    : first_([this, &computers, &plan, threads] {
          machine::run_team(threads, [&](int granted) {
              set_thread_count(granted);
              work(computers, plan);
          });
      }) {
    std::unique_lock lock(mutex_);
    started_condition_.wait(lock, [&] { return times_.threads > 0; });
}

WorkerTeam::~WorkerTeam() {
    drop();
    close();
}

void WorkerTeam::give(std::size_t batch) {
    {
        const std::lock_guard lock(mutex_);
        given_.push_back(batch);
    }
    queue_condition_.notify_one();
}

std::size_t WorkerTeam::drop() {
    const std::lock_guard lock(mutex_);
    const std::size_t count = given_.size();
    given_.clear();
    return count;
}

std::optional<FinishedBatch> WorkerTeam::take() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) {
        return std::nullopt;
    }
    FinishedBatch finished = std::move(finished_.front());
    finished_.pop_front();
    return finished;
}

void WorkerTeam::wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    finished_condition_.wait_for(lock, most, [&] { return !finished_.empty(); });
}

TeamTimes WorkerTeam::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    queue_condition_.notify_all();
    if (first_.joinable()) {
        first_.join();
    }
    return times_;
}

// Called by every thread of the team. Only the first call sets the number of threads, so all may
// read it later.
void WorkerTeam::set_thread_count(int threads) {
    const std::lock_guard lock(mutex_);
    if (times_.threads == 0) {
        times_.threads = threads;
        started_condition_.notify_one();
    }
}

std::optional<std::size_t> WorkerTeam::next_batch() {
    std::unique_lock lock(mutex_);
    queue_condition_.wait(lock, [&] { return closed_ || !given_.empty(); });
    if (given_.empty()) {
        return std::nullopt;
    }
    const std::size_t batch = given_.front();
    given_.pop_front();
    return batch;
}

void WorkerTeam::submit_finished(FinishedBatch finished) {
    {
        const std::lock_guard lock(mutex_);
        finished_.push_back(std::move(finished));
    }
    finished_condition_.notify_one();
}

// Work loop of one thread. Exceptions are caught here: otherwise the thread would end and its batch
// would be lost.
void WorkerTeam::work(const BatchComputers& computers, const BatchPlan& plan) noexcept {
    const auto thread_start = WallClock::now();
    BatchComputer compute;
    Seconds seconds;
    while (const auto batch = next_batch()) {
        FinishedBatch finished;
        finished.batch = *batch;
        const auto start = WallClock::now();
        try {
            if (!compute) {
                compute = computers();
            }
            finished.rows = compute(plan.batch(*batch), seconds);
        } catch (const machine::Cancelled&) {
            finished.stopped = true;
        } catch (const std::exception& error) {
            finished.failure = exception_text(error);
        }
        finished.seconds = seconds_since(start);
        submit_finished(std::move(finished));
    }
    const std::lock_guard lock(mutex_);
    times_.work += seconds;
    times_.waiting += std::max(0.0, seconds_since(thread_start) - seconds.sum());
}

}  // namespace gearpod::mc
