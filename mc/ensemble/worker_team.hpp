// OpenMP team of one process that computes batches. Finished batches come out in arbitrary order.
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
    std::string failure;   // error message, or "" on success
    bool stopped = false;  // true if the batch was cancelled and has no rows
};

// Times of the threads of one process, summed over the threads.
struct TeamTimes {
    Seconds work;
    double waiting = 0.0;  // everything except work: waiting for batches or for a processor
    double output = 0.0;   // time of rank 0's main thread for writing finished batches
    int threads = 0;
};

// Computes batches one after another on one thread and adds the times to the seconds. The result
// does not depend on batches computed earlier, to the last bit.
using BatchComputer = std::function<BatchRows(const Batch&, Seconds&)>;
// Creates the BatchComputer of a thread. Must be thread-safe.
using BatchComputers = std::function<BatchComputer()>;

// Runs the team in threads other than the caller's. The caller is free for messages and files, and
// the team uses all places of OMP_PLACES. Waiting threads do not use processor time.
class WorkerTeam {
  public:
    // Starts a team of `threads` threads, or as many as OpenMP grants.
    WorkerTeam(const BatchComputers& computers, const BatchPlan& plan, int threads);
    WorkerTeam(const WorkerTeam&) = delete;
    WorkerTeam& operator=(const WorkerTeam&) = delete;
    ~WorkerTeam();

    int threads() const { return times_.threads; }
    void give(std::size_t batch);
    // Takes back the batches that no thread has started, and returns their number.
    std::size_t drop();
    std::optional<FinishedBatch> take();
    // Waits until a batch is finished, at most for this time.
    void wait(std::chrono::milliseconds most);
    // Ends the team when its batches are finished.
    TeamTimes close();

  private:
    void set_thread_count(int threads);
    void work(const BatchComputers& computers, const BatchPlan& plan) noexcept;
    std::optional<std::size_t> next_batch();
    void submit_finished(FinishedBatch finished);

    std::mutex mutex_;
    std::condition_variable started_condition_, queue_condition_, finished_condition_;
    std::deque<std::size_t> given_;
    std::deque<FinishedBatch> finished_;
    bool closed_ = false;
    TeamTimes times_;
    std::thread first_;  // master thread of the OpenMP team
};

}  // namespace gearpod::mc
