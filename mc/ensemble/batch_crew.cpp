#include "mc/ensemble/batch_crew.hpp"

#include <algorithm>
#include <exception>

#include "machine/stop.hpp"
#include "machine/team.hpp"
#include "machine/wall_clock.hpp"
#include "mc/input/exception_text.hpp"

namespace gearpod::mc {

BatchCrew::BatchCrew(const BatchComputers& computers, const BatchPlan& plan, int threads)
    : first_([this, &computers, &plan, threads] {
          machine::run_team(threads, [&](int granted) {
              note_size(granted);
              work(computers, plan);
          });
      }) {
    std::unique_lock lock(mutex_);
    begun_news_.wait(lock, [&] { return times_.threads > 0; });
}

BatchCrew::~BatchCrew() {
    drop();
    close();
}

void BatchCrew::give(std::size_t batch) {
    {
        const std::lock_guard lock(mutex_);
        given_.push_back(batch);
    }
    given_news_.notify_one();
}

std::size_t BatchCrew::drop() {
    const std::lock_guard lock(mutex_);
    const std::size_t count = given_.size();
    given_.clear();
    return count;
}

std::optional<FinishedBatch> BatchCrew::take() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) {
        return std::nullopt;
    }
    FinishedBatch finished = std::move(finished_.front());
    finished_.pop_front();
    return finished;
}

void BatchCrew::wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    finished_news_.wait_for(lock, most, [&] { return !finished_.empty(); });
}

CrewTimes BatchCrew::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    given_news_.notify_all();
    if (first_.joinable()) {
        first_.join();
    }
    return times_;
}

// Called by every thread of the team. Only the first call sets the number of threads, so all may
// read it later.
void BatchCrew::note_size(int threads) {
    const std::lock_guard lock(mutex_);
    if (times_.threads == 0) {
        times_.threads = threads;
        begun_news_.notify_one();
    }
}

std::optional<std::size_t> BatchCrew::next_batch() {
    std::unique_lock lock(mutex_);
    given_news_.wait(lock, [&] { return closed_ || !given_.empty(); });
    if (given_.empty()) {
        return std::nullopt;
    }
    const std::size_t batch = given_.front();
    given_.pop_front();
    return batch;
}

void BatchCrew::hand_in(FinishedBatch finished) {
    {
        const std::lock_guard lock(mutex_);
        finished_.push_back(std::move(finished));
    }
    finished_news_.notify_one();
}

// Work loop of one thread. Exceptions are caught here: otherwise the thread would end and its batch
// would be lost.
void BatchCrew::work(const BatchComputers& computers, const BatchPlan& plan) noexcept {
    const auto birth = WallClock::now();
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
        } catch (const machine::Stopped&) {
            finished.stopped = true;
        } catch (const std::exception& error) {
            finished.failure = exception_text(error);
        }
        finished.seconds = seconds_since(start);
        hand_in(std::move(finished));
    }
    const std::lock_guard lock(mutex_);
    times_.work += seconds;
    times_.waiting += std::max(0.0, seconds_since(birth) - seconds.sum());
}

}  // namespace gearpod::mc
