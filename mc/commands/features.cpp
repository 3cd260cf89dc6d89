// Command `features SIGNAL --study STUDY`: features of one measured signal.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/signal_features.hpp"
#include "mc/recordings/measure_recordings.hpp"
#include "mc/recordings/population.hpp"
#include "mc/recordings/recording_baselines.hpp"

namespace gearpod::mc {
namespace {

struct FeaturesOptions {
    StudyOptions study;
    std::vector<std::string> signals;  // files, or glob patterns
    std::string manifest;              // table of recordings, instead of signals
    SignalColumns columns;
    std::vector<std::string> healthy;  // recordings of healthy gearboxes
    std::string baseline;              // earlier recording of the same gearbox, "": none
    // Baselines of many recordings; average 0: monitoring.average_records.
    BaselineOptions baselines{0, {}, false, 0};
    double noise_level = 1.0;  // of simulated healthy gearboxes, used without `healthy`
    std::string json;          // "": none; "-": standard output
    std::string out, csv;      // results file and table, for many recordings
    std::string against;       // results file of healthy gearboxes to compare with
    std::string feature;       // decides the alarm; "": the best ranked one in `against`
    bool force = false;        // replaces outputs of another kind
    bool quiet = false;
};

// Writes the features of many recordings to a results file and a table. Returns the exit code.
int recordings_command(const FeaturesOptions& options);

constexpr std::size_t kMissingColumn = 38;  // of the reasons why features are missing

void print_text(const SignalFeatures& found) {
    const MeasuredSignal& signal = found.signal;
    const std::vector<MeasuredFeature>& all = found.measured.features;
    fmt::print("{}\n", wrapped_text("mesh phase: " + signal.tracking, 2));
    fmt::print("mesh periods: {} of acceleration, {} of transmission error (full span: {})\n",
               signal.sensor_meshes, signal.te_meshes, found.span.meshes());
    if (const int turns = found.planet_turns(); turns > 0 && turns < found.span.ring_teeth) {
        fmt::print("planet turns: {} (full span: {})\n", turns, found.span.ring_teeth);
    }
    if (const auto& change = found.measured.change) {
        fmt::print(
            "baseline: {} planet turns, shifted by {:.2f} mesh periods; correlation {:.3f}\n",
            change->signal.planet_turns(found.span), change->meshes, change->correlation);
    }
    if (!signal.losses_detectable) {
        fmt::print(
            "lost samples cannot be detected: that needs six similar turns of the carrier or\n"
            "wheel\n");
    }
    for (const std::string& note : found.notes) {
        fmt::print("{}\n", wrapped_text("note: " + note, 2));
    }
    for (const MeasuredFeature& measured : all) {
        if (measured.missing.empty()) {
            fmt::print("{:<22}{:>14.8g}  {}\n", measured.feature->name, measured.value,
                       measured.feature->unit == "1" ? "" : measured.feature->unit);
        }
    }
    for (const MeasuredFeature& measured : all) {
        if (!measured.missing.empty()) {
            fmt::print("{:<22}{:>14}  {}\n", measured.feature->name, "-",
                       wrapped_text(measured.missing, kMissingColumn));
        }
    }
}

std::string decisions_text(const PopulationDecisions& decided) {
    std::string text = fmt::format("\n{:<22}{:>13}{:>13}{:>8}{:>24}\n", "feature", "value",
                                   "threshold", "", "healthy less extreme");
    for (const AlarmDecision& decision : decided.decisions) {
        text += fmt::format("{:<22}{:>13.6g}{:>13.6g}{:>8}{:>14} of {}\n",
                            decision.population->name, decision.value,
                            decision.population->threshold, decision.alarm ? "ALARM" : "",
                            decision.less_extreme, decision.population->healthy.size());
    }
    text += "\n" + wrapped_text(decided.sentence, 0) + "\n";
    return text;
}

int features_command(const FeaturesOptions& options) {
    if (options.against.empty() && !options.feature.empty()) {
        fmt::print(stderr, "--feature {}: is only used with --against\n", options.feature);
        return kBadInput;
    }
    const bool many = options.signals.size() != 1 || !options.manifest.empty() ||
                      !options.out.empty() || !options.csv.empty();
    if (many) {
        return recordings_command(options);
    }
    if (options.baselines.records > 0 || options.baselines.average != 0 ||
        !options.baselines.conditions.empty() || options.baselines.scaled) {
        fmt::print(stderr,
                   "--baseline-records, --baseline-by, --baseline-scale, --average: are only used "
                   "with many signals (--manifest)\n");
        return kBadInput;
    }
    std::vector<FileRole> read{{"the study", options.study.path},
                               {"the signal", options.signals.front()}};
    for (const std::string& path : options.healthy) {
        read.push_back({"a recording of --healthy", path});
    }
    read.push_back({"the file of --against", options.against});
    read.push_back({"the recording of --baseline", options.baseline});
    const bool writable = can_write({"--json", options.json}, read, {json_output(), options.force});
    SignalRequest request;
    request.signal = options.signals.front();
    request.columns = options.columns;
    check_columns(request.signal, request.columns);  // preparing the study may take long
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    request.healthy = {options.healthy.begin(), options.healthy.end()};
    request.baseline = options.baseline;
    request.noise_level = options.noise_level;
    request.against = options.against;
    request.feature = options.feature;
    const SignalFeatures found = signal_features(request, scene->tile());
    if (!options.json.empty()) {
        const std::string text = json_text(signal_features_json(found, request), 2);
        return write_text_to(options.json, text + "\n") ? kDone : kBadInput;
    }
    print_text(found);
    if (found.against) {
        fmt::print("{}", decisions_text(found.against->decided));
    }
    return kDone;
}

Problems option_problems(const FeaturesOptions& options) {
    Problems problems;
    const auto reject = [&](const char* what, const char* remedy) {
        problems.push_back({"features", 0, "", what, remedy});
    };
    if (options.manifest.empty() == options.signals.empty()) {
        reject(options.manifest.empty() ? "no signal is given"
                                        : "signals and --manifest are both given",
               "give either signal files or --manifest");
    }
    if (!options.json.empty()) {
        reject("--json is only for one signal",
               "for many signals give --out, and make JSON from it with `report --json`");
    }
    if (options.out.empty() && options.csv.empty() && options.against.empty()) {
        reject("no output is given for many signals",
               "give --out F.h5, --csv T.csv, or --against F.h5");
    }
    return problems;
}

bool can_write_all(const FeaturesOptions& options, const RecordingList& list) {
    std::vector<FileRole> read{{"the study", options.study.path}};
    if (!options.manifest.empty()) {
        read.push_back({"the manifest", options.manifest});
    }
    read.push_back({"the file of --against", options.against});
    read.push_back({"the recording of --baseline", options.baseline});
    std::string last;
    for (const Recording& recording : list.recordings) {
        if (recording.file != last) {
            read.push_back({"a recording", recording.file});
            last = recording.file;
        }
    }
    const bool out_good =
        can_write({"--out", options.out}, read, {recordings_output(), options.force});
    read.push_back({"--out", options.out.empty() ? "-" : options.out});
    return can_write({"--csv", options.csv}, read,
                     {text_output("a table of `features` (CSV)", "file,row,gearbox,label"),
                      options.force}) &&
           out_good;
}

void print_decisions(const FeaturesOptions& options, const Population& population,
                     std::span<const features::Feature* const> features, const RecordingList& list,
                     const std::vector<MeasuredRecording>& measured) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured[i].problem.empty()) {
            const PopulationDecisions decided =
                decide(population, list.recordings[i].name(), features, measured[i].values,
                       options.feature, measured[i].teeth);
            fmt::print("{}\n", wrapped_text(decided.sentence, 2));
        }
    }
}

