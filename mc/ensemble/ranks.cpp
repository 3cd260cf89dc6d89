#include "mc/ensemble/ranks.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include "mc/results/provenance.hpp"

namespace gearpod::mc {

std::string rank_name(const Ranks& ranks) {
    return fmt::format("rank {} on {}", ranks.rank(), host_name());
}

int processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    const int bound = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
    return bound > 0 ? bound : all_processors();
}

int all_processors() {
    return static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
}

}  // namespace gearpod::mc
