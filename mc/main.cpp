#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "analysis/report/text_lines.hpp"
#include "lockstep/kernels/built_kernels.hpp"
#include "mc/commands/commands.hpp"
#include "mc/help/manual.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/results/provenance.hpp"

namespace {

using namespace gearpod::mc;

// Of an option that names a file to write: "" would be no file, or another than the one meant.
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

void add_signal_reading(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor-unit", columns.sensor_unit,
                       "unit of the acceleration where the file says none (default: m/s^2)");
    command.add_option(
        "--tachometer", columns.tachometer,
        "column of a tachometer's pulses, of the member whose speed the study gives");
    command
        .add_option("--pulses-per-turn", columns.pulses_per_turn, "of the tachometer (default: 1)")
        ->check(CLI::Range(1.0, 1e5));
    command
        .add_option_function<std::string>(
            "--speed",
            [&columns](const std::string& value) {
                columns.speed = value == "found"    ? SpeedCheck::follow
                                : value == "stated" ? SpeedCheck::ignore
                                                    : SpeedCheck::refuse;
            },
            "check (default): refuse a speed that the mesh lines do not fit; found: take theirs; "
            "stated: do not look")
        ->check(CLI::IsMember({"check", "found", "stated"}));
}

// Of recordings: which columns, and how often they were sampled.
void add_columns(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor", columns.sensor,
                       "column of the acceleration, m/s^2 (default: sensor)");
    command
        .add_option("--sampling-Hz", columns.sampling_Hz, "sampling rate (default: from the file)")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--samples-per-mesh", columns.samples_per_mesh,
                    "of recordings that were sampled evenly in mesh phase")
        ->check(CLI::Range(2.0, 1e6));
    add_signal_reading(command, columns);
}

void add_features(CLI::App& app, FeaturesOptions& features, int& code) {
    auto* command = app.add_subcommand(
        "features",
        "the features of measured signals (CSV, HDF5, MAT, WAV, universal files), one or many");
    command->add_option(
        "signal", features.signals,
        "signal files (.csv, .h5, .hdf5, .mat, .wav, .uff, .unv), or patterns of their names");
    add_study_keys(*command, features.study);
    command->add_option("--study", features.study.path, "study file (TOML)")->required();
    command->add_option("--manifest", features.manifest,
                        "table (CSV) of recordings: file, row, gearbox, time, label, size, "
                        "conditions");
    add_columns(*command, features.columns);
    command->add_option("--te", features.columns.te,
                        "column of the transmission error, rad (default: te)");
    command
        ->add_option("--healthy", features.healthy,
                     "recording of a healthy gearbox for na4, nb4 and nsds to compare with, as "
                     "often as there are (default: gearboxes simulated from the study)")
        ->allow_extra_args(false);
    needs_name(command->add_option(
        "--baseline", features.baseline,
        "earlier recording of the same gearbox while it was healthy: own_... compare with it, "
        "change_... look at what has changed since"));
    command->add_option("--noise-level", features.noise_level,
                        "noise level of those simulated gearboxes (default: 1)");
    needs_name(command->add_option("--json", features.json,
                                   "of one signal: write JSON to a file, or to -"));
    needs_name(
        command->add_option("--out", features.out, "of many: results file (HDF5) for `report`"));
    needs_name(command->add_option("--csv", features.csv, "of many: table, to a file, or to -"));
    command->add_flag("--quiet", features.quiet, "no progress");
    needs_name(command->add_option("--against", features.against,
                                   "alarm or not, by the healthy gearboxes of a results file"));
    command->add_option("--feature", features.feature,
                        "the feature that decides it (default: the best ranked there)");
    command->callback([&] { code = features_command(features); });
}

