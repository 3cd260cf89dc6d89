// The OpenMP team of one process: batches go in, their rows come out in whatever order they finish.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mc/ensemble/batch_worker.hpp"

namespace gearpod::mc {

struct FinishedBatch {
    std::size_t batch = 0;
    BatchRows rows;
    double seconds = 0.0;
    std::string failure;   // what went wrong instead, "" if nothing
    bool stopped = false;  // it was left off before its end, and has no rows
};

// What the threads of one process did with their time, summed over them.
struct CrewTimes {
    Seconds work;
    double waiting = 0.0;  // all that is not work: for batches, for the processor
    double output = 0.0;   // the main thread's, which writes finished batches in rank 0
    int threads = 0;
};

// Computes batches one after another on one thread, the same bits whatever was computed before;
// adds its time to the seconds.
using BatchComputer = std::function<BatchRows(const Batch&, Seconds&)>;
// One for a thread that asks; threads ask at the same time.
using BatchComputers = std::function<BatchComputer()>;

// The thread that makes the crew is none of the team: it is free for messages and files, and the
// team has the places of OMP_PLACES for itself. Waiting costs no processor time.
class BatchCrew {
  public:
    // A team of so many threads, or as many of them as OpenMP grants.
    BatchCrew(const BatchComputers& computers, const BatchPlan& plan, int threads);
    BatchCrew(const BatchCrew&) = delete;
    BatchCrew& operator=(const BatchCrew&) = delete;
    ~BatchCrew();

    int threads() const { return times_.threads; }
    void give(std::size_t batch);
    // Takes back what was given and not yet begun; their number.
    std::size_t drop();
    std::optional<FinishedBatch> take();
    // Until a batch is finished, at most this long.
    void wait(std::chrono::milliseconds most);
    // Ends the team once its batches are finished.
    CrewTimes close();

  private:
    void note_size(int threads);
    void work(const BatchComputers& computers, const BatchPlan& plan) noexcept;
    std::optional<std::size_t> next_batch();
    void hand_in(FinishedBatch finished);

    std::mutex mutex_;
    std::condition_variable begun_news_, given_news_, finished_news_;
    std::deque<std::size_t> given_;
    std::deque<FinishedBatch> finished_;
    bool closed_ = false;
    CrewTimes times_;
    std::thread first_;  // of the team, which it opens
};

}  // namespace gearpod::mc
