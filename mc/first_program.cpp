// Program with which a fresh source tree runs its first study: only `run`, with the integrators
// that src/CMakeLists.txt lists. It builds in two thirds of the time of the whole program. For
// everything else it starts the launcher, which replaces it by the whole program.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "lockstep/kernels/kernel_table.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/options/options.hpp"
#include "mc/options/program.hpp"
#include "mc/study/study.hpp"

namespace {

using namespace gearpod;
using namespace gearpod::mc;

// True if integrator or steps have to be searched for, or if this program does not have the
// integrator.
bool needs_whole_program(const Numerics& numerics) {
    const auto keys = lockstep::kernel_table().keys();
    return !numerics.integrator || numerics.grid != StepGrid::uniform ||
           numerics.tolerance != 0.0 || numerics.verify ||
           std::ranges::none_of(keys, [&](const lockstep::KernelKey& key) {
               return key.integrator == *numerics.integrator;
           });
}

// True if the whole program is needed. A study that cannot be read is rejected here in the same way
// as by the whole program.
bool needs_whole_program(const StudyOptions& options) {
    std::error_code none;
    if (std::filesystem::exists(options.path, none) &&
        !std::filesystem::is_regular_file(options.path, none)) {
        return true;
    }
    const StudyReading reading = read_study(options.path, options.overrides);
    return reading.study && needs_whole_program(reading.study->numerics);
}

// Replaces this process by the launcher; returns only on failure.
int start_launcher(char** argv) {
    if (Ranks::launched()) {
        fmt::print(stderr,
                   "gearpod: so far only `run` with the integrators of the first study has been "
                   "built; {} --help builds the rest\n",
                   GEARPOD_LAUNCHER);
        return kBadInput;
    }
    std::string launcher = GEARPOD_LAUNCHER;
    argv[0] = launcher.data();
    setenv("GEARPOD_WHOLE", "1", 1);
    execv(GEARPOD_LAUNCHER, argv);
    fmt::print(stderr, "{}: {}\n", launcher, std::strerror(errno));
    return kBadInput;
}

int run_program(int argc, char** argv) {
    CLI::App app;
    app.require_subcommand(1);
    RunOptions run;
    int code = kDone;
    add_run(app, run, code);
    app.get_subcommand("run")->callback(
        [&] { code = needs_whole_program(run.study) ? start_launcher(argv) : run_command(run); });
    return parse(app, argc, argv, code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || std::string_view(argv[1]) != "run") {
        return start_launcher(argv);
    }
    return run_safely(argc, argv, run_program);
}
