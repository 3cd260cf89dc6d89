// How many threads one process computes with.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// As many as OMP_NUM_THREADS says; without it the processors of this process, shared with the ranks
// beside it. At most OMP_THREAD_LIMIT.
int thread_count(int ranks_on_this_machine = 1);

// The same, overruled by the study's numerics.threads where they are not 0.
int thread_count(const Study& study, int ranks_on_this_machine = 1);

}  // namespace gearpod::mc
