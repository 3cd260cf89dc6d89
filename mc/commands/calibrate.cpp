// Command `calibrate STUDY --healthy REC...`: finds the inputs with which simulated healthy
// gearboxes match measured ones.
#include "mc/recordings/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
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

class Command {
  public:
    explicit Command(const CalibrateOptions& options) : options_(options) {}

    int run() {
        if (!options_good()) {
            return kBadInput;
        }
        StudyReading reading = read_study(options_.study.path, options_.study.overrides);
        CalibrationPlan calibration;
        if (reading.study) {
            calibration = make_calibration_plan(*reading.study, options_.study.path);
        }
        const StudyScene made = make_scene(options_.study.path, std::move(reading));
        print_problems(made ? made.notices : made.problems);
        const auto& scene = made.scene;
        if (!scene || !outputs_good()) {
            return kBadInput;
        }
        problems_ = calibration.unsupported;
        if (!problems_.empty()) {
            return stop();
        }
        const int threads = thread_count(scene->ensemble());
        const MeasurementPlan plan{scene->record(), scene->features(), scene->gearbox().nominal};
        const std::vector<HealthyRecord> records =
            options_.features.empty()
                ? measured_records(options_, list_, plan, threads, problems_)
                : read_feature_table(options_.features, plan.record.span, problems_);
        if (records.empty() && problems_.empty()) {
            problems_.push_back({"calibrate", 0, "", "no recording of a healthy gearbox",
                                 "check the labels and sizes of the recordings"});
        }
        if (!problems_.empty()) {
            return stop();
        }
        set_ = healthy_set(records, options_.feature, problems_);
        const double rms = set_.mean_of("sensor_rms");
        if (inputs_.empty() && rms > 0.0) {
            inputs_ = calibration.default_inputs(rms);
        } else if (inputs_.empty() && problems_.empty()) {
            problems_.push_back({"calibrate", 0, "",
                                 "the default prior of the background noise needs the feature "
                                 "sensor_rms",
                                 "give --prior sensor.noise_m_s2=LOW:HIGH:log and the other "
                                 "priors"});
        }
        return problems_.empty() ? calibrated(threads) : stop();
    }

  private:
    int stop() const {
        print_problems(problems_);
        return kBadInput;
    }

    bool options_good() {
        const int sources = static_cast<int>(!options_.healthy.empty()) +
                            static_cast<int>(!options_.manifest.empty()) +
                            static_cast<int>(!options_.features.empty());
        if (sources != 1) {
            problems_.push_back(
                {"calibrate", 0, "",
                 sources == 0 ? "no recordings" : "more than one source of recordings",
                 "give one of --healthy REC..., --manifest T.csv, --features T.csv"});
        }
        inputs_ = read_priors(options_.priors, problems_);
        if (sources == 1) {
            try {
                if (!options_.features.empty()) {
                    check_feature_table(options_.features, options_.feature, problems_);
                    return stop_or_go();
                }
                list_ = options_.manifest.empty() ? recordings_of(options_.healthy, problems_)
                                                  : read_manifest(options_.manifest, problems_);
                keep_healthy(list_);
                check_recordings();
            } catch (const SignalError& error) {
                problems_.push_back({printable(error.what()), 0, "", "", ""});
            }
        }
        return stop_or_go();
    }

    bool stop_or_go() {
        print_problems(problems_);
        return std::exchange(problems_, {}).empty();
    }

    // Preparing the study may take long, so that columns are checked before.
    void check_recordings() {
        for (const Recording& recording : list_.recordings) {
            SignalColumns columns = options_.columns;
            columns.row = recording.row;
            try {
                check_columns(recording.file, columns);
            } catch (const SignalError& error) {
                problems_.push_back({printable(error.what()), 0, "", "", ""});
            }
        }
    }

    bool outputs_good() const {
        std::vector<FileRole> read{{"the study", options_.study.path},
                                   {"the manifest", options_.manifest},
                                   {"the table of --features", options_.features}};
        std::erase_if(read, [](const FileRole& file) { return file.path.empty(); });
        for (const Recording& recording : list_.recordings) {
            read.push_back({"a recording", recording.file});
        }
        const bool good =
            can_write({"--out", options_.out}, read,
                      {text_output("a calibrated study", "# Calibrated"), options_.force});
        read.push_back({"--out", options_.out.empty() ? "-" : options_.out});
        return can_write({"--json", options_.json}, read, {json_output(), options_.force}) && good;
    }

