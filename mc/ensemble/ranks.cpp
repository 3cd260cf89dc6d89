#include "mc/ensemble/ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "machine/team.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {

std::string rank_name(const Ranks& ranks) {
    return fmt::format("rank {} on {}", ranks.rank(), host_name());
}

void Ranks::require_connected() const {
    // The first launcher found is the innermost: mpirun starts its processes through srun.
    for (const auto& [variable, launcher] : {std::pair{"OMPI_COMM_WORLD_SIZE", "mpirun"},
                                             {"PMI_SIZE", "a launcher"},
                                             {"SLURM_STEP_NUM_TASKS", "srun"}}) {
        const char* text = std::getenv(variable);
        const int started = text == nullptr ? 0 : std::atoi(text);
        if (started > size_) {
            throw std::runtime_error(fmt::format(
                "{} started {} processes ({}), but {}", launcher, started, variable,
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
