// Command `features` for many recordings: writes a results file and a table.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <optional>

#include "mc/commands/commands.hpp"
#include "mc/commands/features.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/recordings/measure_recordings.hpp"
#include "mc/recordings/population.hpp"
#include "mc/run/support.hpp"

namespace gearpod::mc {
namespace {

// Problems with the combination of options.
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

RecordingList list_of(const FeaturesOptions& options, Problems& problems) {
    try {
        return options.manifest.empty() ? recordings_of(options.signals, problems)
                                        : read_manifest(options.manifest, problems);
    } catch (const SignalError& error) {
        problems.push_back({printable(error.what()), 0, "", "", ""});
        return {};
    }
}

// Prints one sentence for each recording.
void print_decisions(const FeaturesOptions& options, const Population& population,
                     std::span<const features::Feature* const> features, const RecordingList& list,
                     const std::vector<MeasuredRecording>& measured) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured[i].problem.empty()) {
            const auto decisions =
                compare_with_population(population, features, measured[i].values, options.feature);
            fmt::print("{}\n", wrapped_text(decision_sentence(list.recordings[i].name(), population,
                                                              decisions.front(), measured[i].teeth),
                                            2));
        }
    }
}

// Prints the recordings without features and the files written. Returns the exit code.
int summary(const FeaturesOptions& options, const std::vector<MeasuredRecording>& measured) {
    const auto bad =
        std::count_if(measured.begin(), measured.end(),
                      [](const MeasuredRecording& one) { return !one.problem.empty(); });
    for (const MeasuredRecording& one : measured) {
        if (!one.problem.empty()) {
            fmt::print(stderr, "{}\n", printable(one.problem));
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

}  // namespace

int recordings_command(const FeaturesOptions& options) {
    Problems problems = option_problems(options);
    RecordingList list;
    if (problems.empty()) {
        list = list_of(options, problems);
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
        comparison.options.average = scene->study().monitoring.average_records;
    }
    problems =
        baseline_problems(comparison.options, list, options.manifest, !options.baseline.empty());
    if (!problems.empty()) {
        print_problems(problems);
        return kBadInput;
    }
    try {
        std::optional<Population> population;
        if (!options.against.empty()) {
            population = read_population(options.against, options.noise_level, scene->study());
        }
        std::vector<std::string> notes;
        const HealthyReference healthy =
            options.healthy.empty()
                ? HealthyReference()
                : measured_reference({options.healthy.begin(), options.healthy.end()},
                                     options.columns, *scene, 1, notes);
        const auto baseline = measured_baseline(options.baseline, options.columns, *scene);
        if (baseline) {
            add_notes(baseline->signal, baseline->file, notes);
        }
        for (const std::string& note : notes) {
            fmt::print(stderr, "{}\n", wrapped_text("note: " + note, 2));
        }
        comparison.given = baseline ? &*baseline : nullptr;
        const bool compared = comparison.any(list);
        const auto features = measurable(scene->study(), compared);
        const int threads = thread_count(scene->study());
        Progress progress(static_cast<long>(list.recordings.size()),
                          options.quiet || options.csv == "-", 0, Progress::Form::text,
                          "recordings");
        const auto [measured, baseline_notes] =
            measure_recordings(list, options.columns, *scene, healthy, comparison, threads,
                               [&] { progress.advance(1); });
        progress.finish();
        for (const std::string& note : baseline_notes) {
            fmt::print(stderr, "{}\n", wrapped_text("note: " + printable(note), 2));
        }
        print_notes(list, measured);
        const bool csv_good =
            options.csv.empty() ||
            write_text_to(options.csv, recordings_csv(list, measured, features, compared));
        if (!options.out.empty()) {
            write_results(options.out,
                          recordings_results(list, measured, features, *scene, threads, compared));
        }
        if (population) {
            print_decisions(options, *population, features, list, measured);
        }
        return csv_good ? summary(options, measured) : kBadInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
}

}  // namespace gearpod::mc
