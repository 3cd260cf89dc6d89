#include "mc/commands/options/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

bool is_option_word(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

// True for options that take one value for each time they are given and may be given repeatedly.
// CLI11 itself distributes the values of all others.
bool takes_several(const CLI::Option& option) {
    return option.get_items_expected_max() > 1 && !option.get_allow_extra_args() &&
           option.get_option_text().empty();
}

bool accepts(const CLI::Option& option, const std::string& word) {
    if (option.get_type_name().find('=') != std::string::npos &&
        word.find('=') == std::string::npos) {
        return false;
    }
    const bool split = option.get_delimiter() != '\0';
    const auto values =
        split ? CLI::detail::split(word, option.get_delimiter()) : std::vector<std::string>{word};
    return std::ranges::all_of(
        values, [&](const std::string& value) { return check_problem(option, value).empty(); });
}

bool needs_file_name(const CLI::App& command) {
    const auto options = command.get_options();
    return std::ranges::any_of(options, [](const CLI::Option* option) {
        return option->get_positional() && option->get_required();
    });
}

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

void add_signal_reading(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor-unit", columns.sensor_unit.unit,
                       "unit of the acceleration, for example g; takes precedence over the file's "
                       "(default: the file's, or m/s^2 if it gives none)");
    command.add_option("--sensor-sensitivity", columns.sensor_unit.sensitivity,
                       "sensitivity of the accelerometer if its values are voltages, with its "
                       "unit: \"100 mV/g\", \"10.2 mV/(m/s^2)\"");
    command.add_option("--tachometer", columns.tachometer,
                       "column of tachometer pulses, of the member whose speed the study gives");
    add_number(command, "--pulses-per-turn", columns.pulses_per_turn,
               "pulses of the tachometer per turn (default: 1)", from_to(1.0, 1e5));
    command.add_option("--encoder", columns.encoder,
                       "column of the encoder angle of that member; rad, or the unit in brackets "
                       "after the name: deg, turns, ...");
    command
        .add_option_function<std::string>(
            "--speed",
            [&columns](const std::string& value) {
                columns.speed = value == "found"    ? SpeedCheck::follow
                                : value == "stated" ? SpeedCheck::ignore
                                                    : SpeedCheck::refuse;
            },
            "check (default): refuse the study's speed if the mesh lines do not match it; found: "
            "use the speed of the mesh lines; stated: use the study's speed unchecked")
        ->check(CLI::IsMember({"check", "found", "stated"}));
}

}  // namespace

CLI::Validator number_check(NumberForm form, NumberRange range) {
    const std::string bounds = range_text(range);
    return CLI::Validator([form, range = std::move(range)](
                              std::string& text) { return number_problem(text, form, range); },
                          bounds);
}

std::string check_problem(const CLI::Option& option, const std::string& value) {
    // Checks are numbered; get_validator() throws beyond the last one.
    for (int i = 0;; ++i) {
        const CLI::Validator* check = nullptr;
        try {
            check = const_cast<CLI::Option&>(option).get_validator(i);
        } catch (const CLI::OptionNotFound&) {
            return "";
        }
        if (std::string why = (*check)(value); !why.empty()) {
            return why;
        }
    }
}

std::vector<std::string> separate_values(const CLI::App& command,
                                         const std::vector<std::string>& words) {
    std::vector<std::string> out;
    bool has_free_word = false;  // a word that is no option and no value of one
    // Name of an option in `out` before a value that may be the command's file name: the last value
    // of several that is an existing file, otherwise the last one.
    std::optional<std::size_t> superfluous;
    bool exists = false;
    for (std::size_t at = 0; at < words.size(); ++at) {
        out.push_back(words[at]);
        if (words[at] == "--") {
            has_free_word = has_free_word || at + 1 < words.size();
            out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(at) + 1, words.end());
            break;
        }
        const std::string& name = words[at];
        if (!is_option_word(name)) {
            has_free_word = true;
            continue;
        }
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option == nullptr || option->get_items_expected_max() == 0 || at + 1 == words.size()) {
            continue;  // unknown, a flag, --name=value, or without its value
        }
        out.push_back(words[++at]);
        const std::size_t first = at;
        while (takes_several(*option) && at + 1 < words.size() && !is_option_word(words[at + 1]) &&
               accepts(*option, words[at + 1])) {
            out.insert(out.end(), {name, words[++at]});
        }
        std::error_code none;
        const bool file = at > first && std::filesystem::exists(words[at], none);
        if (at > first && (file || !exists)) {
            superfluous = out.size() - 2;
            exists = file;
        }
    }
    if (superfluous && !has_free_word && needs_file_name(command)) {
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(*superfluous));
    }
    return out;
}

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

CLI::Option* add_file(CLI::App& command, const std::string& name, std::string& file,
                      const std::string& description) {
    return command.add_option(name, file, description)->check([](const std::string& given) {
        return given.empty()
                   ? std::string("the file name is empty; give a name, or omit the option")
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

void add_full(CLI::App& command, bool& full) {
    command.add_flag("--full", full, "print all findings, not only the first screen");
}

void add_json(CLI::App& command, std::string& file) {
    add_file(command, "--json", file, "write JSON to a file, or - for standard output");
}

void add_page(CLI::App& command, std::string& file) {
    add_file(command, "--html", file, "write a page with figures to a file");
}

void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force) {
    add_file(command, "--out", run.out, "results file (default: the study's name with .h5)");
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

RecordingList list_of(const std::string& manifest, const std::vector<std::string>& files,
                      Problems& problems) {
    try {
        return manifest.empty() ? recordings_of(files, problems)
                                : read_manifest(manifest, problems);
    } catch (const SignalError& error) {
        problems.push_back({printable(error.what()), 0, "", "", ""});
        return {};
    }
}

void add_columns(CLI::App& command, SignalColumns& columns) {
    command.add_option(
        "--sensor", columns.sensor,
        "column of the acceleration (default: sensor); in HDF5 and MAT files a name or path, "
        "and data:2 for the second column of a matrix");
    command.add_option("--time", columns.time,
                       "column of the times (default: time, Time, t, X_Value, Timestamp)");
    add_number(command, "--sampling-Hz", columns.sampling_Hz,
               "sampling rate (default: from the file)", above(0.0, "Hz"));
    add_number(command, "--samples-per-mesh", columns.samples_per_mesh,
               "samples per mesh period, for recordings sampled evenly in mesh phase",
               from_to(2.0, 1e6));
    add_signal_reading(command, columns);
}

}  // namespace gearpod::mc
