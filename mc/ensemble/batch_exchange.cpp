#include "mc/ensemble/batch_exchange.hpp"

#include <algorithm>
#include <numeric>
#include <thread>
#include <utility>

#include "machine/wall_clock.hpp"
#include "mc/ensemble/batch_messages.hpp"

namespace gearpod::mc {
namespace {

// Interval at which a main thread polls for messages. Each poll takes a processor, and its caches,
// from a computing thread. The interval is therefore long while the threads have batches in
// reserve: a fraction of the time of one batch. A single process only polls for signals.
class Naps {
  public:
    explicit Naps(const Ranks& ranks) : alone_(ranks.size() == 1) {}
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

void say(const Ranks& ranks, int to, Say what, const std::vector<std::byte>& bytes = {}) {
    ranks.send(to, static_cast<int>(what), bytes);
}

class Leader {
  public:
    Leader(BatchCrew& crew, const BatchPlan& plan, const EnsembleRun& run)
        : crew_(crew),
          plan_(plan),
          run_(run),
          naps_(run.ranks),
          dealt_(static_cast<std::size_t>(run.ranks.size())) {
        for (const std::string& threads : run.ranks.gather(std::to_string(crew.threads()))) {
            threads_.push_back(static_cast<std::size_t>(std::stoul(threads)));
        }
        all_threads_ = std::accumulate(threads_.begin(), threads_.end(), std::size_t{0});
        outcome_.crews.resize(threads_.size());
    }

    EnsembleOutcome run() {
        const auto start = WallClock::now();
        last_sync_ = start;
        look();
        while (true) {
            deal();
            if (outstanding_ == 0) {
                break;
            }
            crew_.wait(naps_.next(batches_ahead()));
            receive();
            consider_stopping();
            checkpoint();
        }
        close();
        outcome_.crews[0].output = outcome_.output_s;
        outcome_.wall_s = seconds_since(start);
        outcome_.batches =
            run_.watch != nullptr && run_.watch->enough() ? run_.watch->batches() : first_missing();
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
        while (next_ < plan_.batches() && run_.store.has(next_)) {
            ++next_;
        }
        return next_ < plan_.batches();
    }

    void deal() {
        for (bool dealt = true; dealt && !stopping_;) {
            dealt = false;
            for (std::size_t rank = 0; rank < dealt_.size(); ++rank) {
                if (dealt_[rank] < share(rank) && next_missing()) {
                    give(rank, next_++);
                    dealt = true;
                }
            }
        }
    }

    void give(std::size_t rank, std::size_t batch) {
        ++dealt_[rank];
        ++outstanding_;
        if (rank == 0) {
            crew_.give(batch);
        } else {
            say(run_.ranks, static_cast<int>(rank), Say::compute, bytes_of_number(batch));
        }
    }

    void receive() {
        while (auto finished = crew_.take()) {
            accept(0, *finished);
        }
        while (auto message = run_.ranks.receive()) {
            const auto rank = static_cast<std::size_t>(message->from);
            switch (static_cast<Say>(message->kind)) {
                case Say::finished:
                    accept(rank, batch_of(message->bytes));
                    break;
                case Say::dropped:
                    settle(rank, number_of(message->bytes));
                    break;
                case Say::stop:
                    interrupt(text_of(message->bytes));
                    leave_off(Interruption::kGrace);
                    break;
                case Say::times:
                    outcome_.crews[rank] = times_of(message->bytes);
                    ++closed_;
                    break;
                case Say::compute:
                case Say::drop:
                case Say::leave:
                case Say::close:
                    break;  // only rank 0 sends these
            }
        }
    }

    void settle(std::size_t rank, std::size_t batches) {
        dealt_[rank] -= batches;
        outstanding_ -= batches;
    }

    void accept(std::size_t rank, const FinishedBatch& finished) {
        settle(rank, 1);
        if (finished.stopped) {
            interrupt(reason_now());
            return;
        }
        longest_batch_s_ = std::max(longest_batch_s_, finished.seconds);
        naps_.finished(finished);
        if (!finished.failure.empty()) {
            fail(finished.failure);
            return;
        }
        store([&] { run_.store.write(finished.batch, finished.rows); });
        look();
        run_.progress.advance(static_cast<long>(finished.rows.count()));
    }

    // Runs an action that writes. If writing fails, the run ends; earlier output is kept.
    template <class Action>
    void store(Action action) {
        if (unwritable_) {
            return;
        }
        const auto start = WallClock::now();
        try {
            action();
        } catch (const std::exception& error) {
            unwritable_ = true;
            fail(error.what());
        }
        outcome_.output_s += seconds_since(start);
    }

