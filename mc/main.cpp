#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "mc/forecast/memory.hpp"
#include "mc/help/man_page.hpp"
#include "mc/help/reference.hpp"
#include "mc/options/options.hpp"
#include "mc/options/program.hpp"
#include "mc/results/provenance.hpp"

namespace {

using namespace gearpod::mc;

// True if `name` is a command; otherwise prints an error.
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
        "gearpod: which gear-tooth cracks do a sensor, a feature and a threshold detect, and with "
        "what probability?"};
    app.set_version_flag("--version", build_text(), "print the version and the build settings");
    add_descriptions(app);
    app.require_subcommand(1);
    int code = kDone;

    RunOptions run;
    add_run(app, run, code);

    NewOptions new_study;
    add_new(app, new_study, code);

    SweepOptions sweep;
    add_sweep(app, sweep, code);

    LivesOptions lives;
    add_lives(app, lives, code);

    MergeOptions merge;
    auto* merge_app = app.add_subcommand(
        "merge", "join the results files of all parts of a study into one, as one run writes it");
    merge_app->add_option("results", merge.results, "results files of `run --part` 1/N to N/N")
        ->required();
    require_file_name(
        merge_app->add_option("--out", merge.out, "results file to write")->required());
    merge_app->add_flag("--force", merge.force,
                        "overwrite the results of another study or any other file");
    merge_app->add_flag("--quiet", merge.quiet, "print problems only");
    merge_app->callback([&] { code = merge_command(merge); });

    ReportOptions report;
    add_report(app, report, code);

    RepairOptions repair;
    add_repair(app, repair, code);

    MissesOptions misses;
    add_misses(app, misses, code);

    RareOptions rare;
    add_rare(app, rare, code);

    CompareOptions compare;
    add_compare(app, compare, code);

    DescribeOptions describe;
    auto* describe_app = app.add_subcommand(
        "describe",
        "print a study's settings, the effects simulated and omitted, and the estimated time and "
        "memory of a run; computes for a few seconds and writes nothing");
    add_study(*describe_app, describe.study)->required(false);
    describe_app->add_flag("--keys", describe.keys,
                           "print all keys of study files, or those with a word: describe --keys "
                           "sensor");
    add_number(*describe_app, "--ranks", describe.ranks,
               "also forecast a run with this many MPI ranks: time, memory per rank, disk, and the "
               "number of ranks from which rank 0 limits the speed",
               from_to(1, 1e6));
    add_number(
        *describe_app, "--seconds", describe.seconds,
        "processor seconds of each thread for the description, 10 by default; if they do not "
        "suffice, the forecast is from the number of time steps alone",
        from_to(0.1, 1e5));
    describe_app->callback([&] {
        if (describe.study.path.empty() && !describe.keys) {
            throw CLI::RequiredError("study");
        }
        code = describe_command(describe);
    });

    StiffnessOptions stiffness;
    auto* stiffness_app =
        app.add_subcommand("stiffness", "print the mesh stiffness over one mesh period");
    add_study(*stiffness_app, stiffness.study);
    require_file_name(stiffness_app->add_option(
        "--csv", stiffness.csv, "write the curves to a file, or - for standard output"));
    add_number(*stiffness_app, "--points", stiffness.points, "phases of the curves (default: 1000)",
               from_to(2, 1e6));
    add_force(*stiffness_app, stiffness.force);
    stiffness_app->add_flag(
        "--te", stiffness.te,
        "print the static transmission error under nominal load, including tooth relief, instead "
        "of the stiffness");
    stiffness_app->callback([&] { code = stiffness_command(stiffness); });

    ModesOptions modes;
    auto* modes_app =
        app.add_subcommand("modes", "print the natural frequencies at mean mesh stiffness");
    add_study(*modes_app, modes.study);
    require_file_name(modes_app->add_option("--json", modes.json,
                                            "write JSON to a file, or - for standard output"));
    require_file_name(
        modes_app->add_option("--html", modes.html, "write a page with the Campbell diagram"));
    require_file_name(modes_app->add_option(
        "--figures", modes.figures, "write the figures of the page to a folder, as SVG and PNG"));
    add_force(*modes_app, modes.force);
    modes_app->callback([&] { code = modes_command(modes); });

    AccuracyOptions accuracy;
    auto* accuracy_app = app.add_subcommand(
        "accuracy",
        "compare solver settings for a study: numerical error and computing time of each");
    add_study(*accuracy_app, accuracy.study);
    require_file_name(accuracy_app->add_option("--json", accuracy.json,
                                               "write JSON to a file, or - for standard output"));
    require_file_name(accuracy_app->add_option(
        "--html", accuracy.html, "write a page with work-precision diagrams to a file"));
    require_file_name(accuracy_app->add_option(
        "--figures", accuracy.figures, "write the page's figures into a folder, as SVG and PNG"));
    accuracy_app->add_option("--peers", accuracy.peers,
                             "table (CSV) with results of other programs, for comparison");
    add_number(*accuracy_app, "--repeats", accuracy.repeats,
               "number of timings of each solver setting (default: 3)", from_to(1, 1000));
    add_number(*accuracy_app, "--gearboxes", accuracy.gearboxes,
               "number of gearboxes whose detection rates are compared; 0: none (default: 480, or "
               "as many as the time allows)",
               from_to(0, 1e6));
    add_number(*accuracy_app, "--seconds", accuracy.seconds,
               "processor time after which remaining parts are omitted; 0: no limit (default: 300)",
               from_to(0.0, 1e9, "s"));
    add_force(*accuracy_app, accuracy.force);
    accuracy_app->add_flag("--quiet", accuracy.quiet, "show no progress");
    accuracy_app->callback([&] { code = accuracy_command(accuracy); });

    SimulateOptions simulate;
    auto* simulate_app =
        app.add_subcommand("simulate", "compute the signals and features of one gearbox");
    add_study(*simulate_app, simulate.study);
    add_number(*simulate_app, "--instance", simulate.instance, "row of the results file, from 0")
        ->required();
    require_file_name(
        simulate_app->add_option("--out", simulate.out, "file for the signals, .h5 or .csv"));
    add_number(*simulate_app, "--meshes", simulate.meshes,
               "number of mesh periods (default: one planet turn)", at_least(1));
    add_force(*simulate_app, simulate.force);
    simulate_app->callback([&] { code = simulate_command(simulate); });

    FeaturesOptions features;
    add_features(app, features, code);

    CalibrateOptions calibrate;
    add_calibrate(app, calibrate, code);

    PodOptions pod;
    add_pod(app, pod, code);

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
