// Progress of a run on stderr: a bar on a terminal, plain lines with date and time elsewhere. For
// programs there is JSON, one object per line, every five seconds and at the end:
//   {"done": number, "of": total number, "counted": "gearboxes" or other items,
//    "seconds": since the start, "per_second": number, "left_s": forecast, or null if there is
//    none, as while finished items are evaluated,
//    "finished": true in the last line of complete work}
#pragma once

#include <chrono>
#include <string>

namespace gearpod::mc {

// Shows the progress; to be used by one thread.
class Progress {
  public:
    enum class Form { text, json };

    // `total` is the number of gearboxes or other items (`counted`); `done` of them exist already.
    // `quiet` suppresses text, but not JSON.
    Progress(long total, bool quiet, long done = 0, Form form = Form::text,
             const char* counted = "gearboxes");

    // Reports that `count` more items are done.
    void advance(long count);

    // Ends the line of the progress bar. `complete`: nothing was interrupted.
    void finish(bool complete = true);

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
};

}  // namespace gearpod::mc
