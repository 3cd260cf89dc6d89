#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "mc/help/manual.hpp"
#include "mc/help/reference.hpp"
#include "mc/options/options.hpp"
#include "mc/options/program.hpp"
#include "mc/results/provenance.hpp"

namespace {

using namespace gearpod::mc;

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
        "print bash's completion (source <(gearpod --completion))");
    app.add_flag_callback(
        "--reference", [&app, print] { print(reference_json(app, version_text())); },
        "print commands, study keys, distributions and features as JSON");
}

int run_program(int argc, char** argv) {
    CLI::App app{
        "gearpod: which gear-tooth crack would a sensor, a feature and a threshold have "
        "found, and how surely?"};
    app.set_version_flag("--version", build_text(), "version, and what the program was built with");
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
        "merge", "one results file from those of a study's parts, as one run writes it");
    merge_app->add_option("results", merge.results, "results files of run --part 1/N to N/N")
        ->required();
    needs_name(merge_app->add_option("--out", merge.out, "results file")->required());
    merge_app->add_flag("--force", merge.force,
                        "overwrite the results of another study, or a file that is none");
    merge_app->add_flag("--quiet", merge.quiet, "print nothing but problems");
    merge_app->callback([&] { code = merge_command(merge); });

    ReportOptions report;
    add_report(app, report, code);

    MissesOptions misses;
    add_misses(app, misses, code);

    RareOptions rare;
    add_rare(app, rare, code);

    CompareOptions compare;
    add_compare(app, compare, code);

    DescribeOptions describe;
    auto* describe_app = app.add_subcommand(
        "describe",
        "what a study would simulate, and what a run would take: computes some gearboxes "
        "for a few seconds, writes nothing");
    add_study(*describe_app, describe.study)->required(false);
    describe_app->add_flag("--keys", describe.keys,
                           "all keys of study files, or those with a word: describe --keys sensor");
    describe_app
        ->add_option("--ranks", describe.ranks,
                     "also what a run of so many ranks takes: time, memory of each, disk, and from "
                     "how many on the first one holds the others up")
        ->check(CLI::Range(1, 1000000));
    describe_app->callback([&] {
        if (describe.study.path.empty() && !describe.keys) {
            throw CLI::RequiredError("study");
        }
        code = describe_command(describe);
    });

    StiffnessOptions stiffness;
    auto* stiffness_app = app.add_subcommand("stiffness", "mesh stiffness over one mesh period");
    add_study(*stiffness_app, stiffness.study);
    needs_name(
        stiffness_app->add_option("--csv", stiffness.csv, "write curves to a file, or to -"));
    stiffness_app->add_option("--points", stiffness.points, "phases in the table")
        ->check(CLI::Range(2, 1000000));
    stiffness_app->add_flag(
        "--te", stiffness.te,
        "static transmission error of the meshes under the nominal load, relief "
        "included, in place of their stiffness");
    stiffness_app->callback([&] { code = stiffness_command(stiffness); });

    ModesOptions modes;
    auto* modes_app = app.add_subcommand("modes", "natural frequencies at mean mesh stiffness");
    add_study(*modes_app, modes.study);
    needs_name(modes_app->add_option("--json", modes.json, "write JSON to a file, or to -"));
    modes_app->callback([&] { code = modes_command(modes); });

    AccuracyOptions accuracy;
    auto* accuracy_app = app.add_subcommand(
        "accuracy", "what accuracy costs: every way to march a study, its time and its error");
    add_study(*accuracy_app, accuracy.study);
    needs_name(accuracy_app->add_option("--json", accuracy.json, "write JSON to a file, or to -"));
    accuracy_app->add_option("--peers", accuracy.peers,
                             "table (CSV) of other programs' results to show beside ours");
    accuracy_app->add_option("--repeats", accuracy.repeats, "how often every rung is timed")
        ->check(CLI::Range(1, 1000));
    accuracy_app
        ->add_option("--gearboxes", accuracy.gearboxes,
                     "gearboxes whose detection rates are compared, 0 for none; by default 480, or "
                     "as many as the time allows")
        ->check(CLI::Range(0L, 1000000L));
    accuracy_app
        ->add_option("--seconds", accuracy.seconds,
                     "processor seconds after which no part is begun, and said to be left out; 0: "
                     "as long as it takes")
        ->check(CLI::Range(0.0, 1e9));
    accuracy_app->add_flag("--quiet", accuracy.quiet, "no progress");
    accuracy_app->callback([&] { code = accuracy_command(accuracy); });

    SimulateOptions simulate;
    auto* simulate_app = app.add_subcommand("simulate", "one gearbox's signals and features");
    add_study(*simulate_app, simulate.study);
    simulate_app->add_option("--instance", simulate.instance, "row of the results file, from 0")
        ->required();
    needs_name(simulate_app->add_option("--out", simulate.out, "signals as .h5 or .csv"));
    simulate_app
        ->add_option("--meshes", simulate.meshes, "mesh periods to write (default: a planet turn)")
        ->check(CLI::PositiveNumber);
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
    return run_safely(argc, argv, run_program);
}