void add_calibrate(CLI::App& app, CalibrateOptions& calibrate, int& code) {
    auto* command = app.add_subcommand(
        "calibrate",
        "what tooth errors, background, gain and path exponent make the study's healthy gearboxes "
        "look like measured ones: approximate Bayesian computation on the recordings' features, "
        "with regression adjustment, from draws of stated prior ranges");
    add_study(*command, calibrate.study);
    command->add_option("--healthy", calibrate.healthy,
                        "recordings of healthy gearboxes, each of one of its own (as `features` "
                        "reads them), or patterns of their names");
    command->add_option("--manifest", calibrate.manifest,
                        "table (CSV) of recordings instead, as of `features`; column gearbox says "
                        "which are of the same; faulty lines are left out");
    command->add_option("--features", calibrate.features,
                        "table (CSV) of features instead, as `features --csv` writes it");
    add_columns(*command, calibrate.columns);
    command
        ->add_option(
            "--prior", calibrate.priors,
            "KEY=LOW:HIGH or KEY=LOW:HIGH:log, a random input of the study and the range "
            "that its value is drawn from, evenly or evenly in the logarithm; as often as "
            "there are (default: gearbox.tooth_quality=2:11, or pitch_error_um where the "
            "study has one; sensor.noise_m_s2 from 1 to 105 % of the recordings' rms, log; "
            "sensor.gain=0.05:20:log; sensor.path_exponent=-0.2:0.4)")
        ->allow_extra_args(false);
    command
        ->add_option("--feature", calibrate.feature,
                     "a feature that is compared, as often as there are (default: all of the "
                     "sensor, but for those of sun and ring)")
        ->allow_extra_args(false);
    command
        ->add_option("--draws", calibrate.draws,
                     "draws that are marched in each of two rounds (default: 200); each costs a "
                     "march a gearbox")
        ->check(CLI::Range(50L, 100000L));
    needs_name(command->add_option("--out", calibrate.out,
                                   "study file (TOML) with what was found in [random], or -"));
    needs_name(command->add_option("--json", calibrate.json, "write JSON to a file, or to -"));
    command->add_flag("--quiet", calibrate.quiet, "say nothing of the cost");
    command->callback([&] { code = calibrate_command(calibrate); });
}

void add_pod_data(CLI::App& command, PodOptions& pod) {
    command.add_option("table", pod.table, "table of inspections (CSV), a line each")->required();
    command.add_option("--size", pod.size, "column of the flaw's size; 0: no flaw (default: size)");
    command
        .add_option("--hit", pod.hits,
                    "column of 1 (hit) and 0 (miss) (default: hit); several are repeated "
                    "inspections of the line's specimen")
        ->allow_extra_args(false);
    command
        .add_option("--response", pod.values,
                    "column of the response, a-hat (default: response); several are repeats")
        ->allow_extra_args(false);
    command.add_option("--specimen", pod.specimen,
                       "column that names the specimen (default: each line its own)");
    command.add_option("--threshold", pod.threshold, "decision threshold of responses");
    command
        .add_option("--false-call-rate", pod.false_call_rate,
                    "sets the threshold from the responses of size 0")
        ->check(CLI::Range(1e-6, 0.5));
    command.add_option("--alarm", pod.alarm, "the side that is a hit: high (default) or low")
        ->check(CLI::IsMember({"high", "low"}));
    command.add_option("--left", pod.left, "responses at or below are only known to be so");
    command.add_option("--right", pod.right, "responses at or above are only known to be so");
}

