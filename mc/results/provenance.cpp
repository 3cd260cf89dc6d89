#include "mc/results/provenance.hpp"

#include <H5public.h>
#include <fmt/chrono.h>
#include <unistd.h>

#include <array>
#include <ctime>

#include "gearpod_version.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::mc {

std::string version_text() {
    return version_text(GEARPOD_VERSION, GEARPOD_GIT_HASH);
}

std::string version_text(const std::string& code_version, const std::string& git_hash) {
    const bool modified = git_hash.ends_with("-modified");
    return fmt::format("gearpod {} (git {:.12}{})", code_version, git_hash,
                       modified ? ", modified" : "");
}

std::string build_text() {
    return fmt::format("{}\ncompiler: gcc {}\nkernels: {}\nHDF5: {}.{}.{}\n", version_text(),
                       __VERSION__, lockstep::built_kernels(), H5_VERS_MAJOR, H5_VERS_MINOR,
                       H5_VERS_RELEASE);
}

std::string host_name() {
    std::array<char, 256> host{};
    return gethostname(host.data(), host.size() - 1) == 0 ? host.data() : "";
}

std::vector<std::pair<std::string, std::string>> provenance(const Study& study, int ranks,
                                                            int threads) {
    return {{"code_version", GEARPOD_VERSION},
            {"git_hash", GEARPOD_GIT_HASH},
            {"compiler", "gcc " __VERSION__},
            {"instruction_set", std::string(machine::name(machine::active_instruction_set()))},
            {"kernels", lockstep::built_kernels()},
            {"study", resolved_text(study)},
            {"seed", std::to_string(study.ensemble.seed)},
            {"ranks", std::to_string(ranks)},
            {"threads", std::to_string(threads)},
            {"lanes", std::to_string(study.numerics.lanes)},
            {"host", host_name()},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace gearpod::mc
