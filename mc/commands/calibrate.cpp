// Command `calibrate STUDY --healthy REC...`: finds the inputs with which simulated healthy
// gearboxes match measured ones.
#include "mc/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "mc/calibration/healthy_records.hpp"
#include "mc/commands/commands.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/recordings/measure_recordings.hpp"
#include "mc/run/support.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// Keeps the recordings labelled healthy, or all recordings if none has a label.
void keep_healthy(RecordingList& list) {
    const bool labelled = std::ranges::any_of(
        list.recordings, [](const Recording& one) { return one.condition != Condition::unknown; });
    std::erase_if(list.recordings, [&](const Recording& one) {
        return labelled && one.condition != Condition::healthy;
    });
}

// Computes the features of the recordings. Adds a problem for each recording that cannot be read.
std::vector<HealthyRecord> measured_records(const CalibrateOptions& options,
                                            const RecordingList& list, const Scene& scene,
                                            Problems& problems) {
    const auto measured =
        measure_recordings(list, options.columns, scene, {}, {}, thread_count(scene.study()), [] {
        }).recordings;
    print_notes(list, measured);
    std::vector<HealthyRecord> records;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (!measured[i].problem.empty()) {
            problems.push_back({printable(measured[i].problem), 0, "", "", ""});
            continue;
        }
        records.push_back({list.recordings[i].gearbox,
                           std::min(measured[i].sensor_meshes, scene.span_meshes()),
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
        const auto scene = load_scene(options_.study).scene;
        if (!scene || !outputs_good()) {
            return kBadInput;
        }
        if (scene->study().effects.quasi_static()) {
            problems_.push_back({options_.study.path, 0, "effects.motion",
                                 "a quasi-static study has no acceleration signal to calibrate",
                                 "choose a motion with inertia, e.g. \"translational-torsional\""});
            return stop();
        }
        if (!scene->study().sensor.additional.empty()) {
            problems_.push_back({options_.study.path, 0, "sensor.additional",
                                 "calibration has one sensor", "remove them"});
        }
        if (has_housing(scene->study())) {
            problems_.push_back({options_.study.path, 0, "sensor.housing_modes",
                                 "calibration does not simulate the housing",
                                 "remove them, and a measured response (sensor.response_Hz)"});
        }
        if (has_range(scene->study())) {
            problems_.push_back({options_.study.path, 0, "sensor.range_m_s2",
                                 "calibration does not clip the samples", "remove it"});
        }
        if (has_other_sources(scene->study())) {
            problems_.push_back({options_.study.path, 0, "sensor.bearings",
                                 "calibration simulates neither faulty bearings nor neighbouring "
                                 "stages (sensor.stages)",
                                 "use recordings without them, and remove the keys"});
        }
        if (!problems_.empty()) {
            return stop();
        }
        const std::vector<HealthyRecord> records =
            options_.features.empty() ? measured_records(options_, list_, *scene, problems_)
                                      : read_feature_table(options_.features, *scene, problems_);
        if (records.empty() && problems_.empty()) {
            problems_.push_back({"calibrate", 0, "", "no recording of a healthy gearbox",
                                 "check the labels and sizes of the recordings"});
        }
        if (!problems_.empty()) {
            return stop();
        }
        set_ = healthy_set(records, options_.feature, problems_);
        choose_inputs(scene->study());
        return problems_.empty() ? calibrated(scene->study()) : stop();
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
        if (sources == 1 && options_.features.empty()) {
            try {
                list_ = options_.manifest.empty() ? recordings_of(options_.healthy, problems_)
                                                  : read_manifest(options_.manifest, problems_);
                keep_healthy(list_);
            } catch (const SignalError& error) {
                problems_.push_back({printable(error.what()), 0, "", "", ""});
            }
        }
        print_problems(problems_);
        return std::exchange(problems_, {}).empty();
    }

    bool outputs_good() const {
        std::vector<FileRole> read{{"the study", options_.study.path},
                                   {"the manifest", options_.manifest},
                                   {"the table of --features", options_.features}};
        std::erase_if(read, [](const FileRole& one) { return one.path.empty(); });
        for (const Recording& recording : list_.recordings) {
            read.push_back({"a recording", recording.file});
        }
        const bool good =
            can_write({"--out", options_.out}, read,
                      {text_output("a calibrated study", "# Calibrated"), options_.force});
        read.push_back({"--out", options_.out.empty() ? "-" : options_.out});
        return can_write({"--json", options_.json}, read, {json_output(), options_.force}) && good;
    }

    // Uses the priors given by --prior, or else the default ones.
    void choose_inputs(const Study& study) {
        if (!inputs_.empty()) {
            return;
        }
        const double rms = set_.mean_of("sensor_rms");
        if (rms > 0.0) {
            inputs_ = default_inputs(study, rms);
        } else if (problems_.empty()) {
            problems_.push_back({"calibrate", 0, "",
                                 "the default prior of the background noise needs the feature "
                                 "sensor_rms",
                                 "give --prior sensor.noise_m_s2=LOW:HIGH:log and the other "
                                 "priors"});
        }
    }

    int calibrated(const Study& study) {
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
        CalibrationTask task;
        task.inputs = inputs_;
        task.lengths = set_.lengths;
        task.measured = set_.values;
        task.threads = thread_count(study);
        task.integrated = static_cast<std::size_t>(options_.sets);
        const SetSummary summary(set_.features, set_.values);
        std::vector<SimulatedSet> first;
        print_cost_of_rounds(task);
        const CalibrationResult result =
            calibrate(*scene, task, summary, first, [&](double seconds) {
                if (!options_.quiet) {
                    fmt::print(
                        stderr,
                        "this round: about {:.0f} s of processor time, {:.0f} s on {} thread(s)\n",
                        seconds, seconds / task.threads, task.threads);
                }
            });
        return finish(*written.study, task, result);
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

    int finish(const Study& study, const CalibrationTask& task, const CalibrationResult& result) {
        if (options_.json != "-" && options_.out != "-") {
            print_table(result);
        }
        const std::string text = calibrated_study(study, result, intro(study, result));
        const bool out = options_.out.empty() || write_text_to(options_.out, text);
        const bool json = options_.json.empty() ||
                          write_text_to(options_.json, json_text(json_of(task, result), 2) + "\n");
        return out && json ? kDone : kBadInput;
    }

    std::vector<std::string> intro(const Study& study, const CalibrationResult& result) const {
        std::vector<std::string> lines{
            fmt::format("Calibrated to {} record(s) of {} healthy gearbox(es) by approximate",
                        set_.records, set_.lengths.size()),
            fmt::format("Bayesian computation: {} simulated sets ({} failed), seed {}.",
                        result.sets, result.failed, study.ensemble.seed),
            "Each distribution is the uncertainty of one value, the same for all gearboxes.",
            "A run with this study includes that uncertainty."};
        for (const FeatureCheck& check : result.checks) {
            if (check.outside()) {
                lines.push_back(fmt::format("NOT REPRODUCED: {} {:.4g}, simulated {:.4g} to {:.4g}",
                                            check.name, check.measured, check.low, check.high));
            }
        }
        return lines;
    }

    static void print_table(const CalibrationResult& result) {
        fmt::print("{:<36}{:>11}{:>11}{:>11}{:>8}\n", "input", "median", "5 %", "95 %", "width");
        for (const InputPosterior& one : result.found) {
            const std::string source =
                one.is_informed
                    ? fmt::format("determined by {}", fmt::join(one.strongest_summaries, ", "))
                    : "NOT DETERMINED by the recordings: this is the prior";
            fmt::print("{:<36}{:>11.4g}{:>11.4g}{:>11.4g}{:>6.0f} %\n    {}\n", one.input.key,
                       one.median, one.low, one.high, 100.0 * one.width_ratio,
                       wrapped_text(source, 4));
        }
        for (const CorrelatedPair& pair : result.pairs) {
            const std::string both =
                fmt::format("{} and {} are only determined jointly, rank correlation {:+.2f}",
                            result.found[pair.first].input.key, result.found[pair.second].input.key,
                            pair.correlation);
            fmt::print("{}\n", wrapped_text(both, 2));
        }
        fmt::print(
            "width: width of the 90 % interval divided by that of the prior\n"
            "determined by: features that determine the input, with their rank "
            "correlations\n\n{:<22}{:>12}{:>26}\n",
            "feature", "measured", "simulated, 98 %");
        for (const FeatureCheck& check : result.checks) {
            fmt::print("{:<22}{:>12.5g}{:>13.5g} to{:>10.5g}  {}\n", check.name, check.measured,
                       check.low, check.high, check.outside() ? "NOT REPRODUCED" : "");
        }
        if (result.failed > 0) {
            fmt::print("{} of {} simulated sets have no features and were ignored\n", result.failed,
                       result.sets);
        }
    }

    nlohmann::ordered_json json_of(const CalibrationTask& task,
                                   const CalibrationResult& result) const {
        nlohmann::ordered_json json;
        json["records"] = set_.records;
        json["gearboxes"] = set_.lengths.size();
        json["left_out"] = set_.left_out;
        json["integrated_draws"] = kCalibrationRounds * task.integrated;
        json["simulated_sets"] = result.sets;
        json["failed_sets"] = result.failed;
        json["inputs"] = nlohmann::ordered_json::array();
        for (const InputPosterior& one : result.found) {
            json["inputs"].push_back({{"key", one.input.key},
                                      {"prior_low", one.input.low},
                                      {"prior_high", one.input.high},
                                      {"logarithmic", one.input.logarithmic},
                                      {"median", one.median},
                                      {"low", one.low},
                                      {"high", one.high},
                                      {"left", one.width_ratio},
                                      {"is_informed", one.is_informed},
                                      {"informed_by", one.strongest_summaries}});
        }
        json["together"] = nlohmann::ordered_json::array();
        for (const CorrelatedPair& pair : result.pairs) {
            json["together"].push_back({{"first", result.found[pair.first].input.key},
                                        {"second", result.found[pair.second].input.key},
                                        {"correlation", pair.correlation}});
        }
        json["features"] = nlohmann::ordered_json::array();
        for (const FeatureCheck& check : result.checks) {
            json["features"].push_back({{"name", check.name},
                                        {"measured", check.measured},
                                        {"low", check.low},
                                        {"high", check.high},
                                        {"reproduced", !check.outside()}});
        }
        return json;
    }

    const CalibrateOptions& options_;
    Problems problems_;
    RecordingList list_;
    HealthySet set_;
    std::vector<CalibratedInput> inputs_;
};

}  // namespace

int calibrate_command(const CalibrateOptions& options) {
    try {
        return Command(options).run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
}

}  // namespace gearpod::mc
