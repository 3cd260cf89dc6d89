#include "mc/provenance.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <array>
#include <ctime>

#include "gearpod_version.hpp"
#include "machine/dispatch.hpp"
#include "mc/ensemble.hpp"

namespace gearpod::mc {

std::string version_text() {
    return fmt::format("gearpod {} (git {:.12})", GEARPOD_VERSION, GEARPOD_GIT_HASH);
}

std::vector<std::pair<std::string, std::string>> provenance(const Study& study) {
    std::array<char, 256> host{};
    if (gethostname(host.data(), host.size() - 1) != 0) {
        host[0] = '\0';
    }
    return {{"code_version", GEARPOD_VERSION},
            {"git_hash", GEARPOD_GIT_HASH},
            {"compiler", "gcc " __VERSION__},
            {"instruction_set", std::string(machine::name(machine::active_instruction_set()))},
            {"study", resolved_text(study)},
            {"seed", std::to_string(study.ensemble.seed)},
            {"ranks", "1"},
            {"threads", std::to_string(thread_count(study))},
            {"lanes", std::to_string(study.numerics.lanes)},
            {"host", host.data()},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace gearpod::mc
