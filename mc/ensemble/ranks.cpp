#include "mc/ensemble/ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "machine/team.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {

std::string rank_name(const Ranks& ranks) {
    return fmt::format("rank {} on {}", ranks.rank(), host_name());
}

int thread_count(int ranks_on_this_machine) {
    if (const int requested = machine::requested_threads(); requested > 0) {
        return std::min(requested, machine::thread_limit());
    }
    // A rank that is bound to some of the processors sees only those.
    const int own = machine::processors();
    const int shared = own < sysconf(_SC_NPROCESSORS_ONLN) ? own : own / ranks_on_this_machine;
    return std::clamp(shared, 1, machine::thread_limit());
}

int thread_count(const Study& study, int ranks_on_this_machine) {
    return study.numerics.threads > 0 ? std::min(study.numerics.threads, machine::thread_limit())
                                      : thread_count(ranks_on_this_machine);
}

}  // namespace gearpod::mc
