#include "machine/team.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <latch>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace gearpod::machine {
namespace {

std::atomic<const CancellationSource*> active_source{nullptr};

}  // namespace

CancellationSource::CancellationSource() {
    active_source = this;
}

CancellationSource::~CancellationSource() {
    active_source = nullptr;
}

void throw_if_cancelled() {
    const CancellationSource* const present = active_source.load(std::memory_order_acquire);
    if (present != nullptr && present->stop()) {
        throw Cancelled{};
    }
}

namespace {

// Keeps the last exception thrown inside a parallel region, which no exception may leave, and
// rethrows it after the region's end.
class Failure {
  public:
    template <class Action>
    void keep_from(Action action) noexcept {
        try {
            action();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            what_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (what_) {
            std::rethrow_exception(what_);
        }
    }

  private:
    std::mutex mutex_;
    std::exception_ptr what_;
};

// Throws std::bad_alloc if so many threads cannot be created, where OpenMP would end the program.
void require_threads(int threads) {
    static std::atomic<int> created{1};
    if (threads <= created) {
        return;
    }
    std::latch end(1);
    std::vector<std::jthread> trial;
    try {
        for (int i = 1; i < threads; ++i) {
            trial.emplace_back([&end] { end.wait(); });
        }
    } catch (const std::system_error&) {
        end.count_down();
        throw std::bad_alloc();
    }
    end.count_down();
    created = threads;
}

}  // namespace

void run_team(int threads, const std::function<void(int)>& work) {
    require_threads(threads);
    Failure failure;
#pragma omp parallel num_threads(threads)
    failure.keep_from([&] { work(omp_get_num_threads()); });
    failure.rethrow();
}

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
    const auto most = std::clamp<std::size_t>(count, 1, static_cast<std::size_t>(threads));
    require_threads(static_cast<int>(most));
    Failure failure;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(most))
    for (std::size_t i = 0; i < count; ++i) {
        failure.keep_from([&] {
            throw_if_cancelled();
            work(i);
        });
    }
    failure.rethrow();
}

int processors() {
    return omp_get_num_procs();
}

int requested_threads() {
    const char* text = std::getenv("OMP_NUM_THREADS");
    const long first = text == nullptr ? 0 : std::strtol(text, nullptr, 10);
    return first == omp_get_max_threads() ? static_cast<int>(first) : 0;
}

int thread_limit() {
    return omp_get_thread_limit();
}

}  // namespace gearpod::machine
