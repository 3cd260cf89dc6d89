#include "mc/ensemble/ensemble.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/messages.hpp"

namespace gearpod::mc {
namespace {

// Interval at which a main thread polls for messages. Each poll takes a processor, and its caches,
// from a computing thread. The interval is therefore long while the threads have batches in
// reserve: a fraction of the time of one batch. A single process only polls for signals.
class PollInterval {
  public:
    explicit PollInterval(const Ranks& ranks) : alone_(ranks.size() == 1) {}
    void finished(const FinishedBatch& batch) {
        shortest_s_ = std::min(shortest_s_, batch.seconds);
    }
    std::chrono::milliseconds next(bool batches_ahead) const {
        if (alone_) {
            return kLongest;
        }
        return batches_ahead ? std::clamp(milliseconds(0.25 * shortest_s_), kShortest, kLongest)
                             : kShortest;
    }

  private:
    static constexpr std::chrono::milliseconds kShortest{1}, kLongest{50};
    static std::chrono::milliseconds milliseconds(double seconds) {
        return std::chrono::milliseconds(static_cast<long>(1e3 * seconds));
    }

    const bool alone_;
    double shortest_s_ = 1.0;
};

// First batch from `batch` on that the store lacks.
std::size_t first_missing(const RowStore& store, const BatchPlan& plan, std::size_t batch = 0) {
    while (batch < plan.batches() && store.has(batch)) {
        ++batch;
    }
    return batch;
}

class Leader {
  public:
    Leader(WorkerTeam& team, const BatchPlan& plan, const EnsembleRun& run)
        : team_(team),
          plan_(plan),
          run_(run),
          poll_interval_(run.ranks),
          assigned_(static_cast<std::size_t>(run.ranks.size())) {
        for (const std::string& threads : run.ranks.gather(std::to_string(team.threads()))) {
            threads_.push_back(static_cast<std::size_t>(std::stoul(threads)));
        }
        all_threads_ = std::accumulate(threads_.begin(), threads_.end(), std::size_t{0});
        outcome_.teams.resize(threads_.size());
    }

    EnsembleOutcome run() {
        const auto start = WallClock::now();
        last_sync_ = start;
        while (true) {
            assign_batches();
            if (outstanding_ == 0) {
                break;
            }
            team_.wait(poll_interval_.next(batches_ahead()));
            receive();
            check_stop_conditions();
            checkpoint();
        }
        close();
        outcome_.teams[0].output = outcome_.output_s;
        outcome_.wall_s = seconds_since(start);
        outcome_.batches = first_missing(run_.store, plan_);
        return std::move(outcome_);
    }

  private:
    // Number of batches that a rank should hold: one per thread and one in reserve, so that no
    // thread waits for a message. Near the end there is no reserve, because a batch queued at one
    // rank would leave another idle.
    std::size_t share(std::size_t rank) const {
        return batches_ahead() ? 2 * threads_[rank] : threads_[rank];
    }
    bool batches_ahead() const { return plan_.batches() - next_ > 4 * all_threads_; }

    bool next_missing() {
        next_ = first_missing(run_.store, plan_, next_);
        return next_ < plan_.batches();
    }

    void assign_batches() {
        for (bool assigned = true; assigned && !stopping_;) {
            assigned = false;
            for (std::size_t rank = 0; rank < assigned_.size(); ++rank) {
                if (assigned_[rank] < share(rank) && next_missing()) {
                    give(rank, next_++);
                    assigned = true;
                }
            }
        }
    }

    void give(std::size_t rank, std::size_t batch) {
        ++assigned_[rank];
        ++outstanding_;
        if (rank == 0) {
            team_.give(batch);
        } else {
            send(run_.ranks, static_cast<int>(rank), MessageKind::compute, bytes_of(batch));
        }
    }

    void receive() {
        while (auto finished = team_.take()) {
            accept(0, *finished);
        }
        while (auto message = run_.ranks.receive()) {
            const auto rank = static_cast<std::size_t>(message->from);
            switch (static_cast<MessageKind>(message->kind)) {
                case MessageKind::finished:
                    accept(rank, value_of<FinishedBatch>(message->bytes));
                    break;
                case MessageKind::dropped:
                    mark_returned(rank, value_of<std::size_t>(message->bytes));
                    break;
                case MessageKind::stop:
                    interrupt(value_of<std::string>(message->bytes));
                    cancel_running(Interruption::kGrace);
                    break;
                case MessageKind::times:
                    outcome_.teams[rank] = value_of<TeamTimes>(message->bytes);
                    ++closed_;
                    break;
                case MessageKind::compute:
                case MessageKind::drop:
                case MessageKind::cancel:
                case MessageKind::close:
                case MessageKind::assessed:
                    break;  // rank 0 sends these; "assessed" follows all batches
            }
        }
    }

    void mark_returned(std::size_t rank, std::size_t batches) {
        assigned_[rank] -= batches;
        outstanding_ -= batches;
    }