void add_pod(CLI::App& app, PodOptions& pod, int& code) {
    auto* command = app.add_subcommand(
        "pod", "probability of detection from a table of inspections, hit/miss or a-hat against a");
    add_pod_data(*command, pod);
    command->add_option("--link", pod.links, "logit, probit, cloglog, loglog (default: the best)")
        ->check(CLI::IsMember({"logit", "probit", "cloglog", "loglog"}))
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--size-scale", pod.size_scale, "linear or log (default: the better)")
        ->check(CLI::IsMember({"linear", "log"}));
    command->add_option("--response-scale", pod.response_scale,
                        "linear, log, box-cox or a power (default: the better of linear and log)");
    command->add_option("--floor", pod.floor, "POD of the smallest flaws (default: false calls)")
        ->check(CLI::Range(0.0, 0.999));
    command->add_flag("--fit-ceiling", pod.fit_ceiling, "also curves that stay below 1");
    command->add_flag("--firth", pod.firth, "penalised likelihood, where data separate");
    command
        ->add_option("--convention", pod.convention,
                     "of bounds: handbook (default; two-sided for hits, one-sided for responses), "
                     "one-sided, two-sided, joint")
        ->check(CLI::IsMember({"handbook", "one-sided", "two-sided", "joint"}));
    command
        ->add_option("--bounds", pod.bounds,
                     "likelihood-ratio (default for hits) or wald (default for responses)")
        ->check(CLI::IsMember({"likelihood-ratio", "wald"}));
    command->add_option("--confidence", pod.confidence, "of the bounds (default: 0.95)")
        ->check(CLI::Range(0.5, 0.9999));
    command->add_option("--target", pod.target, "size at which a90's bound is wanted")
        ->check(CLI::PositiveNumber);
    needs_name(command->add_option("--json", pod.json, "write JSON to a file, or to -"));
    needs_name(command->add_option("--html", pod.html, "write a page with figures to a file"));
    command->callback([&] { code = pod_command(pod); });
}

void add_compare(CLI::App& app, CompareOptions& compare, int& code) {
    auto* command = app.add_subcommand(
        "compare", "what a change of sensor, feature, noise or design does to detection");
    command->add_option("results", compare.results, "results files (HDF5); held against the first")
        ->required();
    needs_name(command->add_option("--json", compare.json, "write JSON to a file, or to -"));
    needs_name(command->add_option("--html", compare.html, "write a page with figures to a file"));
    command->callback([&] { code = compare_command(compare); });
}

// The command line as a man page and as completion: what installs them calls the program for it.
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
}

// Reports as wide as the terminal that shows them.
void fit_terminal() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        gearpod::analysis::set_text_width(std::min<std::size_t>(size.ws_col, 160));
    }
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
    auto* run_app =
        app.add_subcommand("run", "simulate the whole study and report detection rates");
    add_study(*run_app, run.study);
    add_shorthand(*run_app, "--instances", "ensemble.instances", "gearboxes over all fault sizes",
                  run.study);
    add_shorthand(*run_app, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    needs_name(
        run_app->add_option("--out", run.out, "results file (default: the study's name with .h5)"));
    run_app->add_flag("--resume", run.resume,
                      "continue an interrupted run, or add gearboxes to a finished one");
    run_app->add_flag("--force", run.force,
                      "overwrite the results of another study, or a file that is none; start "
                      "although the memory will not suffice");
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
    needs_name(report_app->add_option("--json", report.json,
                                      "write JSON to a file, or to - for the terminal"));
    needs_name(
        report_app->add_option("--html", report.html, "write a page with figures to a file"));
    needs_name(report_app->add_option("--csv", report.csv, "write every table into a folder"));
    needs_name(report_app->add_option("--figures", report.figures,
                                      "write the page's figures into a folder, as SVG and PNG"));
    report_app->add_option(
        "--by", report.condition,
        "random input, e.g. torque_N_m, whose values get thresholds of their own");
    report_app->callback([&] { code = report_command(report); });

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
                     "gearboxes whose detection rates are compared; 0 for none")
        ->check(CLI::Range(0L, 1000000L));
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
        // A program that was built for another processor would end in an illegal instruction.
        gearpod::lockstep::choose_instruction_set({});
        fit_terminal();
        const int code = run_program(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            fmt::print(stderr, "gearpod: standard output cannot be written\n");
            return kBadInput;
        }
        return code;
    } catch (const std::exception& error) {
        // The command and what it was given, where no command has found words of its own.
        std::string call = "gearpod";
        for (int i = 1; i < std::min(argc, 3); ++i) {
            call += std::string(" ") + argv[i];
        }
        fmt::print(stderr, "{}: {}\n", printable(call), exception_text(error));
        return kBadInput;
    }
}
