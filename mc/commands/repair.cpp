// Command `repair RESULTS`: renews the integrity hash of a results file that another program has
// changed or written anew.
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "mc/commands/commands.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/file_descriptor.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/results/file_checksum.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

struct RepairOptions {
    std::string results;
};

// Throws std::runtime_error unless the file can be read completely and holds values that a run may
// write.
void check_contents(const std::string& path) {
    const Results results = read_unverified_results(path);
    if (results.provenance_value("kind") != kLivesKind) {
        check_results(path, results, ColumnRows(results));
    }
}

void renew_hash(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (file.get() < 0 || !write_checksum(file.get()) || ::fsync(file.get()) != 0) {
        throw std::runtime_error(path + ": cannot be written (" + std::strerror(errno) + ")");
    }
}

int repair_command(const RepairOptions& options) {
    const std::string& path = options.results;
    try {
        const bool intact = check_file_checksum(path) == ChecksumState::intact;
        check_contents(path);
        if (intact) {
            fmt::print("{}: its integrity hash fits its contents; nothing to repair\n", path);
            return kDone;
        }
        renew_hash(path);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
    fmt::print(
        "{}: can be read completely and has a new integrity hash; changes of its contents before "
        "now cannot be detected\n",
        path);
    return kDone;
}

}  // namespace

void add_repair(CLI::App& app, int& code) {
    const auto options = std::make_shared<RepairOptions>();
    auto* command = app.add_subcommand(
        "repair",
        "renew the integrity hash of a results file that another program has changed on purpose or "
        "written anew; the file is read completely first");
    command->add_option("results", options->results, "results file (HDF5)")->required();
    command->callback([options, &code] { code = repair_command(*options); });
}

}  // namespace gearpod::mc
