#include "mc/ensemble/progress.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

namespace gearpod::mc {
namespace {

using namespace std::chrono_literals;

std::string duration_text(double seconds) {
    const long s = static_cast<long>(seconds + 0.5);
    return s < 60     ? fmt::format("{} s", s)
           : s < 3600 ? fmt::format("{} min {:02} s", s / 60, s % 60)
                      : fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

// Time that the items left will take. What follows them is not counted.
std::string left_text(long left, double rate) {
    return left == 0 ? "evaluation follows"
                     : duration_text(std::max(1.0, static_cast<double>(left) / rate)) + " left";
}

}  // namespace

Progress::Progress(long total, bool quiet, long done, Form form, const char* counted)
    : total_(total),
      counted_(counted),
      form_(form),
      quiet_(quiet && form == Form::text),
      terminal_(form == Form::text && isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      shown_(start_),
      before_(done),
      done_(done) {}

void Progress::advance(long count) {
    done_ += count;
    const auto now = std::chrono::steady_clock::now();
    const auto interval = terminal_ ? 200ms : 5000ms;
    const bool ends = done_ == total_ && (terminal_ || shown_ != start_);
    if (!quiet_ && (now - shown_ >= interval || ends)) {
        shown_ = now;
        show(now);
    }
}

void Progress::show(std::chrono::steady_clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double rate = static_cast<double>(done_ - before_) / elapsed;
    const long left = total_ - done_;
    if (form_ == Form::json) {
        return show_json(elapsed, rate, left, false);
    }
    const double share = static_cast<double>(done_) / static_cast<double>(total_);
    const std::string numbers =
        fmt::format("{} of {} {}, {} per second, {}", done_, total_, counted_,
                    rate < 10.0 ? fmt::format("{:.2g}", rate) : fmt::format("{:.0f}", rate),
                    left_text(left, rate));
    if (terminal_) {
        constexpr int kWidth = 20;
        const int filled = static_cast<int>(share * kWidth);
        fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}\033[K", "", filled, "", kWidth - filled, numbers);
    } else {
        fmt::print(stderr, "{:%Y-%m-%d %H:%M:%S} {}\n", fmt::localtime(std::time(nullptr)),
                   numbers);
    }
    std::fflush(stderr);
}

void Progress::show_json(double elapsed, double rate, long left, bool finished) const {
    const nlohmann::json line{{"done", done_},
                              {"of", total_},
                              {"counted", counted_},
                              {"seconds", elapsed},
                              {"per_second", rate},
                              {"left_s", rate > 0.0 && (left > 0 || finished)
                                             ? nlohmann::json(static_cast<double>(left) / rate)
                                             : nullptr},
                              {"finished", finished}};
    fmt::print(stderr, "{}\n", line.dump());
    std::fflush(stderr);
}

void Progress::finish(bool complete) {
    if (form_ == Form::json) {
        const double elapsed =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        show_json(elapsed, static_cast<double>(done_ - before_) / std::max(1e-9, elapsed),
                  complete ? 0 : total_ - done_, complete);
    }
    if (!quiet_ && terminal_) {
        fmt::print(stderr, "\n");
    }
}

}  // namespace gearpod::mc
