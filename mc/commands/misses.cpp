// Command `misses F.h5`: probability of a rare miss, by importance sampling with exponentially
// tilted noise.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/report/json_values.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/study_results.hpp"
#include "mc/ensemble/rare_event_rates.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "signals/windowing/noise_importance_sampler.hpp"

namespace gearpod::mc {
namespace {

struct MissesOptions {
    std::string results;
    std::string feature;
    double size = 0.0;                  // fault size in the unit of the study's key
    std::optional<double> noise_level;  // empty: reference_level()
    long gearboxes = 200;
    int records = 64;  // per gearbox, most of them with exponentially tilted noise
    std::string json;  // "": none; "-": standard output instead of the text
    bool quiet = false;
    bool force = false;  // replaces outputs of another kind
};

constexpr long kMostRows = 100'000'000;
constexpr int kMostRecords = 10'000;  // the limit of ensemble.threshold_records

// Finds the threshold set by the file's healthy gearboxes.
void find_threshold(const StudyResults& results, const MissesOptions& options, Problems& problems,
                    MissRateRequest& question) {
    const features::Feature* feature = features::find_feature(options.feature);
    if (feature != nullptr && !feature->from_sensor) {
        problems.push_back(
            {.file = "--feature",
             .what = fmt::format("\"{}\" does not use the acceleration signal, but `misses` "
                                 "varies its noise; choose a feature of the acceleration",
                                 options.feature)});
    }
    const auto requested =
        find_feature_at_level(results, options.feature, options.noise_level, problems);
    if (!requested) {
        return;
    }
    question.feature = options.feature;
    question.noise_level = requested->detection->noise_level;
    question.threshold = requested->detection->threshold;
    if (question.noise_level == 0.0) {
        problems.push_back(
            {.file = "--noise-level",
             .what = "0 has no noise; use `rare` for misses due to variation between gearboxes"});
    }
    require_threshold(*requested, problems);
}

void check_numbers(const RareEventSource& source, const MissesOptions& options,
                   Problems& problems) {
    constexpr auto kKinds = static_cast<int>(signals::NoiseImportanceSampler::kKinds);
    for (const std::string& problem : source.noise_problems) {
        problems.push_back({.file = options.results, .what = problem});
    }
    if (options.records < kKinds || options.records % kKinds != 0 ||
        options.records > kMostRecords) {
        problems.push_back({.file = "--records",
                            .what = fmt::format("must be a multiple of {} up to {}, but is {}",
                                                kKinds, kMostRecords, options.records)});
    }
    const int records = std::clamp(options.records, kKinds, kMostRecords);
    if (options.gearboxes < 2 || options.gearboxes > kMostRows / records) {
        problems.push_back({.file = "--gearboxes",
                            .what = fmt::format("must be between 2 and {}, but is {}",
                                                kMostRows / records, options.gearboxes)});
    }
}

struct Prepared {
    MissRateRequest question;
    double confidence = 0.0;
    RequestedSize size;
};

// Request and plan of the estimate. Throws std::runtime_error with every problem.
std::pair<Prepared, StudyScene> prepare(const MissesOptions& options) {
    const StudyResults results = read_study_results(options.results);
    if (!results.source.fault.given()) {
        throw std::runtime_error(options.results + ": its study has no fault");
    }
    Problems problems;
    Prepared prepared;
    check_numbers(results.source, options, problems);
    prepared.size = read_requested_size(results.source.fault, options.size, problems);
    find_threshold(results, options, problems, prepared.question);
    require_none(problems);
    prepared.confidence = results.frame.request.confidence;
    prepared.question.size = prepared.size.si;
    prepared.question.gearboxes = options.gearboxes;
    prepared.question.records = options.records;
    return {prepared,
            scene_for_results(results, miss_rate_text(results.source, prepared.question))};
}

std::string rate_text(const Prepared& prepared, const MissRateResult& result) {
    const MissRateRequest& q = prepared.question;
    const std::string records = fmt::format(
        "{} exponentially tilted records of each of {} gearboxes", q.records, result.gearboxes);
    if (!result.misses) {
        return fmt::format(
            "cannot be estimated from {}: too few of them are misses. Use more records or "
            "gearboxes; if variation between gearboxes causes the misses, use `rare`",
            records);
    }
    return fmt::format(
        "{:.3g} [{:.3g}, {:.3g}] at {:g} % confidence, from {} (effective number of records that "
        "contribute: {:.0f})",
        result.misses->expected, result.misses->rate.lower, result.misses->rate.upper,
        100.0 * prepared.confidence, records, result.misses->contributing);
}

// Relative error, and how many records plain counting would need for the same error.
std::string counting_text(const MissRateResult& result) {
    const double times = result.counted / static_cast<double>(result.records);
    const std::string error =
        fmt::format("relative error {:.2g}; ", std::sqrt(result.misses->variance));
    return times > 1.0 ? error + fmt::format(
                                     "counting misses in `run` needs {:.3g} records for the same "
                                     "error, {:.3g} times as many",
                                     result.counted, times)
                       : error +
                             "misses are not rare enough for this method: counting with `run` "
                             "needs fewer records";
}

std::string misses_report(const Prepared& prepared, const MissRateResult& result) {
    const MissRateRequest& q = prepared.question;
    std::string text =
        wrapped_text(miss_probability_text(prepared.size, q.feature, q.noise_level, q.threshold) +
                         rate_text(prepared, result),
                     2) +
        "\n";
    if (result.misses) {
        text += wrapped_text(counting_text(result), 2) + "\n";
    }
    if (result.failed > 0) {
        text += fmt::format("{} of the gearboxes failed and are not counted\n", result.failed);
    }
    return text;
}

nlohmann::json misses_json(const MissesOptions& options, const Prepared& prepared,
                           const MissRateResult& result) {
    const MissRateRequest& q = prepared.question;
    const auto found = [&](auto value) {
        return result.misses ? analysis::json_of(value(*result.misses)) : nlohmann::json(nullptr);
    };
    return {
        {"kind", "misses"},
        {"results", options.results},
        {"feature", q.feature},
        {"noise_level", q.noise_level},
        {"threshold", q.threshold},
        {"size", options.size},
        {"size_unit", prepared.size.unit},
        {"gearboxes", result.gearboxes},
        {"failed", result.failed},
        {"records", q.records},
        {"confidence", prepared.confidence},
        {"miss_rate", found([](const auto& misses) { return misses.expected; })},
        {"lower", found([](const auto& misses) { return misses.rate.lower; })},
        {"upper", found([](const auto& misses) { return misses.rate.upper; })},
        {"carrying", found([](const auto& misses) { return misses.contributing; })},
        {"relative_error", found([](const auto& misses) { return std::sqrt(misses.variance); })},
        {"counted_records", found([&](const auto&) { return result.counted; })}};
}

int misses_command(const MissesOptions& options) {
    const Ranks ranks;
    const Interruption interruption({});
    Prepared prepared;
    StudyScene made;
    if (!prepare_together(ranks, options.results, {"--json", options.json}, options.force,
                          [&] { std::tie(prepared, made) = prepare(options); })) {
        return kBadInput;
    }
    Progress progress(options.gearboxes * options.records, options.quiet || !ranks.leads());
    return compute_together(ranks, progress, options.json, [&] {
        const MissRateResult result =
            estimate_miss_rate(made.scene->tile(), made.scene->ensemble(), prepared.question, ranks,
                               progress, &interruption);
        return CommandResult{misses_report(prepared, result),
                             misses_json(options, prepared, result), result.failed};
    });
}

}  // namespace

void add_misses(CLI::App& app, int& code) {
    const auto [command, options] = add_command<MissesOptions>(
        app, code, "misses",
        "estimate how often a feature misses a fault of one size, when misses are rare and due to "
        "noise (importance sampling of the noise)",
        misses_command);
    command
        .add_option("results", options.results,
                    "results file (HDF5) of `run`; gives the study and the threshold")
        ->required();
    command.add_option("--feature", options.feature, "feature of the acceleration signal")
        ->required();
    add_number(command, "--size", options.size, "fault size, in the unit of the study")->required();
    add_number(command, "--noise-level", options.noise_level,
               "one of sensor.noise_levels (default: 1, or the first above 0)");
    add_number(command, "--gearboxes", options.gearboxes, "number of gearboxes (default: 200)");
    add_number(command, "--records", options.records,
               "records of each gearbox, a multiple of four (default: 64)");
    add_json(command, options.json);
    command.add_flag("--quiet", options.quiet, "show no progress");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
