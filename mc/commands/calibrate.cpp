// Command `calibrate STUDY --healthy REC...`: finds the inputs with which simulated healthy
// gearboxes match measured ones.
#include "mc/recordings/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/recordings/measure_recordings.hpp"

namespace gearpod::mc {
namespace {

struct CalibrateOptions {
    StudyOptions study;
    std::vector<std::string> healthy;  // files, or glob patterns
    std::string manifest;              // table of recordings, instead of `healthy`
    std::string features;              // table of features, instead of `healthy`
    SignalColumns columns;
    std::vector<std::string> priors;   // KEY=LOW:HIGH[:log]; empty: the default priors
    std::vector<std::string> feature;  // features to compare; empty: all
    long sets = 200;                   // parameter sets integrated in each round
    std::string out, json;
    bool force = false;  // replaces outputs of another kind
    bool quiet = false;
};

// Keeps the recordings labelled healthy, or all recordings if none has a label.
void keep_healthy(RecordingList& list) {
    const bool labelled = std::ranges::any_of(list.recordings, [](const Recording& recording) {
        return recording.condition != Condition::unknown;
    });
    std::erase_if(list.recordings, [&](const Recording& recording) {
        return labelled && recording.condition != Condition::healthy;
    });
}

// Computes the features of the recordings. Adds a problem for each recording that cannot be read.
std::vector<HealthyRecord> measured_records(const CalibrateOptions& options,
                                            const RecordingList& list, const MeasurementPlan& plan,
                                            int threads, Problems& problems) {
    const auto measured =
        measure_recordings(list, options.columns, plan, {}, {}, threads, [] {}).recordings;
    print_notes(list, measured);
    std::vector<HealthyRecord> records;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (!measured[i].problem.empty()) {
            problems.push_back({printable(measured[i].problem), 0, "", "", ""});
            continue;
        }
        records.push_back({list.recordings[i].gearbox,
                           std::min(measured[i].sensor_meshes, plan.record.span.meshes()),
                           measured[i].values});
    }
    return records;
}

// Priors and recordings that the options name. Prints problems and returns false if there are any.
bool read_sources(const CalibrateOptions& options, std::vector<CalibratedInput>& inputs,
                  RecordingList& list) {
    Problems problems;
    const int sources = int{!options.healthy.empty()} + int{!options.manifest.empty()} +
                        int{!options.features.empty()};
    if (sources != 1) {
        problems.push_back({"calibrate", 0, "",
                            sources == 0 ? "no recordings" : "more than one source of recordings",
                            "give one of --healthy REC..., --manifest T.csv, --features T.csv"});
    }
    inputs = read_priors(options.priors, problems);
    // Preparing the study may take long, so that columns are checked before.
    if (sources == 1 && !options.features.empty()) {
        check_feature_table(options.features, options.feature, problems);
    } else if (sources == 1) {
        list = list_of(options.manifest, options.healthy, problems);
        keep_healthy(list);
        for (const Recording& recording : list.recordings) {
            SignalColumns columns = options.columns;
            columns.row = recording.row;
            try {
                check_columns(recording.file, columns);
            } catch (const SignalError& error) {
                problems.push_back({printable(error.what()), 0, "", "", ""});
            }
        }
    }
    print_problems(problems);
    return problems.empty();
}

bool can_write_outputs(const CalibrateOptions& options, const RecordingList& list) {
    std::vector<FileRole> read{{"the study", options.study.path},
                               {"the manifest", options.manifest},
                               {"the table of --features", options.features}};
    std::erase_if(read, [](const FileRole& file) { return file.path.empty(); });
    for (const Recording& recording : list.recordings) {
        read.push_back({"a recording", recording.file});
    }
    const bool good = can_write({"--out", options.out}, read,
                                {text_output("a calibrated study", "# Calibrated"), options.force});
    read.push_back({"--out", options.out.empty() ? "-" : options.out});
    return can_write({"--json", options.json}, read, {json_output(), options.force}) && good;
}

// Features of the healthy gearboxes, and the default priors if the options name none.
HealthySet measured_set(const CalibrateOptions& options, const Scene& scene,
                        const CalibrationPlan& calibration, const RecordingList& list, int threads,
                        std::vector<CalibratedInput>& inputs, Problems& problems) {
    const MeasurementPlan plan{scene.record(), scene.features(), scene.gearbox().nominal};
    const std::vector<HealthyRecord> records =
        options.features.empty() ? measured_records(options, list, plan, threads, problems)
                                 : read_feature_table(options.features, plan.record.span, problems);
    if (records.empty() && problems.empty()) {
        problems.push_back({"calibrate", 0, "", "no recording of a healthy gearbox",
                            "check the labels and sizes of the recordings"});
    }
    if (!problems.empty()) {
        return {};
    }
    HealthySet set = healthy_set(records, options.feature, problems);
    const double rms = set.mean_of("sensor_rms");
    if (inputs.empty() && rms > 0.0) {
        inputs = calibration.default_inputs(rms);
    } else if (inputs.empty() && problems.empty()) {
        problems.push_back({"calibrate", 0, "",
                            "the default prior of the background noise needs the feature "
                            "sensor_rms",
                            "give --prior sensor.noise_m_s2=LOW:HIGH:log and the other priors"});
    }
    return set;
}

int fit(const CalibrateOptions& options, const std::vector<CalibratedInput>& inputs,
        const HealthySet& set, int threads) {
    StudyOptions random = options.study;
    for (const CalibratedInput& input : inputs) {
        random.overrides.push_back(input.as_override());
    }
    // Random tooth errors change the default values of other keys, so the study is read again.
    const StudyReading written = read_study(random.path, random.overrides);
    if (!written.study) {
        print_problems(written.problems);
        return kBadInput;
    }
    // An override of features.use would make the keys of a baseline record invalid.
    StudyReading simulated = written;
    simulated.study->features.use.clear();
    for (const features::Feature* feature : set.features) {
        simulated.study->features.use.emplace_back(feature->name);
    }
    const StudyScene made = make_scene(random.path, std::move(simulated));
    if (!made) {
        print_problems(made.problems);
        return kBadInput;
    }
    check_calibration_python();
    const CalibrationTask task{.inputs = inputs,
                               .measured = set,
                               .integrated = static_cast<std::size_t>(options.sets),
                               .study = text_without_distributions(*written.study, inputs),
                               .seed = made.scene->draw().seed};
    if (!options.quiet) {
        fmt::print(stderr,
                   "{} record(s) of {} gearbox(es){}\n{} rounds of {} parameter sets, {} "
                   "gearboxes, {} noise realizations each\n",
                   set.records, set.lengths.size(),
                   set.left_out > 0 ? fmt::format(", {} more ignored", set.left_out) : "",
                   kCalibrationRounds, task.integrated, task.integrated * set.lengths.size(),
                   task.backgrounds);
    }
    const auto report_time = [&](double seconds) {
        if (!options.quiet) {
            fmt::print(stderr,
                       "this round: about {:.0f} s of processor time, {:.0f} s on {} thread(s)\n",
                       seconds, seconds / threads, threads);
        }
    };
    std::vector<SimulatedSet> first;
    const CalibrationResult result =
        calibrate(task, first, [&](const PriorRegion& region, const SetPlan& plan) {
            return simulate_sets(made.scene->tile(), inputs, region, plan, set.lengths,
                                 set.features, threads, report_time);
        });
    if (options.json != "-" && options.out != "-") {
        fmt::print("{}", result.text);
    }
    const bool out = options.out.empty() || write_text_to(options.out, result.study);
    const bool json =
        options.json.empty() || write_text_to(options.json, json_text(result.json, 2) + "\n");
    return out && json ? kDone : kBadInput;
}

int calibrate_command(const CalibrateOptions& options) {
    std::vector<CalibratedInput> inputs;
    RecordingList list;
    if (!read_sources(options, inputs, list)) {
        return kBadInput;
    }
    StudyReading reading = read_study(options.study.path, options.study.overrides);
    CalibrationPlan calibration;
    if (reading.study) {
        calibration = make_calibration_plan(*reading.study, options.study.path);
    }
    const StudyScene made = make_scene(options.study.path, std::move(reading));
    print_problems(made ? made.notices : made.problems);
    if (!made || !can_write_outputs(options, list)) {
        return kBadInput;
    }
    const int threads = thread_count(made.scene->ensemble());
    Problems problems = calibration.unsupported;
    HealthySet set;
    if (problems.empty()) {
        set = measured_set(options, *made.scene, calibration, list, threads, inputs, problems);
    }
    print_problems(problems);
    return problems.empty() ? fit(options, inputs, set, threads) : kBadInput;
}

}  // namespace