// Prints the recordings without features and the files written. Returns the exit code.
int summary(const FeaturesOptions& options, const std::vector<MeasuredRecording>& measured) {
    const auto bad = std::ranges::count_if(
        measured, [](const MeasuredRecording& recording) { return !recording.problem.empty(); });
    for (const MeasuredRecording& recording : measured) {
        if (!recording.problem.empty()) {
            fmt::print(stderr, "{}\n", printable(recording.problem));
        }
    }
    if (!options.quiet && options.csv != "-") {
        fmt::print("recordings: {} of {} have features\n",
                   static_cast<std::ptrdiff_t>(measured.size()) - bad, measured.size());
        for (const std::string& path : {options.out, options.csv}) {
            if (!path.empty()) {
                fmt::print("written: {}\n", path);
            }
        }
    }
    return bad > 0 ? kSomeFailed : kDone;
}

int recordings_command(const FeaturesOptions& options) {
    Problems problems = option_problems(options);
    RecordingList list;
    if (problems.empty()) {
        list = list_of(options.manifest, options.signals, problems);
    }
    if (!options.out.empty()) {
        for (Problem& problem : condition_name_problems(options.manifest, list)) {
            problems.push_back(std::move(problem));
        }
    }
    if (!problems.empty()) {
        print_problems(problems);
        return kBadInput;
    }
    const bool writable = can_write_all(options, list);
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    RecordingComparison comparison{nullptr, options.baselines};
    if (comparison.options.average == 0) {
        comparison.options.average = scene->features().average_recordings;
    }
    problems =
        baseline_problems(comparison.options, list, options.manifest, !options.baseline.empty());
    if (!problems.empty()) {
        print_problems(problems);
        return kBadInput;
    }
    const MeasurementPlan plan{scene->record(), scene->features(), scene->gearbox().nominal};
    std::optional<Population> population;
    if (!options.against.empty()) {
        population = read_population(options.against, options.noise_level, plan.features.teeth);
    }
    std::vector<std::string> notes;
    const HealthyReference healthy =
        options.healthy.empty()
            ? HealthyReference()
            : measured_reference({options.healthy.begin(), options.healthy.end()}, options.columns,
                                 plan, 1, notes);
    const auto baseline = measured_baseline(options.baseline, options.columns, plan);
    if (baseline) {
        add_notes(baseline->signal, baseline->file, notes);
    }
    for (const std::string& note : notes) {
        fmt::print(stderr, "{}\n", wrapped_text("note: " + note, 2));
    }
    comparison.given = baseline ? &*baseline : nullptr;
    const bool compared = comparison.any(list);
    const auto features = measurable(plan.features, compared);
    const int threads = thread_count(scene->ensemble());
    Progress progress(static_cast<long>(list.recordings.size()),
                      options.quiet || options.csv == "-", 0, Progress::Form::text, "recordings");
    const auto [measured, baseline_notes] = measure_recordings(
        list, options.columns, plan, healthy, comparison, threads, [&] { progress.advance(1); });
    progress.finish();
    for (const std::string& note : baseline_notes) {
        fmt::print(stderr, "{}\n", wrapped_text("note: " + printable(note), 2));
    }
    print_notes(list, measured);
    const bool csv_good =
        options.csv.empty() ||
        write_text_to(options.csv, recordings_csv(list, measured, features, compared));
    if (!options.out.empty()) {
        write_results(options.out, recordings_results(list, measured, features, compared,
                                                      scene->ensemble(), threads));
    }
    if (population) {
        print_decisions(options, *population, features, list, measured);
    }
    return csv_good ? summary(options, measured) : kBadInput;
}

}  // namespace

