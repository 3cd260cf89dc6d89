#include "mc/ensemble/worker_team.hpp"

#include <algorithm>
#include <exception>

#include "machine/cancellation.hpp"
#include "machine/team.hpp"
#include "machine/wall_clock.hpp"
#include "mc/input/exception_text.hpp"

namespace gearpod::mc {

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
