// Number of threads of one process.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// OMP_NUM_THREADS, or else the processors of this process divided by the ranks on this machine. At
// most OMP_THREAD_LIMIT.
int thread_count(int ranks_on_this_machine = 1);

// The same, unless the study's numerics.threads is not 0; then that number.
int thread_count(const Study& study, int ranks_on_this_machine = 1);

}  // namespace gearpod::mc
