#include "mc/ensemble/interruption.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <csignal>
#include <ctime>

#include "machine/stop_signals.hpp"

namespace gearpod::mc {
namespace {

volatile std::sig_atomic_t caught = 0;
int objects = 0;  // that exist
// Time of the first signal on the steady clock, in nanoseconds. Signal handlers may only write
// lock-free atomics.
std::atomic<long long> caught_ns{0};
static_assert(std::atomic<long long>::is_always_lock_free);
constexpr std::chrono::nanoseconds kSameRequest = Interruption::kSameRequest;

long long steady_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

extern "C" void note_signal(int number) {
    const bool again = caught != 0 && steady_ns() - caught_ns >= kSameRequest.count();
    if (again && (number == SIGINT || number == SIGTERM)) {
        std::signal(number, SIG_DFL);
        std::raise(number);
        return;
    }
    if (caught == 0) {
        caught_ns = steady_ns();
    }
    caught = number;
}

// Leaves SIGHUP ignored, as `nohup` has it.
void handle(int number, void (*handler)(int)) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    if (number == SIGHUP && action.sa_handler == SIG_IGN) {
        return;
    }
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
}

}  // namespace

Interruption::Interruption(std::optional<std::chrono::seconds> limit)
    : limit_(limit),
      start_(std::chrono::steady_clock::now()),
      end_(limit ? start_ + *limit : std::chrono::steady_clock::time_point::max()) {
    if (objects++ > 0) {
        return;
    }
    caught = 0;
    for (const int number : machine::kStopSignals) {
        handle(number, note_signal);
    }
    handle(SIGXFSZ, SIG_IGN);
}

Interruption::~Interruption() {
    if (--objects > 0) {
        return;
    }
    for (const int number : machine::kStopSignals) {
        handle(number, SIG_DFL);
    }
}

std::string Interruption::reason(std::chrono::duration<double> ahead) const {
    if (caught != 0) {
        return fmt::format("SIG{}", sigabbrev_np(caught));
    }
    const bool over = limit_ && std::chrono::steady_clock::now() - start_ + ahead >= *limit_;
    return over ? "the time limit" : "";
}

bool Interruption::signalled() const {
    return caught != 0;
}

void Interruption::cancel_in(std::chrono::duration<double> grace) const {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(grace);
    auto before = end_.load();
    while (end < before && !end_.compare_exchange_weak(before, end)) {
    }
}

void Interruption::disable_cancellation() const {
    finishing_ = true;
}

bool Interruption::stop() const {
    if (finishing_) {
        return false;
    }
    const bool signalled =
        caught != 0 && steady_ns() - caught_ns >= std::chrono::nanoseconds(kGrace).count();
    return signalled || std::chrono::steady_clock::now() >= end_.load(std::memory_order_relaxed);
}

std::optional<std::chrono::seconds> parse_time_limit(const std::string& text) {
    std::array<long, 3> parts{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [next, error] = std::from_chars(at, end, parts[i]);
        const auto digits = next - at;
        const bool last = i + 1 == parts.size();
        const bool good = error == std::errc{} && *at != '-' && (i == 0 || digits == 2) &&
                          (i == 0 || parts[i] < 60) && parts[i] < 1000000 &&
                          (last ? next == end : next != end && *next == ':');
        if (!good) {
            return std::nullopt;
        }
        at = next + 1;
    }
    return std::chrono::hours(parts[0]) + std::chrono::minutes(parts[1]) +
           std::chrono::seconds(parts[2]);
}

}  // namespace gearpod::mc
