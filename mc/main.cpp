#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "mc/commands.hpp"
#include "mc/provenance.hpp"

namespace {

using namespace gearpod::mc;

CLI::Option* add_study(CLI::App& command, StudyOptions& options) {
    command
        .add_option("--set", options.overrides, "change a key of the study, e.g. ensemble.seed=7")
        ->type_name("SECTION.KEY=VALUE")
        ->allow_extra_args(false);
    return command.add_option("study", options.path, "study file (TOML)")->required();
}

// --instances N and --seed S are short for keys of the study.
void add_shorthand(CLI::App& command, const char* name, const char* key, const char* doc,
                   StudyOptions& options) {
    command.add_option_function<std::string>(
        name,
        [&options, key](const std::string& value) {
            options.overrides.push_back(std::string(key) + "=" + value);
        },
        doc);
}

// Says that `name` is no command, if so.
bool is_command(CLI::App& app, const std::string& name) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) {
            return true;
        }
        names += (names.empty() ? "" : ", ") + command->get_name();
    }
    fmt::print(stderr, "{}: unknown command; the commands are {}\n", name, names);
    return false;
}

int run_program(int argc, char** argv) {
    CLI::App app{
        "gearpod: which gear-tooth crack would a sensor, a feature and a threshold have "
        "found, and how surely?"};
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    int code = kDone;

    RunOptions run;
    auto* run_app =
        app.add_subcommand("run", "simulate the whole study and report detection rates");
    add_study(*run_app, run.study);
    add_shorthand(*run_app, "--instances", "ensemble.instances", "gearboxes over all fault sizes",
                  run.study);
    add_shorthand(*run_app, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    run_app->add_option("--out", run.out, "results file (default: the study's name with .h5)");
    run_app->add_flag("--resume", run.resume,
                      "continue an interrupted run, or add gearboxes to a finished one");
    run_app
        ->add_option("--time-limit", run.time_limit,
                     "finish, save and exit with 4 before this time is over")
        ->type_name("HH:MM:SS");
    run_app->add_option("--watch", run.watch, "feature whose detection rate the progress shows");
    run_app
        ->add_option("--signals", run.signals,
                     "rows whose signals over a planet turn go into the results, e.g. 0,17")
        ->type_name("ROW,ROW...")
        ->delimiter(',')
        ->allow_extra_args(false);
    run_app->add_flag("--quiet", run.quiet, "print nothing but problems");
    run_app->callback([&] { code = run_command(run); });

    ReportOptions report;
    auto* report_app = app.add_subcommand("report", "detection rates from a results file");
    report_app->add_option("results", report.results, "results file (HDF5)")->required();
    report_app->add_option("--json", report.json, "write JSON to a file, or to - for the terminal");
    report_app->add_option("--html", report.html, "write a page with figures to a file");
    report_app->add_option(
        "--by", report.condition,
        "random input, e.g. torque_N_m, whose values get thresholds of their own");
    report_app->callback([&] { code = report_command(report); });

    DescribeOptions describe;
    auto* describe_app =
        app.add_subcommand("describe", "what a study would simulate and cost; nothing runs");
    add_study(*describe_app, describe.study)->required(false);
    describe_app->add_flag("--keys", describe.keys, "all keys of study files, without a study");
    describe_app->callback([&] {
        if (describe.study.path.empty() && !describe.keys) {
            throw CLI::RequiredError("study");
        }
        code = describe_command(describe);
    });

    StiffnessOptions stiffness;
    auto* stiffness_app = app.add_subcommand("stiffness", "mesh stiffness over one mesh period");
    add_study(*stiffness_app, stiffness.study);
    stiffness_app->add_option("--csv", stiffness.csv, "write curves to a file, or to -");
    stiffness_app->add_option("--points", stiffness.points, "phases in the table")
        ->check(CLI::Range(2, 1000000));
    stiffness_app->callback([&] { code = stiffness_command(stiffness); });

    ModesOptions modes;
    auto* modes_app = app.add_subcommand("modes", "natural frequencies at mean mesh stiffness");
    add_study(*modes_app, modes.study);
    modes_app->add_option("--json", modes.json, "write JSON to a file, or to -");
    modes_app->callback([&] { code = modes_command(modes); });

    SimulateOptions simulate;
    auto* simulate_app = app.add_subcommand("simulate", "one gearbox's signals and features");
    add_study(*simulate_app, simulate.study);
    simulate_app->add_option("--instance", simulate.instance, "row of the results file, from 0")
        ->required();
    simulate_app->add_option("--out", simulate.out, "signals as .h5 or .csv");
    simulate_app
        ->add_option("--meshes", simulate.meshes, "mesh periods to write (default: a planet turn)")
        ->check(CLI::PositiveNumber);
    simulate_app->callback([&] { code = simulate_command(simulate); });

    if (argc > 1 && argv[1][0] != '-' && !is_command(app, argv[1])) {
        return kBadInput;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kBadInput;
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int code = run_program(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            fmt::print(stderr, "gearpod: standard output cannot be written\n");
            return kBadInput;
        }
        return code;
    } catch (const std::exception& error) {
        fmt::print(stderr, "gearpod: {}\n", error.what());
        return kBadInput;
    }
}
