#include "mc/options/options.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