    void look() {
        if (run_.watch == nullptr || stopping_) {
            return;
        }
        store([&] { run_.watch->advance(run_.store); });
        run_.progress.watch(run_.watch->text(), run_.watch->rows_left());
        if (run_.watch->enough()) {
            stop();
        }
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
    void consider_stopping() {
        if (run_.interruption == nullptr) {
            return;
        }
        using Time = std::chrono::duration<double>;
        if (!stopping_) {
            // Time for saving and for a batch that takes a little longer than any so far.
            interrupt(run_.interruption->reason(Time(1.2 * longest_batch_s_ + saving_s_)));
        }
        if (stopping_ && !run_.interruption->reason(Time(saving_s_ + kSlack_s)).empty()) {
            leave_off(run_.interruption->signalled() ? Interruption::kGrace : Time(0.0));
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

    void leave_off(std::chrono::duration<double> grace) {
        if (std::exchange(leaving_, true)) {
            return;
        }
        run_.interruption->leave_off_in(grace);
        const auto milliseconds = static_cast<std::size_t>(1e3 * grace.count());
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            say(run_.ranks, rank, Say::leave, bytes_of_number(milliseconds));
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
        settle(0, crew_.drop());
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            say(run_.ranks, rank, Say::drop);
        }
    }

    void close() {
        for (int rank = 1; rank < run_.ranks.size(); ++rank) {
            say(run_.ranks, rank, Say::close);
        }
        outcome_.crews[0] = crew_.close();
        while (closed_ + 1 < run_.ranks.size()) {
            std::this_thread::sleep_for(naps_.next(false));
            receive();
        }
        store([&] { run_.store.sync(); });
    }

    std::size_t first_missing() const {
        std::size_t batch = 0;
        while (batch < plan_.batches() && run_.store.has(batch)) {
            ++batch;
        }
        return batch;
    }

    // Time in which cancelled batches end.
    static constexpr double kSlack_s = 0.2;

    BatchCrew& crew_;
    const BatchPlan plan_;
    const EnsembleRun& run_;
    Naps naps_;
    std::vector<std::size_t> dealt_, threads_;  // indexed by rank
    std::size_t all_threads_ = 0;
    std::size_t outstanding_ = 0;
    std::size_t next_ = 0;
    int closed_ = 0;
    bool stopping_ = false, leaving_ = false, unwritable_ = false;
    double longest_batch_s_ = 0.0, saving_s_ = 0.0;
    WallClock::time_point last_sync_;
    EnsembleOutcome outcome_;
};

class Follower {
  public:
    Follower(BatchCrew& crew, const EnsembleRun& run)
        : crew_(crew),
          run_(run),
          naps_(run.ranks),
          threads_(static_cast<std::size_t>(crew.threads())) {
        run.ranks.gather(std::to_string(crew.threads()));
    }

    void run() {
        while (!closed_) {
            crew_.wait(naps_.next(batches_ > threads_));
            while (auto finished = crew_.take()) {
                --batches_;
                naps_.finished(*finished);
                if (!finished->failure.empty()) {
                    finished->failure = rank_name(run_.ranks) + ": " + finished->failure;
                }
                say(run_.ranks, 0, Say::finished, bytes_of_batch(*finished));
            }
            pass_on_signal();
            receive();
        }
        say(run_.ranks, 0, Say::times, bytes_of_times(crew_.close()));
    }

  private:
    void pass_on_signal() {
        if (told_ || run_.interruption == nullptr) {
            return;
        }
        const std::string reason = run_.interruption->reason({});
        if (!reason.empty()) {
            told_ = true;
            say(run_.ranks, 0, Say::stop, bytes_of_text(reason));
        }
    }

    void receive() {
        while (auto message = run_.ranks.receive()) {
            switch (static_cast<Say>(message->kind)) {
                case Say::compute:
                    crew_.give(number_of(message->bytes));
                    ++batches_;
                    break;
                case Say::drop:
                    drop();
                    break;
                case Say::leave:
                    run_.interruption->leave_off_in(
                        std::chrono::milliseconds(number_of(message->bytes)));
                    break;
                case Say::close:
                    closed_ = true;
                    break;
                case Say::finished:
                case Say::dropped:
                case Say::stop:
                case Say::times:
                    break;  // only rank 0 receives these
            }
        }
    }

    void drop() {
        const std::size_t dropped = crew_.drop();
        batches_ -= dropped;
        say(run_.ranks, 0, Say::dropped, bytes_of_number(dropped));
    }

    BatchCrew& crew_;
    const EnsembleRun& run_;
    Naps naps_;
    const std::size_t threads_;
    std::size_t batches_ = 0;  // received and not yet sent back
    bool closed_ = false, told_ = false;
};

}  // namespace

EnsembleOutcome lead(BatchCrew& crew, const BatchPlan& plan, const EnsembleRun& run) {
    return Leader(crew, plan, run).run();
}

EnsembleOutcome follow(BatchCrew& crew, const EnsembleRun& run) {
    Follower(crew, run).run();
    return {};
}

}  // namespace gearpod::mc
