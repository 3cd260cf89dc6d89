// The threads of one process: tiles go in, their rows come out in whatever order they finish.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mc/ensemble/tile_worker.hpp"

namespace gearpod::mc {

struct FinishedTile {
    std::size_t tile = 0;
    TileRows rows;
    double seconds = 0.0;
    std::string failure;  // what went wrong instead, "" if nothing
};

// What the threads of one process did with their time, summed over them.
struct CrewTimes {
    Seconds work;
    double waiting = 0.0;  // all that is not work: for tiles, for the processor
    double output = 0.0;   // the main thread's, which writes finished tiles in rank 0
    int threads = 0;
};

class TileCrew {
  public:
    TileCrew(const TileTask& task, const TilePlan& plan, int threads);
    TileCrew(const TileCrew&) = delete;
    TileCrew& operator=(const TileCrew&) = delete;
    ~TileCrew();

    int threads() const { return static_cast<int>(threads_.size()); }
    void give(std::size_t tile);
    // Takes back what was given and not yet begun; their number.
    std::size_t drop();
    std::optional<FinishedTile> take();
    // Until a tile is finished, at most this long.
    void wait(std::chrono::milliseconds most);
    // Ends the threads once their tiles are finished.
    CrewTimes close();

  private:
    void work(const TileTask& task, const TilePlan& plan);
    std::optional<std::size_t> next_tile();
    void hand_in(FinishedTile finished);

    std::mutex mutex_;
    std::condition_variable given_news_, finished_news_;
    std::deque<std::size_t> given_;
    std::deque<FinishedTile> finished_;
    bool closed_ = false;
    CrewTimes times_;
    std::vector<std::thread> threads_;
};

}  // namespace gearpod::mc
