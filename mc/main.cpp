#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "mc/commands/commands.hpp"
#include "mc/commands/help/reference.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/options/program.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/results/provenance.hpp"

namespace {

using namespace gearpod::mc;

// True if `name` is a command; otherwise prints an error.
bool is_command(CLI::App& app, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    if (std::ranges::find(names, name) != names.end()) {
        return true;
    }
    const std::string meant = suggest(name, {names.begin(), names.end()});
    fmt::print(stderr, "{}: unknown command; {}the commands are {}\n", name,
               meant.starts_with("did you mean") ? meant + " " : "", fmt::join(names, ", "));
    return false;
}

// Adds the options that print the program's own description: man page, bash completion and JSON.
// The build and the documentation call the program for them.
void add_descriptions(CLI::App& app) {
    const auto print = [](const std::string& text) {
        fmt::print("{}", text);
        throw CLI::Success();
    };
    app.add_flag_callback(
        "--man", [&app, print] { print(man_page(app, version_text())); },
        "print the man page (gearpod --man | man -l -)");
    app.add_flag_callback(
        "--completion", [&app, print] { print(bash_completion(app)); },
        "print the bash completion (source <(gearpod --completion))");
    app.add_flag_callback(
        "--reference", [&app, print] { print(reference_json(app, version_text())); },
        "print commands, study keys, distributions and features as JSON");
}

int run_program(int argc, char** argv) {
    CLI::App app{
        "gearpod: which gear-tooth faults do a sensor, a feature and a threshold detect, and with "
        "what probability?"};
    app.set_version_flag(
        "--version", [] { return build_text(Ranks::library()); },
        "print the version and the build settings");
    add_descriptions(app);
    app.require_subcommand(1);
    int code = kDone;
#define GEARPOD_COMMAND(name) add_##name(app, code);
#include "mc/commands/commands.def"
#undef GEARPOD_COMMAND

    if (argc > 1 && argv[1][0] != '-' && !is_command(app, argv[1])) {
        return kBadInput;
    }
    return parse(app, argc, argv, code);
}

}  // namespace

int main(int argc, char** argv) {
    gearpod::mc::fix_memory_limits();
    return run_safely(argc, argv, run_program);
}
