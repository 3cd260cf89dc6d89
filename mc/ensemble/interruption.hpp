// External requests to stop: signals and the time limit.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "machine/team.hpp"

namespace gearpod::mc {

// Handles SIGINT, SIGTERM and a batch queue's warnings (SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP unless it
// is ignored) during its lifetime: the first signal asks the run to end and save. A second SIGINT
// or SIGTERM ends the program at once, unless it follows the first within kSameRequest. `timeout`
// and batch queues send a signal to a program and then to its process group. Computations are
// cancelled (CancellationSource) kGrace after the first signal, or at the time limit. SIGXFSZ is
// ignored, so that writing beyond a limit on the file size is a write error. An object within the
// lifetime of another knows the signals that came before it.
class Interruption final : public machine::CancellationSource {
  public:
    // Time for computations that are about to finish when a signal arrives. Open MPI kills
    // processes one second after SIGTERM to `mpirun`, and the rest of it is for saving.
    static constexpr std::chrono::milliseconds kGrace{250};
    // Further signals within this time after the first count as the same request.
    static constexpr std::chrono::milliseconds kSameRequest{500};

    // The time limit counts from now; empty means no limit.
    explicit Interruption(std::optional<std::chrono::seconds> limit);
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption() override;

    // Reason to stop, or "". `ahead`: time needed for finishing and saving.
    std::string reason(std::chrono::duration<double> ahead) const;

    bool signalled() const;

    // Cancels computations after `grace`, or earlier if that was decided before.
    void cancel_in(std::chrono::duration<double> grace) const;
    // Disables cancellation: the remaining computations are needed for saving.
    void disable_cancellation() const;
    bool stop() const override;

  private:
    std::optional<std::chrono::seconds> limit_;
    std::chrono::steady_clock::time_point start_;
    mutable std::atomic<std::chrono::steady_clock::time_point> end_;  // end of computation
    mutable std::atomic<bool> finishing_{false};
};

// Parses "hh:mm:ss", with any number of digits for the hours; empty if the text is invalid.
std::optional<std::chrono::seconds> parse_time_limit(const std::string& text);

}  // namespace gearpod::mc
