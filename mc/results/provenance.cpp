#include "mc/results/provenance.hpp"

#include <H5public.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <sstream>

#include "gearpod_version.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::mc {

std::string version_text() {
    return version_text(GEARPOD_VERSION, GEARPOD_GIT_HASH);
}

std::string version_text(const std::string& code_version, const std::string& git_hash) {
    const bool modified = git_hash.ends_with("-modified");
    return fmt::format("gearpod {} (git {:.12}{})", code_version, git_hash,
                       modified ? ", modified" : "");
}

std::string build_text(const std::string& mpi) {
    return fmt::format("{}\ncompiler: gcc {}\nkernels: {}\nMPI: {}\nHDF5: {}.{}.{}\n",
                       version_text(), __VERSION__, lockstep::built_kernels(), mpi, H5_VERS_MAJOR,
                       H5_VERS_MINOR, H5_VERS_RELEASE);
}

std::string host_name() {
    std::array<char, 256> host{};
    return gethostname(host.data(), host.size() - 1) == 0 ? host.data() : "";
}

std::vector<std::pair<std::string, std::string>> provenance(const EnsemblePlan& plan, int ranks,
                                                            int threads) {
    return {{"code_version", GEARPOD_VERSION},
            {"git_hash", GEARPOD_GIT_HASH},
            {"compiler", "gcc " __VERSION__},
            {"instruction_set", std::string(machine::name(machine::active_instruction_set()))},
            {"kernels", lockstep::built_kernels()},
            {"study", plan.study},
            {"seed", std::to_string(plan.seed)},
            {"ranks", std::to_string(ranks)},
            {"threads", std::to_string(threads)},
            {"lanes", std::to_string(plan.lanes)},
            {"host", host_name()},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

std::string line_difference(const std::string& there, const std::string& here,
                            const std::string& where_there) {
    std::istringstream lines_there(there), lines_here(here);
    std::string a, b;
    do {
        const bool more_a = static_cast<bool>(std::getline(lines_there, a));
        const bool more_b = static_cast<bool>(std::getline(lines_here, b));
        if (!more_a && !more_b) {
            return "";
        }
        a = more_a ? a : "nothing";
        b = more_b ? b : "nothing";
    } while (a == b);
    return fmt::format("\"{}\" {}, \"{}\" here", a, where_there, b);
}

RunIdentity run_identity(const EnsemblePlan& plan, const RowShape& shape, const Part& part) {
    return {version_text(), std::to_string(plan.seed), plan.identity, shape, part.text()};
}

std::string difference(const RunIdentity& there, const RunIdentity& here) {
    if (there.version != here.version) {
        return fmt::format("was made by {}, this is {}", there.version, here.version);
    }
    if (there.study != here.study) {
        return fmt::format("belongs to another study ({})",
                           line_difference(there.study, here.study));
    }
    if (there.seed != here.seed) {
        return fmt::format("has seed {}, this run has {}", there.seed, here.seed);
    }
    if (there.part != here.part) {
        const auto named = [](const std::string& part) {
            return part.empty() ? "the whole ensemble" : "part " + part;
        };
        return fmt::format("has {}, this is {}", named(there.part), named(here.part));
    }
    return there.shape == here.shape ? "" : "has rows with other columns";
}

}  // namespace gearpod::mc
