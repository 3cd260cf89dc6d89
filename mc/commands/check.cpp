// Command `check STUDY...`: reports the problems of study files; nothing is simulated or written.
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"

namespace gearpod::mc {
namespace {

struct CheckOptions {
    std::vector<std::string> studies;
    StudyOptions changes;  // keys that --set changes in every study
};

// Prints whether the study can be simulated, by `lives` if it has [life] and otherwise by `run`,
// with its problems and warnings. Returns the exit code.
int check_study(const StudyOptions& study) {
    try {
        const StudyScene made = load_scene(study);
        if (!made) {
            return kBadInput;
        }
        const StudyLives& lives = made.scene->lives();
        if (lives.requested && !lives.plan) {
            print_problems(lives.problems_in(study.path));
            return kBadInput;
        }
        if (!lives.requested) {
            warn_of_shortage(made.scene->ensemble(), printable(study.path));
        }
        fmt::print("{}: can be simulated by `{}`\n", printable(study.path),
                   lives.requested ? "lives" : "run");
        return kDone;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", printable(study.path), exception_text(error));
    }
    return kBadInput;
}

// Checks every study, also after a wrong one.
int check_command(const CheckOptions& options) {
    int code = kDone;
    for (const std::string& path : options.studies) {
        code = std::max(code, check_study({path, options.changes.overrides}));
    }
    return code;
}

}  // namespace

void add_check(CLI::App& app, int& code) {
    const auto [command, options] = add_command<CheckOptions>(
        app, code, "check",
        "report all problems of study files without simulating them, for example before they are "
        "queued; exit code 2 if one cannot be simulated by `lives` (with [life]) or `run`",
        check_command);
    command.add_option("studies", options.studies, "study files (TOML)")->required();
    add_study_keys(command, options.changes);
}

}  // namespace gearpod::mc
