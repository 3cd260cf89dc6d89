// Teams of threads, and the cooperative cancellation of what they compute. Long computations poll
// it between their parts (mesh periods, gearboxes, tasks of a team) and leave by an exception.
#pragma once

#include <cstddef>
#include <functional>

namespace gearpod::machine {

// Thrown by a cancelled computation. It is no std::exception, so that no handler of failed
// computations catches it by mistake.
struct Cancelled {};

// Source of cancellation requests, active for all threads from its construction to its destruction.
// At most one may exist at a time, and it must outlive the computations that it stops.
class CancellationSource {
  public:
    CancellationSource();
    CancellationSource(const CancellationSource&) = delete;
    CancellationSource& operator=(const CancellationSource&) = delete;
    virtual ~CancellationSource();

    // True if computations are to stop. Called often, by any thread.
    virtual bool stop() const = 0;
};

// Throws Cancelled if the active CancellationSource requests cancellation.
void throw_if_cancelled();

// Teams of OpenMP threads. No other file uses OpenMP.

// Calls work(n) on every thread of a team of n threads. n is `threads`, or as many as OpenMP grants
// (OMP_THREAD_LIMIT, OMP_DYNAMIC). The calling thread is the first of the team; OMP_PROC_BIND and
// OMP_PLACES place the threads. Rethrows one of the exceptions thrown, after all threads have
// ended.
void run_team(int threads, const std::function<void(int)>& work);

// Calls work(0) .. work(count - 1), each on the next free thread of a team. Rethrows one of the
// exceptions thrown, after all calls have been made.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

// Number of processors that this process may use, independent of the binding of its first thread.
int processors();

// Number of threads requested by OMP_NUM_THREADS (the first of a list). 0 if the variable is not
// set, or if OpenMP did not accept it; OpenMP itself reports values that it cannot read.
int requested_threads();

// OMP_THREAD_LIMIT, or the largest int without a limit.
int thread_limit();

}  // namespace gearpod::machine
