// Command `rare F.h5`: rates of rare false alarms or misses caused by gearbox-to-gearbox variation,
// by multilevel splitting (subset simulation).
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "analysis/report/json_values.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/study_results.hpp"
#include "mc/ensemble/rare_event_rates.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

struct RareOptions {
    std::string results;
    std::string feature;
    std::optional<double> rate;         // false-alarm rate; find its threshold
    std::optional<double> size;         // or fault size in its unit; find its miss rate
    std::optional<double> noise_level;  // empty: reference_level()
    long gearboxes = 1000;              // per level
    std::string json;                   // "": none; "-": standard output instead of the text
    bool quiet = false;
    bool force = false;  // replaces outputs of another kind
};

constexpr long kFewestOfLevel = 20, kMostOfLevel = 1'000'000;
constexpr double kRarestAlarms = 1e-9;

struct PreparedRare {
    RareRateRequest question;
    double confidence = 0.0;
    RequestedSize size;  // if the miss rate is requested
};

void request_misses(const StudyResults& results, const RareOptions& options,
                    const FeatureAtLevel& requested, Problems& problems, PreparedRare& prepared) {
    if (!results.source.fault.given()) {
        problems.push_back({.file = options.results, .what = "its study has no fault"});
        return;
    }
    prepared.size = read_requested_size(results.source.fault, *options.size, problems);
    require_threshold(requested, problems);
    prepared.question.size = prepared.size.si;
    prepared.question.threshold = requested.detection->threshold;
}

// Request and plan of the estimate. Throws std::runtime_error with every problem.
std::pair<PreparedRare, StudyScene> prepare_rare(const RareOptions& options) {
    const StudyResults results = read_study_results(options.results);
    Problems problems;
    PreparedRare prepared;
    RareRateRequest& question = prepared.question;
    if (!options.rate && !options.size) {
        problems.push_back({.file = "--rate",
                            .what = "missing; give a false-alarm rate (--rate 1e-4), or --size"});
    }
    if (options.rate && !(*options.rate >= kRarestAlarms && *options.rate <= 0.1)) {
        problems.push_back({.file = "--rate",
                            .what = fmt::format("must be between {:g} and 0.1, but is {:g}",
                                                kRarestAlarms, *options.rate)});
    }
    if (options.gearboxes < kFewestOfLevel || options.gearboxes > kMostOfLevel) {
        problems.push_back({.file = "--gearboxes",
                            .what = fmt::format("must be between {} and {}, but is {}",
                                                kFewestOfLevel, kMostOfLevel, options.gearboxes)});
    }
    const auto requested =
        find_feature_at_level(results, options.feature, options.noise_level, problems);
    if (requested) {
        question.noise_level = requested->detection->noise_level;
    }
    if (requested && options.size) {
        request_misses(results, options, *requested, problems, prepared);
    }
    require_none(problems);
    question.feature = options.feature;
    question.rate = options.rate;
    question.gearboxes = options.gearboxes;
    prepared.confidence = results.frame.request.confidence;
    return {prepared, scene_for_results(results, rare_rate_text(results.source, question))};
}

std::string unknown_rate_text(const RareRateRequest& question, const RareRateResult& result) {
    return !question.rate && result.last_rate < kSmallestMissRate
               ? fmt::format("less than {:g}", kSmallestMissRate)
               : fmt::format(
                     "unknown from {} gearboxes per level: fewer than {:g} independent families "
                     "of gearboxes reach the last level. Use more gearboxes (--gearboxes)",
                     question.gearboxes, analysis::kLeastFamilies);
}

std::string rate_text(const PreparedRare& prepared, const RareRateResult& result) {
    const RareRateRequest& q = prepared.question;
    std::string text =
        q.rate ? fmt::format("false-alarm rate {:g} of {} at noise x {:g}: ", *q.rate, q.feature,
                             q.noise_level)
               : miss_probability_text(prepared.size, q.feature, q.noise_level, q.threshold);
    if (!result.estimate) {
        return text + unknown_rate_text(q, result);
    }
    if (q.rate) {
        text += fmt::format(
            "threshold {:.5g} [{:.5g}, {:.5g}] (alarm if {}); estimated rate of this threshold ",
            result.estimate->threshold, result.threshold.lower, result.threshold.upper,
            alarm_symbol_of(q.feature));
    }
    return text + fmt::format("{:.3g} [{:.3g}, {:.3g}] at {:g} % confidence",
                              result.estimate->expected, result.estimate->rate.lower,
                              result.estimate->rate.upper, 100.0 * prepared.confidence);
}

// Cost of the estimate, and how many gearboxes plain counting would need for the same error.
std::string cost_text(const RareRateRequest& question, const RareRateResult& result) {
    std::string text =
        fmt::format("{} gearboxes computed, {} per level, {} level{}", result.computed,
                    question.gearboxes, result.levels, result.levels == 1 ? "" : "s");
    if (result.levels > 1) {
        text += fmt::format("; acceptance rate of a level at least {:.0f} %",
                            100.0 * result.least_kept);
    }
    if (result.estimate) {
        const double times = result.counted / static_cast<double>(result.computed);
        text += fmt::format("; effectively {:.0f} independent families, relative error {:.2g}",
                            result.estimate->families, std::sqrt(result.estimate->variance));
        text += times > 1.0
                    ? fmt::format(
                          "; counting misses in `run` needs {:.3g} gearboxes for the same error, "
                          "{:.2g} times as many",
                          result.counted, times)
                    : "; not rare enough for this method: counting with `run` needs "
                      "fewer gearboxes";
    }
    return text;
}

