#include "mc/options/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "mc/input/spelling.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/options/several_values.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Column in which the descriptions of options and commands start.
constexpr std::size_t kDescriptionColumn = 30;

// Two columns: a name, and its description in the same line or, after a long name, in the next one.
std::string help_entry(const std::string& name, const std::string& description) {
    std::string out = "  " + name;
    if (out.size() < kDescriptionColumn) {
        out.resize(kDescriptionColumn, ' ');
    } else {
        out += "\n" + std::string(kDescriptionColumn, ' ');
    }
    return out + wrapped_text(description, kDescriptionColumn) + "\n";
}

// Help output of CLI11, with descriptions wrapped to kLineWidth.
class WrappedHelp final : public CLI::Formatter {
  public:
    std::string make_description(const CLI::App* app) const override {
        return wrapped_text(app->get_description(), 0) + "\n";
    }
    std::string make_subcommand(const CLI::App* command) const override {
        return help_entry(command->get_name(), command->get_description());
    }
    std::string make_option(const CLI::Option* option, bool is_positional) const override {
        return help_entry(make_option_name(option, is_positional) + make_option_opts(option),
                          make_option_desc(option));
    }
};

// Arguments with the name of the option before each of several values.
std::vector<std::string> separated_arguments(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> words(argv, argv + std::min(argc, 2));
    const std::vector<std::string> rest(argv + words.size(), argv + argc);
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (words.size() == 2 && command->get_name() == words[1]) {
            const std::vector<std::string> separated = separate_values(*command, rest);
            words.insert(words.end(), separated.begin(), separated.end());
            return words;
        }
    }
    words.insert(words.end(), rest.begin(), rest.end());
    return words;
}

// Arguments that no option of the command takes.
std::vector<std::string> unexpected_arguments(const CLI::App& command) {
    std::vector<std::string> problems, names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->nonpositional()) {
            names.push_back(option->get_name());
        }
    }
    bool after_option = false;  // a value of an unknown option is not reported once more
    for (const std::string& word : command.remaining()) {
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with("-")) {
            const std::string meant = suggest(name, {names.begin(), names.end()});
            problems.push_back(fmt::format("{}: unknown option of `{}`{}", name, command.get_name(),
                                           meant.empty() ? "" : "; " + meant));
        } else if (!after_option) {
            problems.push_back(word + ": unexpected argument");
        }
        after_option = name.starts_with("-") && name == word;
    }
    return problems;
}

// Problems of the arguments: unexpected ones, refused values, missing ones. CLI11 itself stops at
// the first.
std::string argument_problems(CLI::App& app) {
    std::vector<std::string> problems;
    for (CLI::App* command : app.get_subcommands()) {
        problems = unexpected_arguments(*command);
        for (CLI::Option* option : command->get_options()) {
            for (const std::string& value : option->results()) {
                if (const std::string why = check_problem(*option, value); !why.empty()) {
                    problems.push_back(option->get_name() + ": " + why);
                }
            }
            if (option->get_required() && option->count() == 0) {
                problems.push_back(option->get_name() +
                                   " is missing: " + option->get_description());
            }
        }
    }
    return fmt::format("{}", fmt::join(problems, "\n"));
}

// Adds --NAME, which sets ensemble.NAME to a whole number.
void add_whole_key(CLI::App& command, const std::string& name, const char* doc,
                   StudyOptions& options) {
    const Key& key = *find_key("ensemble", name);
    command
        .add_option_function<std::string>(
            "--" + name,
            [&options, &key](const std::string& value) {
                options.overrides.push_back(key.path() + "=" + value);
            },
            doc)
        ->type_name("INT")
        ->check(number_check(NumberForm::whole, {key.range.low, key.range.high}));
}

}  // namespace

int parse(CLI::App& app, int argc, char** argv, const int& code) {
    const auto help = std::make_shared<WrappedHelp>();
    app.formatter(help);
    for (CLI::App* command : app.get_subcommands({})) {
        command->formatter(help);
    }
    const std::vector<std::string> words = separated_arguments(app, argc, argv);
    std::vector<const char*> pointers;
    for (const std::string& word : words) {
        pointers.push_back(word.c_str());
    }
    try {
        app.parse(static_cast<int>(pointers.size()), pointers.data());
    } catch (const CLI::ParseError& error) {
        const bool failed = error.get_exit_code() != 0;
        const std::string all = failed ? argument_problems(app) : "";
        if (all.empty()) {
            return app.exit(error) == 0 ? kDone : kBadInput;
        }
        app.exit(CLI::ValidationError(all));
        return kBadInput;
    }
    return code;
}

CLI::Option* require_file_name(CLI::Option* option) {
    return option->check([](const std::string& name) {
        return name.empty() ? std::string("the file name is empty; give a name, or omit the option")
                            : std::string();
    });
}

void add_study_keys(CLI::App& command, StudyOptions& options) {
    command
        .add_option(
            "--set", options.overrides,
            "change a key of the study, e.g. ensemble.seed=7; a distribution as in [random], "
            "e.g. 'sensor.gain={distribution=\"uniform\", low=1, high=2}'")
        ->type_name("SECTION.KEY=VALUE")
        ->allow_extra_args(false);
}

CLI::Option* add_study(CLI::App& command, StudyOptions& options) {
    add_study_keys(command, options);
    return command.add_option("study", options.path, "study file (TOML)")->required();
}

void add_ensemble(CLI::App& command, const char* instances, StudyOptions& options) {
    add_whole_key(command, "instances", instances, options);
    add_whole_key(command, "seed", "seed of all random numbers", options);
}

void add_json(CLI::App& command, std::string& file) {
    require_file_name(
        command.add_option("--json", file, "write JSON to a file, or - for standard output"));
}

void add_page(CLI::App& command, std::string& file) {
    require_file_name(command.add_option("--html", file, "write a page with figures to a file"));
}

void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force) {
    require_file_name(
        command.add_option("--out", run.out, "results file (default: the study's name with .h5)"));
    command.add_flag("--resume", run.resume, resume);
    command.add_flag("--force", run.force, force);
    command
        .add_option("--time-limit", run.time_limit,
                    "save a checkpoint and exit with code 4 before this time ends")
        ->type_name("HH:MM:SS");
}

void add_force(CLI::App& command, bool& force) {
    command.add_flag("--force", force, "replace existing files that are no outputs of this kind");
}

void add_progress(CLI::App& command, RunOptions& run) {
    command
        .add_option("--progress", run.progress,
                    "json: print progress to stderr, one JSON object per line")
        ->type_name("json");
}

}  // namespace gearpod::mc
