#include "mc/ensemble/ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

#include "machine/team.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {

std::string rank_name(const Ranks& ranks) {
    return fmt::format("rank {} on {}", ranks.rank(), host_name());
}

namespace {

// Environment variables in which a launcher states how many processes it started, and the number
// of this one.
struct Launcher {
    const char *name, *size, *rank;
};
// The first one found is the innermost: mpirun starts its processes through srun.
constexpr std::array<Launcher, 5> kLaunchers{
    {{"mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
     {"a launcher", "PMI_SIZE", "PMI_RANK"},
     {"mpirun", "MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},
     {"mpirun", "MPI_LOCALNRANKS", "MPI_LOCALRANKID"},
     {"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}}};

// Whole number in an environment variable; -1 if there is none.
long number_in(const char* variable) {
    const char* text = std::getenv(variable);
    char* end = nullptr;
    const long number = text == nullptr ? -1 : std::strtol(text, &end, 10);
    return end == text ? -1 : number;
}

}  // namespace

void Ranks::require_connected() const {
    for (const Launcher& launcher : kLaunchers) {
        const long size = number_in(launcher.size), ranks = number_in(launcher.rank) + 1;
        const long started = std::max(size, ranks);
        if (started > size_) {
            throw std::runtime_error(fmt::format(
                "{} started {} processes ({}), but {}", launcher.name, started,
                size < ranks ? launcher.rank : launcher.size,
                built_with_mpi()
                    ? fmt::format("MPI connects only {}: use srun --mpi=pmix, or the mpirun of {}",
                                  size_, library())
                    : "this program was built without MPI; start a single process, or rebuild it "
                      "with -DGEARPOD_MPI=ON"));
        }
        if (started > 0) {
            return;
        }
    }
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
