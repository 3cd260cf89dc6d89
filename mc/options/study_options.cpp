#include "mc/options/options.hpp"

namespace gearpod::mc {

int parse(CLI::App& app, int argc, char** argv, const int& code) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kBadInput;
    }
    return code;
}

CLI::Option* needs_name(CLI::Option* option) {
    return option->check([](const std::string& name) {
        return name.empty() ? std::string("the file name is empty; name a file, or leave it out")
                            : std::string();
    });
}

void add_study_keys(CLI::App& command, StudyOptions& options) {
    command
        .add_option("--set", options.overrides, "change a key of the study, e.g. ensemble.seed=7")
        ->type_name("SECTION.KEY=VALUE")
        ->allow_extra_args(false);
}

CLI::Option* add_study(CLI::App& command, StudyOptions& options) {
    add_study_keys(command, options);
    return command.add_option("study", options.path, "study file (TOML)")->required();
}

void add_shorthand(CLI::App& command, const char* name, const char* key, const char* doc,
                   StudyOptions& options) {
    command.add_option_function<std::string>(
        name,
        [&options, key](const std::string& value) {
            options.overrides.push_back(std::string(key) + "=" + value);
        },
        doc);
}

void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force) {
    needs_name(
        command.add_option("--out", run.out, "results file (default: the study's name with .h5)"));
    command.add_flag("--resume", run.resume, resume);
    command.add_flag("--force", run.force, force);
    command
        .add_option("--time-limit", run.time_limit,
                    "finish, save and exit with 4 before this time is over")
        ->type_name("HH:MM:SS");
}

void add_progress(CLI::App& command, RunOptions& run) {
    command.add_option("--progress", run.progress, "json: progress as an object a line on stderr")
        ->type_name("json");
}

}  // namespace gearpod::mc