void add_calibrate(CLI::App& app, int& code) {
    const auto [command, options] = add_command<CalibrateOptions>(
        app, code, "calibrate",
        "fit tooth errors, background noise, tones, gain and path exponent of a study to "
        "recordings of healthy gearboxes: approximate Bayesian computation with regression "
        "adjustment",
        reporting<calibrate_command>);
    add_study(command, options.study);
    command
        .add_option("--healthy", options.healthy,
                    "recordings of healthy gearboxes, each of a different gearbox, or name "
                    "patterns; same formats as for `features`")
        ->allow_extra_args(false);
    command.add_option("--manifest", options.manifest,
                       "instead: table (CSV) of recordings as for `features`; column gearbox "
                       "names the gearbox; faulty recordings are ignored");
    command.add_option("--features", options.features,
                       "instead: table (CSV) of features as written by `features --csv`");
    add_columns(command, options.columns);
    command
        .add_option(
            "--prior", options.priors,
            "KEY=LOW:HIGH or KEY=LOW:HIGH:log: uniform or log-uniform prior of a study key; may "
            "be repeated (default: gearbox.tooth_quality=2:11, or pitch_error_um if the study has "
            "it; sensor.noise_m_s2 or its density, 1 to 105 % of the recordings' rms, log; "
            "sensor.gain=0.05:20:log; sensor.path_exponent=-0.2:0.4; with tones "
            "sensor.tone_level=0.01:20:log)")
        ->type_name("KEY=LOW:HIGH")
        ->allow_extra_args(false);
    command
        .add_option("--feature", options.feature,
                    "feature to compare; may be repeated (default: all features of the "
                    "acceleration except those of sun and ring and those that transform the "
                    "whole record)")
        ->allow_extra_args(false);
    add_number(command, "--draws", options.sets,
               "parameter sets simulated in each of two rounds (default: 200); each set integrates "
               "every gearbox once",
               from_to(50, 10000));
    add_file(command, "--out", options.out,
             "write a study file (TOML) with the calibrated inputs in "
             "[random], or - for standard output");
    add_json(command, options.json);
    command.add_flag("--quiet", options.quiet, "do not print the computing time");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
