// Progress of a run on stderr: a bar on a terminal, plain lines with the date and time elsewhere;
// or JSON for programs, one object a line every five seconds and at the end:
//   {"done": how many, "of": all, "counted": "gearboxes" or what else, "seconds": since the start,
//    "per_second": how many, "left_s": forecast or null, "watched": text or null,
//    "finished": whether it is the last line}
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace gearpod::mc {

// One thread's.
class Progress {
  public:
    enum class Form { text, json };

    // Of `total` gearboxes, or what else is counted, `done` of which are there already. Silent if
    // `quiet`, JSON never is.
    Progress(long total, bool quiet, long done = 0, Form form = Form::text,
             const char* counted = "gearboxes");

    // `count` more of them are done.
    void advance(long count);
    // A detection rate to show, and how many more until it is known well enough.
    void watch(std::string rate, std::optional<std::size_t> left);

    // Ends the bar's line.
    void finish();

  private:
    void show(std::chrono::steady_clock::time_point now);
    void show_json(double elapsed, double rate, long left, bool finished) const;

    const long total_;
    const char* const counted_;
    const Form form_;
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
