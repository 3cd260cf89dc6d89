// Progress of a run on stderr: a bar on a terminal, plain lines with the date and time elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace gearpod::mc {

// One thread's.
class Progress {
  public:
    // Of `total` gearboxes, `done` of which are there already. Silent if `quiet`.
    Progress(long total, bool quiet, long done = 0);

    // `count` more gearboxes are done.
    void advance(long count);
    // A detection rate to show, and how many gearboxes until it is known well enough.
    void watch(std::string rate, std::optional<std::size_t> left);

    // Ends the bar's line.
    void finish();

  private:
    void show(std::chrono::steady_clock::time_point now);

    const long total_;
    const bool quiet_;
    const bool terminal_;
    const std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    const long before_;
    long done_ = 0;
    std::string rate_;
    std::optional<std::size_t> wanted_;
};

}  // namespace gearpod::mc
