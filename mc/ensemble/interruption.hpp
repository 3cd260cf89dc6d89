// Requests to stop from outside: signals and the time limit.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace gearpod::mc {

// While it lives, SIGINT, SIGTERM and SIGUSR1 (a queue's warning) only ask the run to finish its
// batches and save; a second SIGINT or SIGTERM ends the program at once. Writing beyond a limit on
// the file size is an error of the write and no signal. One object at a time.
class Interruption {
  public:
    // The limit counts from now; none if empty.
    explicit Interruption(std::optional<std::chrono::seconds> limit);
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption();

    // Why to stop, or "". `ahead`: what finishing and saving is going to take.
    std::string reason(std::chrono::duration<double> ahead) const;

  private:
    std::optional<std::chrono::seconds> limit_;
    std::chrono::steady_clock::time_point start_;
};

// "hh:mm:ss" (hours may have more digits); empty if it is not one.
std::optional<std::chrono::seconds> parse_time_limit(const std::string& text);

}  // namespace gearpod::mc