    void accept(std::size_t rank, const FinishedBatch& finished) {
        mark_returned(rank, 1);
        if (finished.stopped) {
            interrupt(reason_now());
            return;
        }
        longest_batch_s_ = std::max(longest_batch_s_, finished.seconds);
        poll_interval_.finished(finished);
        if (!finished.failure.empty()) {
            fail(finished.failure);
            return;
        }
        store([&] { run_.store.write(finished.batch, finished.rows); });
        run_.progress.advance(static_cast<long>(finished.rows.count()));
    }

    // Runs an action that writes. If writing fails, the run ends; earlier output is kept.
    template <class Action>
    void store(Action action) {
        if (write_failed_) {
            return;
        }
        const auto start = WallClock::now();
        try {
            action();
        } catch (const std::exception& error) {
            write_failed_ = true;
            fail(error.what());
        }
        outcome_.output_s += seconds_since(start);
    }

    void checkpoint() {
        if (seconds_since(last_sync_) < run_.checkpoint_s) {
            return;
        }
        const auto start = WallClock::now();
        store([&] {
            run_.store.sync();
            run_.checkpointed();
        });
        last_sync_ = WallClock::now();
        saving_s_ = seconds_since(start);
    }

    // Starts no batch that may not finish in time. Cancels running batches when the remaining time
    // is needed for saving.
    void check_stop_conditions() {
        if (run_.interruption == nullptr) {
            return;
        }
        using Time = std::chrono::duration<double>;
        if (!stopping_) {
            // Time for saving and for a batch that takes a little longer than any so far.
            interrupt(run_.interruption->reason(Time(1.2 * longest_batch_s_ + saving_s_)));
        }
        if (stopping_ && !run_.interruption->reason(Time(saving_s_ + kSlack_s)).empty()) {
            cancel_running(run_.interruption->signalled() ? Interruption::kGrace : Time(0.0));
        }
    }

    // Reason for the interruption. Falls back to the time limit if only another rank, whose clock
    // is ahead, has noticed it.
    std::string reason_now() const {
        const std::string reason =
            run_.interruption == nullptr ? "" : run_.interruption->reason({});
        return reason.empty() ? "the time limit" : reason;
    }

    void interrupt(const std::string& reason) {
        if (!reason.empty() && !stopping_) {
            outcome_.interruption = reason;
            stop();
        }
    }

    void cancel_running(std::chrono::duration<double> grace) {
        if (std::exchange(cancelling_, true)) {
            return;
        }
        run_.interruption->cancel_in(grace);
        const auto milliseconds = static_cast<std::size_t>(1e3 * grace.count());
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            send(run_.ranks, rank, MessageKind::cancel, bytes_of(milliseconds));
        }
    }

    void fail(const std::string& what) {
        if (outcome_.failure.empty()) {
            outcome_.failure = what;
        }
        stop();
    }

    void stop() {
        if (std::exchange(stopping_, true)) {
            return;
        }
        mark_returned(0, team_.drop());
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            send(run_.ranks, rank, MessageKind::drop);
        }
    }

    void close() {
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            send(run_.ranks, rank, MessageKind::close);
        }
        outcome_.teams[0] = team_.close();
        while (closed_ + 1 < run_.ranks.size()) {
            std::this_thread::sleep_for(poll_interval_.next(false));
            receive();
        }
        store([&] { run_.store.sync(); });
    }

    // Time in which cancelled batches end.
    static constexpr double kSlack_s = 0.2;

    WorkerTeam& team_;
    const BatchPlan plan_;
    const EnsembleRun& run_;
    PollInterval poll_interval_;
    std::vector<std::size_t> assigned_, threads_;  // indexed by rank
    std::size_t all_threads_ = 0;
    std::size_t outstanding_ = 0;
    std::size_t next_ = 0;
    int closed_ = 0;
    bool stopping_ = false, cancelling_ = false, write_failed_ = false;
    double longest_batch_s_ = 0.0, saving_s_ = 0.0;
    WallClock::time_point last_sync_;
    EnsembleOutcome outcome_;
};

class Follower {
  public:
    Follower(WorkerTeam& team, const EnsembleRun& run)
        : team_(team),
          run_(run),
          poll_interval_(run.ranks),
          threads_(static_cast<std::size_t>(team.threads())) {
        run.ranks.gather(std::to_string(team.threads()));
    }

    void run() {
        while (!closed_) {
            team_.wait(poll_interval_.next(batches_ > threads_));
            while (auto finished = team_.take()) {
                --batches_;
                poll_interval_.finished(*finished);
                if (!finished->failure.empty()) {
                    finished->failure = rank_name(run_.ranks) + ": " + finished->failure;
                }
                send(run_.ranks, 0, MessageKind::finished, bytes_of(*finished));
            }
            report_signal();
            receive();
        }
        send(run_.ranks, 0, MessageKind::times, bytes_of(team_.close()));
    }

