// Threads that work together: an OpenMP team. All that knows OpenMP is here.
#pragma once

#include <cstddef>
#include <functional>

namespace gearpod::machine {

// Calls work(n) on every thread of a team of n: so many as asked for, or as many of them as OpenMP
// grants (OMP_THREAD_LIMIT, OMP_DYNAMIC). The calling thread is the team's first; OMP_PROC_BIND and
// OMP_PLACES say where they run. Rethrows what one of them threw, after all have ended.
void run_team(int threads, const std::function<void(int)>& work);

// Calls work(0) .. work(count - 1), each on the next thread of such a team that is free; rethrows
// what one of them threw, after all have been called.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

// Processors that this process may use, wherever its first thread is bound to.
int processors();

// Threads that OMP_NUM_THREADS asks for (of a list, the first); 0 if it is not set, or not what
// OpenMP made of it, which says itself what it cannot read.
int threads_asked_for();

// OMP_THREAD_LIMIT, or no limit.
int most_threads();

}  // namespace gearpod::machine