    int calibrated(int threads) {
        StudyOptions random = options_.study;
        for (const CalibratedInput& input : inputs_) {
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
        for (const features::Feature* feature : set_.features) {
            simulated.study->features.use.emplace_back(feature->name);
        }
        const StudyScene made = make_scene(random.path, std::move(simulated));
        const auto& scene = made.scene;
        if (!scene) {
            print_problems(made.problems);
            return kBadInput;
        }
        check_calibration_python();
        const CalibrationTask task{.inputs = inputs_,
                                   .measured = set_,
                                   .integrated = static_cast<std::size_t>(options_.sets),
                                   .study = text_without_distributions(*written.study, inputs_),
                                   .seed = scene->draw().seed};
        std::vector<SimulatedSet> first;
        print_cost_of_rounds(task);
        const auto report_time = [&](double seconds) {
            if (!options_.quiet) {
                fmt::print(
                    stderr,
                    "this round: about {:.0f} s of processor time, {:.0f} s on {} thread(s)\n",
                    seconds, seconds / threads, threads);
            }
        };
        return finish(calibrate(task, first, [&](const PriorRegion& region, const SetPlan& plan) {
            return simulate_sets(scene->tile(), inputs_, region, plan, set_.lengths, set_.features,
                                 threads, report_time);
        }));
    }

    void print_cost_of_rounds(const CalibrationTask& task) const {
        if (!options_.quiet) {
            fmt::print(stderr,
                       "{} record(s) of {} gearbox(es){}\n{} rounds of {} parameter sets, {} "
                       "gearboxes, {} noise realizations each\n",
                       set_.records, set_.lengths.size(),
                       set_.left_out > 0 ? fmt::format(", {} more ignored", set_.left_out) : "",
                       kCalibrationRounds, task.integrated, task.integrated * set_.lengths.size(),
                       task.backgrounds);
        }
    }

    int finish(const CalibrationResult& result) const {
        if (options_.json != "-" && options_.out != "-") {
            fmt::print("{}", result.text);
        }
        const bool out = options_.out.empty() || write_text_to(options_.out, result.study);
        const bool json =
            options_.json.empty() || write_text_to(options_.json, json_text(result.json, 2) + "\n");
        return out && json ? kDone : kBadInput;
    }

    const CalibrateOptions& options_;
    Problems problems_;
    RecordingList list_;
    HealthySet set_;
    std::vector<CalibratedInput> inputs_;
};

int calibrate_command(const CalibrateOptions& options) {
    try {
        return Command(options).run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
}

}  // namespace

void add_calibrate(CLI::App& app, int& code) {
    const auto options = std::make_shared<CalibrateOptions>();
    auto* command = app.add_subcommand(
        "calibrate",
        "fit tooth errors, background noise, tones, gain and path exponent of a study to "
        "recordings of healthy gearboxes: approximate Bayesian computation with regression "
        "adjustment");
    add_study(*command, options->study);
    command
        ->add_option("--healthy", options->healthy,
                     "recordings of healthy gearboxes, each of a different gearbox, or name "
                     "patterns; same formats as for `features`")
        ->allow_extra_args(false);
    command->add_option("--manifest", options->manifest,
                        "instead: table (CSV) of recordings as for `features`; column gearbox "
                        "names the gearbox; faulty recordings are ignored");
    command->add_option("--features", options->features,
                        "instead: table (CSV) of features as written by `features --csv`");
    add_columns(*command, options->columns);
    command
        ->add_option(
            "--prior", options->priors,
            "KEY=LOW:HIGH or KEY=LOW:HIGH:log: uniform or log-uniform prior of a study key; may "
            "be repeated (default: gearbox.tooth_quality=2:11, or pitch_error_um if the study has "
            "it; sensor.noise_m_s2 or its density, 1 to 105 % of the recordings' rms, log; "
            "sensor.gain=0.05:20:log; sensor.path_exponent=-0.2:0.4; with tones "
            "sensor.tone_level=0.01:20:log)")
        ->type_name("KEY=LOW:HIGH")
        ->allow_extra_args(false);
    command
        ->add_option("--feature", options->feature,
                     "feature to compare; may be repeated (default: all features of the "
                     "acceleration except those of sun and ring and those that transform the "
                     "whole record)")
        ->allow_extra_args(false);
    add_number(*command, "--draws", options->sets,
               "parameter sets simulated in each of two rounds (default: 200); each set integrates "
               "every gearbox once",
               from_to(50, 10000));
    require_file_name(command->add_option("--out", options->out,
                                          "write a study file (TOML) with the calibrated inputs in "
                                          "[random], or - for standard output"));
    add_json(*command, options->json);
    command->add_flag("--quiet", options->quiet, "do not print the computing time");
    add_force(*command, options->force);
    command->callback([options, &code] { code = calibrate_command(*options); });
}

}  // namespace gearpod::mc
