#include "mc/progress.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>

namespace gearpod::mc {
namespace {

using namespace std::chrono_literals;

std::string duration_text(double seconds) {
    const long s = static_cast<long>(seconds + 0.5);
    return s < 60 ? fmt::format("{} s", s) : fmt::format("{} min {:02} s", s / 60, s % 60);
}

}  // namespace

Progress::Progress(long total, bool quiet)
    : total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {}

void Progress::advance(long count) {
    const std::lock_guard lock(mutex_);
    done_ += count;
    const auto now = std::chrono::steady_clock::now();
    const auto interval = terminal_ ? 200ms : 5000ms;
    if (!quiet_ && (now - shown_ >= interval || (terminal_ && done_ == total_))) {
        shown_ = now;
        show(now);
    }
}

void Progress::show(std::chrono::steady_clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double rate = static_cast<double>(done_) / elapsed;
    const double left = static_cast<double>(total_ - done_) / rate;
    const double share = static_cast<double>(done_) / static_cast<double>(total_);
    const std::string numbers = fmt::format("{} of {} gearboxes, {:.0f} a second, {} left", done_,
                                            total_, rate, duration_text(left));
    if (terminal_) {
        constexpr int kWidth = 30;
        const int filled = static_cast<int>(share * kWidth);
        fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}   ", "", filled, "", kWidth - filled, numbers);
    } else {
        fmt::print(stderr, "{:%H:%M:%S} {}\n", fmt::localtime(std::time(nullptr)), numbers);
    }
    std::fflush(stderr);
}

void Progress::finish() {
    if (!quiet_ && terminal_) {
        fmt::print(stderr, "\n");
    }
}

}  // namespace gearpod::mc
