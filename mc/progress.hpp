// Progress of a run on stderr: a bar on a terminal, plain lines with the time elsewhere.
#pragma once

#include <chrono>
#include <mutex>

namespace gearpod::mc {

class Progress {
  public:
    // Silent if `quiet`.
    Progress(long total, bool quiet);

    // `count` more gearboxes are done. Thread safe.
    void advance(long count);

    // Ends the bar's line.
    void finish();

  private:
    void show(std::chrono::steady_clock::time_point now);

    const long total_;
    const bool quiet_;
    const bool terminal_;
    const std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    std::mutex mutex_;
    long done_ = 0;
};

}  // namespace gearpod::mc
