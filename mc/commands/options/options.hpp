// Options with numbers, which all commands read by the rules of mc/files/input/number_text.hpp.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mc/files/input/number_text.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/recordings/measure_recordings.hpp"
#include "mc/recordings/recording_columns.hpp"

namespace gearpod::mc {

// Check of CLI11 with number_problem(); its description is the range.
CLI::Validator number_check(NumberForm form, NumberRange range);

// Type of a number that may be optional.
template <class Value>
struct NumberOf {
    using type = Value;
};
template <class Value>
struct NumberOf<std::optional<Value>> {
    using type = Value;
};

// Adds an option with a number: double, int or long, or std::optional of these.
template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& name, Value& target,
                        const std::string& description, NumberRange range = {}) {
    using Number = typename NumberOf<Value>::type;
    constexpr bool kWhole = std::is_integral_v<Number>;
    if constexpr (kWhole) {
        range.low = std::max(range.low, static_cast<double>(std::numeric_limits<Number>::min()));
        range.high = std::min(range.high, static_cast<double>(std::numeric_limits<Number>::max()));
    }
    return command
        .add_option_function<std::string>(
            name,
            [&target](const std::string& text) {
                if constexpr (kWhole) {
                    target = static_cast<Number>(whole_number(text));
                } else {
                    target = real_number(text);
                }
            },
            description)
        ->type_name(kWhole ? "INT" : "FLOAT")
        ->check(number_check(kWhole ? NumberForm::whole : NumberForm::real, range));
}

// Options that take several values, `--hit A B C` as well as `--hit A --hit B --hit C`.

// Reason why the checks of an option refuse a value, or "".
std::string check_problem(const CLI::Option& option, const std::string& value);

// Writes the name of an option before each of its values: `--hit A B` becomes `--hit A --hit B`.
// `words` are the arguments after the command's name. A word belongs to the option before it unless
// it begins with a hyphen, fails the option's checks, or lacks the equals sign of the option's type
// (SECTION.KEY=VALUE). If the command needs a file name and no other word can be it, the last word
// after an option is that file name.
std::vector<std::string> separate_values(const CLI::App& command,
                                         const std::vector<std::string>& words);

// Options that several commands have, and the parsing of the command line (CLI11).

// Parses the arguments, which runs the command. Returns the command's exit code from `code`, or
// kBadInput if the arguments are wrong.
int parse(CLI::App& app, int argc, char** argv, const int& code);

// Adds a command that runs with its options, which live as long as it does.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& app, int& code, const std::string& name,
                                           const std::string& description,
                                           int (*run)(const Options&)) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand(name, description);
    command.callback([options, run, &code] { code = run(*options); });
    return {command, *options};
}

// Runs a command. Prints what it throws, which is then bad input.
template <auto run, class Options>
int reporting(const Options& options) {
    try {
        return run(options);
    } catch (const SceneError& error) {
        if constexpr (requires { options.study.path; }) {
            print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
        } else {
            print_problems({{"", 0, error.key(), error.what(), error.remedy()}});
        }
        return kBadInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
}

// Adds an option that names an output file and rejects an empty name.
CLI::Option* add_file(CLI::App& command, const std::string& name, std::string& file,
                      const std::string& description);

// Adds --set SECTION.KEY=VALUE. add_study() also adds the study file as a positional argument.
void add_study_keys(CLI::App& command, StudyOptions& options);
CLI::Option* add_study(CLI::App& command, StudyOptions& options);

// Adds --instances and --seed, which set keys of the study. `instances`: help text of the first.
void add_ensemble(CLI::App& command, const char* instances, StudyOptions& options);

// Adds --full, which prints all findings instead of the first screen.
void add_full(CLI::App& command, bool& full);

// Adds --json, and --html for a page with figures.
void add_json(CLI::App& command, std::string& file);
void add_page(CLI::App& command, std::string& file);

// Adds --out, --resume, --force and --time-limit. `resume` and `force` are their help texts.
void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force);
void add_progress(CLI::App& command, RunOptions& run);

// Adds --force to a command whose outputs otherwise replace files of their own kind only.
void add_force(CLI::App& command, bool& force);

// Recordings of a manifest, or without one those of signal files or name patterns.
RecordingList list_of(const std::string& manifest, const std::vector<std::string>& files,
                      Problems& problems);

// Adds options for the columns, units and sampling of recordings.
void add_columns(CLI::App& command, SignalColumns& columns);

}  // namespace gearpod::mc