// Random inputs whose mean over the last level's gearboxes differs from the mean over all.
std::string shift_text(const RareRateResult& result) {
    std::string text = fmt::format("the last level ({:.2g} of all gearboxes) ", result.last_rate);
    if (result.shifted.empty()) {
        return text +
               "has the same mean random inputs as all gearboxes: tooth errors, planets or noise "
               "make the difference";
    }
    text += "has other mean inputs than all gearboxes:";
    for (const ShiftedInput& input : result.shifted) {
        text += fmt::format("{} {} {:.4g}{} instead of {:.4g}",
                            &input == &result.shifted[0] ? "" : ",", input.name, input.rare,
                            input.unit == "1" ? "" : " " + input.unit, input.all);
    }
    return text;
}

std::string rare_text(const PreparedRare& prepared, const RareRateResult& result) {
    std::string text = wrapped_text(rate_text(prepared, result), 2) + "\n" +
                       wrapped_text(cost_text(prepared.question, result), 2) + "\n";
    if (result.levels > 1) {
        text += wrapped_text(shift_text(result), 2) + "\n";
    }
    if (result.failed > 0) {
        text += fmt::format("{} of the gearboxes failed and count as no alarm\n", result.failed);
    }
    return text;
}

nlohmann::json rare_json(const RareOptions& options, const PreparedRare& prepared,
                         const RareRateResult& result) {
    const RareRateRequest& q = prepared.question;
    const auto found = [&](auto value) {
        return result.estimate ? nlohmann::json(value(*result.estimate)) : nlohmann::json(nullptr);
    };
    nlohmann::json json{
        {"kind", q.rate ? "rare-false-alarms" : "rare-misses"},
        {"results", options.results},
        {"feature", q.feature},
        {"noise_level", q.noise_level},
        {"confidence", prepared.confidence},
        {"gearboxes_a_level", q.gearboxes},
        {"gearboxes", result.computed},
        {"failed", result.failed},
        {"levels", result.levels},
        {"last_rate", result.last_rate},
        {"least_kept", result.least_kept},
        {"shifted_inputs", analysis::json_of(result.shifted)},
        {"threshold", found([](const auto& of) { return of.threshold; })},
        {"rate", found([](const auto& of) { return of.expected; })},
        {"lower", found([](const auto& of) { return of.rate.lower; })},
        {"upper", found([](const auto& of) { return of.rate.upper; })},
        {"families", found([](const auto& of) { return of.families; })},
        {"relative_error", found([](const auto& of) { return std::sqrt(of.variance); })},
        {"counted_gearboxes", analysis::number(result.counted)}};
    if (q.rate) {
        json["rate_asked"] = *q.rate;
        json["threshold_lower"] = analysis::number(result.threshold.lower);
        json["threshold_upper"] = analysis::number(result.threshold.upper);
    } else {
        json["size"] = *options.size;
        json["size_unit"] = prepared.size.unit;
        json["threshold"] = q.threshold;
    }
    return json;
}

int rare_command(const RareOptions& options) {
    const Ranks ranks;
    const Interruption interruption({});
    PreparedRare prepared;
    StudyScene made;
    if (!prepare_together(ranks, options.results, {"--json", options.json}, options.force,
                          [&] { std::tie(prepared, made) = prepare_rare(options); })) {
        return kBadInput;
    }
    Progress progress(largest_gearbox_count(prepared.question), options.quiet || !ranks.leads());
    return compute_together(ranks, progress, options.json, [&] {
        const RareRateResult result =
            estimate_rare_rate(made.scene->tile(), made.scene->ensemble(), prepared.question, ranks,
                               progress, &interruption);
        return CommandResult{rare_text(prepared, result), rare_json(options, prepared, result),
                             result.failed};
    });
}

}  // namespace

void add_rare(CLI::App& app, int& code) {
    const auto [command, options] = add_command<RareOptions>(
        app, code, "rare",
        "estimate the threshold of rare false alarms, or a rare miss rate, when they are due to "
        "variation between gearboxes (multilevel splitting)",
        rare_command);
    command
        .add_option("results", options.results,
                    "results file (HDF5) of `run`; gives the study and the threshold")
        ->required();
    command.add_option("--feature", options.feature, "feature of the file")->required();
    auto* rate =
        add_number(command, "--rate", options.rate, "false-alarm rate; find its threshold");
    add_number(command, "--size", options.size,
               "fault size, in the unit of the study; find its miss rate")
        ->excludes(rate);
    add_number(command, "--noise-level", options.noise_level,
               "one of sensor.noise_levels (default: 1, or the first above 0)");
    add_number(command, "--gearboxes", options.gearboxes,
               "number of gearboxes of each level (default: 1000)");
    add_json(command, options.json);
    command.add_flag("--quiet", options.quiet, "show no progress");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
