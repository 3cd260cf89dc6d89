// Requests to stop from outside: signals and the time limit.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "machine/stop.hpp"

namespace gearpod::mc {

// While it lives, SIGINT, SIGTERM and SIGUSR1 (a queue's warning) only ask the run to end and save;
// a second SIGINT or SIGTERM ends the program at once, but for one that comes with the first:
// `timeout` and batch queues signal a program and then its process group. Whatever is computed
// leaves off (StopWish) a second after the first signal, or when the time limit is over. Writing
// beyond a limit on the file size is an error of the write and no signal. One object at a time.
class Interruption final : public machine::StopWish {
  public:
    // For what is about to be finished when a signal comes.
    static constexpr std::chrono::seconds kGrace{1};
    // Signals that come so soon after the first are one request with it.
    static constexpr std::chrono::milliseconds kSameRequest{500};

    // The limit counts from now; none if empty.
    explicit Interruption(std::optional<std::chrono::seconds> limit);
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption() override;

    // Why to stop, or "". `ahead`: what finishing and saving is going to take.
    std::string reason(std::chrono::duration<double> ahead) const;

    // Whether the reason is a signal.
    bool signalled() const;

    // Computing leaves off so much later, or when it would anyway.
    void leave_off_in(std::chrono::duration<double> grace) const;
    // From now on computing does not leave off: what is left is needed for saving.
    void let_finish() const;
    bool stop() const override;

  private:
    std::optional<std::chrono::seconds> limit_;
    std::chrono::steady_clock::time_point start_;
    mutable std::atomic<std::chrono::steady_clock::time_point> end_;  // of computing
    mutable std::atomic<bool> finishing_{false};
};

// "hh:mm:ss" (hours may have more digits); empty if it is not one.
std::optional<std::chrono::seconds> parse_time_limit(const std::string& text);

}  // namespace gearpod::mc
