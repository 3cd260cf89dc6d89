#include "mc/ensemble/tile_crew.hpp"

#include <algorithm>
#include <exception>

#include "machine/wall_clock.hpp"

namespace gearpod::mc {
TileCrew::TileCrew(const TileTask& task, const TilePlan& plan, int threads) {
    for (int i = 0; i < threads; ++i) {
        threads_.emplace_back([this, &task, plan] { work(task, plan); });
    }
}

TileCrew::~TileCrew() {
    drop();
    close();
}

void TileCrew::give(std::size_t tile) {
    {
        const std::lock_guard lock(mutex_);
        given_.push_back(tile);
    }
    given_news_.notify_one();
}

std::size_t TileCrew::drop() {
    const std::lock_guard lock(mutex_);
    const std::size_t count = given_.size();
    given_.clear();
    return count;
}

std::optional<FinishedTile> TileCrew::take() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) {
        return std::nullopt;
    }
    FinishedTile finished = std::move(finished_.front());
    finished_.pop_front();
    return finished;
}

void TileCrew::wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    finished_news_.wait_for(lock, most, [&] { return !finished_.empty(); });
}

CrewTimes TileCrew::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    given_news_.notify_all();
    times_.threads = threads();
    for (std::thread& thread : threads_) {
        if (thread.joinable()) {
            thread.join();
        }
    }
    return times_;
}

std::optional<std::size_t> TileCrew::next_tile() {
    std::unique_lock lock(mutex_);
    given_news_.wait(lock, [&] { return closed_ || !given_.empty(); });
    if (given_.empty()) {
        return std::nullopt;
    }
    const std::size_t tile = given_.front();
    given_.pop_front();
    return tile;
}

void TileCrew::hand_in(FinishedTile finished) {
    {
        const std::lock_guard lock(mutex_);
        finished_.push_back(std::move(finished));
    }
    finished_news_.notify_one();
}

// A thread's life. Nothing may leave it by an exception.
void TileCrew::work(const TileTask& task, const TilePlan& plan) {
    const auto birth = WallClock::now();
    std::optional<TileWorker> worker;
    Seconds seconds;
    while (const auto tile = next_tile()) {
        FinishedTile finished;
        finished.tile = *tile;
        const auto start = WallClock::now();
        try {
            if (!worker) {
                worker.emplace(task);
            }
            finished.rows = worker->compute(plan.tile(*tile), seconds);
        } catch (const std::exception& error) {
            finished.failure = error.what();
        }
        finished.seconds = seconds_since(start);
        hand_in(std::move(finished));
    }
    const std::lock_guard lock(mutex_);
    times_.work += seconds;
    times_.waiting += std::max(0.0, seconds_since(birth) - seconds.sum());
}

}  // namespace gearpod::mc
