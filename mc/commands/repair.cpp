// Command `repair RESULTS`: renews the integrity hash of a results file that another program has
// changed or written anew.
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/results/file_checksum.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

struct RepairOptions {
    std::string results;
};

int repair_command(const RepairOptions& options) {
    const std::string& path = options.results;
    const bool intact = check_file_checksum(path) == ChecksumState::intact;
    // Throws unless the file can be read completely and holds values that a run may write.
    const Results results = read_unverified_results(path);
    if (results.provenance_value("kind") != kLivesKind) {
        check_results(path, results, ColumnRows(results));
    }
    if (intact) {
        fmt::print("{}: its integrity hash fits its contents; nothing to repair\n", path);
        return kDone;
    }
    const Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (file.get() < 0 || !write_checksum(file.get()) || ::fsync(file.get()) != 0) {
        throw std::runtime_error(path + ": cannot be written (" + std::strerror(errno) + ")");
    }
    fmt::print(
        "{}: can be read completely and has a new integrity hash; changes of its contents before "
        "now cannot be detected\n",
        path);
    return kDone;
}

}  // namespace

void add_repair(CLI::App& app, int& code) {
    const auto [command, options] = add_command<RepairOptions>(
        app, code, "repair",
        "renew the integrity hash of a results file that another program has changed on purpose or "
        "written anew; the file is read completely first",
        reporting<repair_command>);
    command.add_option("results", options.results, "results file (HDF5)")->required();
}

}  // namespace gearpod::mc