  private:
    void report_signal() {
        if (signal_reported_ || run_.interruption == nullptr) {
            return;
        }
        const std::string reason = run_.interruption->reason({});
        if (!reason.empty()) {
            signal_reported_ = true;
            send(run_.ranks, 0, MessageKind::stop, bytes_of(reason));
        }
    }

    void receive() {
        while (auto message = run_.ranks.receive()) {
            switch (static_cast<MessageKind>(message->kind)) {
                case MessageKind::compute:
                    team_.give(value_of<std::size_t>(message->bytes));
                    ++batches_;
                    break;
                case MessageKind::drop:
                    drop();
                    break;
                case MessageKind::cancel:
                    run_.interruption->cancel_in(
                        std::chrono::milliseconds(value_of<std::size_t>(message->bytes)));
                    break;
                case MessageKind::close:
                    closed_ = true;
                    break;
                case MessageKind::finished:
                case MessageKind::dropped:
                case MessageKind::stop:
                case MessageKind::times:
                case MessageKind::assessed:
                    break;  // only rank 0 receives these
            }
        }
    }

    void drop() {
        const std::size_t dropped = team_.drop();
        batches_ -= dropped;
        send(run_.ranks, 0, MessageKind::dropped, bytes_of(dropped));
    }

    WorkerTeam& team_;
    const EnsembleRun& run_;
    PollInterval poll_interval_;
    const std::size_t threads_;
    std::size_t batches_ = 0;  // received and not yet sent back
    bool closed_ = false, signal_reported_ = false;
};

// Prepares this rank for its batches. Returns the reason if preparation was interrupted, else "".
std::string prepare(const std::function<BatchComputers()>& make, const EnsembleRun& run,
                    BatchComputers& computers) {
    try {
        computers = make();
    } catch (const machine::Cancelled&) {
        const std::string reason = run.interruption == nullptr ? "" : run.interruption->reason({});
        return reason.empty() ? "the time limit" : reason;
    }
    return "";
}

}  // namespace

EnsembleOutcome run_batches(const EnsemblePlan& ensemble, const BatchPlan& plan,
                            const EnsembleRun& run, const std::function<BatchComputers()>& make) {
    BatchComputers computers;
    for (const std::string& reason : run.ranks.gather(prepare(make, run, computers))) {
        if (!reason.empty()) {
            EnsembleOutcome outcome;
            outcome.interruption = reason;
            outcome.batches = run.ranks.leads() ? first_missing(run.store, plan) : 0;
            return outcome;
        }
    }
    const auto threads = std::min<std::size_t>(
        static_cast<std::size_t>(thread_count(ensemble, run.ranks.on_this_machine())),
        plan.batches());
    WorkerTeam team(computers, plan, std::max(1, static_cast<int>(threads)));
    if (run.ranks.leads()) {
        return Leader(team, plan, run).run();
    }
    Follower(team, run).run();
    return {};
}

EnsembleOutcome run_batches(const TilePlan& tile, const EnsemblePlan& ensemble,
                            const BatchPlan& plan, const EnsembleRun& run) {
    return run_batches(ensemble, plan, run, [&]() -> BatchComputers {
        const auto task = std::make_shared<const BatchTask>(tile, ensemble);
        return [task]() -> BatchComputer {
            const auto worker = std::make_shared<BatchWorker>(*task);
            return [task, worker](const Batch& batch, Seconds& seconds) {
                return worker->compute(batch, seconds);
            };
        };
    });
}

Results run_ensemble(const TilePlan& tile, const EnsemblePlan& ensemble, Progress& progress) {
    const BatchPlan plan = ensemble.batches();
    MemoryRows store(plan.batches());
    const Ranks alone;
    const EnsembleOutcome outcome =
        run_batches(tile, ensemble, plan, {.ranks = alone, .store = store, .progress = progress});
    if (!outcome.failure.empty()) {
        throw std::runtime_error(outcome.failure);
    }
    Results results = results_frame(ensemble);
    fill_columns(results, StoredRows(store, plan, outcome.batches));
    results.timing = timing_of(outcome);
    return results;
}

std::vector<analysis::FeatureDetection> detect_all(const Results& results) {
    return detect_all(results, ColumnRows(results));
}

std::vector<Timing> timing_of(const EnsembleOutcome& outcome) {
    const Seconds work = outcome.work();
    double waiting = 0.0;
    for (const TeamTimes& team : outcome.teams) {
        waiting += team.waiting;
    }
    std::vector<Timing> all;
    for_each_field(work, [&](auto field, auto value) {
        if (decltype(field)::written) {
            all.push_back({std::string(field.name) + "_thread_s", static_cast<double>(value)});
        }
    });
    all.push_back({"waiting_thread_s", waiting});
    all.push_back({"ensemble_s", outcome.wall_s});
    if (work.superposed + work.superposition_fallbacks > 0) {
        all.push_back({"superposed_records", static_cast<double>(work.superposed), "1"});
        all.push_back({"superposition_fallback_records",
                       static_cast<double>(work.superposition_fallbacks), "1"});
    }
    return all;
}

}  // namespace gearpod::mc
