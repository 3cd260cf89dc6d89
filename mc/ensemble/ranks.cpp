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
    const int visible = machine::processors();
    const int share =
        visible < sysconf(_SC_NPROCESSORS_ONLN) ? visible : visible / ranks_on_this_machine;
    return std::clamp(share, 1, machine::thread_limit());
}

int thread_count(const EnsemblePlan& plan, int ranks_on_this_machine) {
    return plan.threads > 0 ? std::min(plan.threads, machine::thread_limit())
                            : thread_count(ranks_on_this_machine);
}

}  // namespace gearpod::mc