void add_features(CLI::App& app, int& code) {
    const auto [command, options] = add_command<FeaturesOptions>(
        app, code, "features",
        "compute the features of measured signals (CSV, HDF5, MAT, TDMS, sound, universal files)",
        reporting<features_command>);
    command.add_option("signal", options.signals,
                       "signal files (.csv, .h5, .hdf5, .mat, .tdms, .uff, .wav and others), or "
                       "name patterns with "
                       "* and ?");
    add_study_keys(command, options.study);
    command.add_option("--study", options.study.path, "study file (TOML)")->required();
    command.add_option("--manifest", options.manifest,
                       "table (CSV) of recordings with columns file, row, gearbox, time, label, "
                       "size, and operating conditions");
    add_columns(command, options.columns);
    command.add_option("--te", options.columns.te,
                       "column of the transmission error, rad (default: te)");
    command
        .add_option("--healthy", options.healthy,
                    "recording of a healthy gearbox, the reference of na4; may be repeated "
                    "(default: gearboxes simulated from the study)")
        ->allow_extra_args(false)
        ->option_text("FILE");  // one for each --healthy, because the signals are files, too
    add_file(
        command, "--baseline", options.baseline,
        "earlier recording of the same gearbox in healthy condition, the reference of own_... and "
        "change_... features");
    add_number(command, "--baseline-records", options.baselines.records,
               "instead, many signals: the baseline of each gearbox is the mean of its first N "
               "healthy recordings, aligned by circular correlation (or of those with yes in the "
               "manifest's column baseline)",
               from_to(1, 1000000));
    command
        .add_option("--baseline-by", options.baselines.conditions,
                    "operating condition of the manifest; recordings with equal values share a "
                    "baseline; may be repeated")
        ->allow_extra_args(false)
        ->type_name("COLUMN");
    command
        .add_option_function<std::string>(
            "--baseline-scale",
            [&baselines = options.baselines](const std::string& value) {
                baselines.scaled = value == "fit";
            },
            "fit: scale the baseline to each recording before it is subtracted (least squares), so "
            "that a drifting gain leaves no change; the part of a fault that resembles the "
            "baseline is then lost, too (default: none)")
        ->check(CLI::IsMember({"none", "fit"}));
    add_number(command, "--average", options.baselines.average,
               "number of consecutive recordings of a gearbox, aligned with its baseline, that are "
               "averaged before features (default: monitoring.average_records)",
               from_to(1, 1000));
    add_number(command, "--noise-level", options.noise_level,
               "noise level of the simulated gearboxes (default: 1)", at_least(0.0));
    add_file(command, "--json", options.json,
             "one signal: write JSON to a file, or - for standard output");
    add_file(command, "--out", options.out,
             "many signals: write a results file (HDF5) for `report`");
    add_file(command, "--csv", options.csv,
             "many signals: write a table to a file, or - for standard output");
    command.add_flag("--quiet", options.quiet, "show no progress");
    add_file(command, "--against", options.against,
             "results file of healthy gearboxes; decide with its threshold: alarm or not");
    command.add_option("--feature", options.feature,
                       "feature that decides the alarm (default: the best ranked in the "
                       "results file)");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
