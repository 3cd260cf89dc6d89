#include "mc/ensemble/thread_count.hpp"

#include <unistd.h>

#include <algorithm>

#include "machine/team.hpp"

namespace gearpod::mc {

int thread_count(int ranks_on_this_machine) {
    if (const int asked = machine::threads_asked_for(); asked > 0) {
        return std::min(asked, machine::most_threads());
    }
    // A rank that is bound to some of the processors sees only those.
    const int own = machine::processors();
    const int shared = own < sysconf(_SC_NPROCESSORS_ONLN) ? own : own / ranks_on_this_machine;
    return std::clamp(shared, 1, machine::most_threads());
}

int thread_count(const Study& study, int ranks_on_this_machine) {
    return study.numerics.threads > 0 ? std::min(study.numerics.threads, machine::most_threads())
                                      : thread_count(ranks_on_this_machine);
}

}  // namespace gearpod::mc
