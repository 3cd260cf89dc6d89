// Command `rare F.h5`: rates of rare false alarms or misses caused by gearbox-to-gearbox variation,
// by multilevel splitting (subset simulation).
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "analysis/report/json_values.hpp"
#include "mc/commands/asked_results.hpp"
#include "mc/commands/commands.hpp"
#include "mc/ensemble/rare_rates.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

constexpr long kFewestOfLevel = 20, kMostOfLevel = 1'000'000;
constexpr double kRarestAlarms = 1e-9;

struct PreparedRare {
    RareQuestion question;
    double confidence = 0.0;
    AskedSize size;  // if the miss rate is requested
    StudyScene made;
};

void ask_misses(const AskedResults& results, const RareOptions& options, const AskedFeature& asked,
                Complaints& complaints, PreparedRare& prepared) {
    if (results.study.fault.kind == nullptr) {
        complaints.add(options.results, "its study has no fault");
        return;
    }
    prepared.size = ask_size(results.study, *options.size, complaints);
    needs_threshold(asked, complaints);
    prepared.question.size = prepared.size.si;
    prepared.question.threshold = asked.detection->threshold;
}

PreparedRare prepare_rare(const RareOptions& options) {
    const AskedResults results = read_asked(options.results);
    Complaints complaints;
    PreparedRare prepared;
    RareQuestion& question = prepared.question;
    if (!options.rate && !options.size) {
        complaints.add("--rate", "missing; give a false-alarm rate (--rate 1e-4), or --size");
    }
    if (options.rate && !(*options.rate >= kRarestAlarms && *options.rate <= 0.1)) {
        complaints.add("--rate", fmt::format("must be between {:g} and 0.1, but is {:g}",
                                             kRarestAlarms, *options.rate));
    }
    if (options.gearboxes < kFewestOfLevel || options.gearboxes > kMostOfLevel) {
        complaints.add("--gearboxes", fmt::format("must be between {} and {}, but is {}",
                                                  kFewestOfLevel, kMostOfLevel, options.gearboxes));
    }
    const auto asked = find_asked(results, options.feature, options.noise_level, complaints);
    if (asked) {
        question.noise_level = asked->detection->noise_level;
    }
    if (asked && options.size) {
        ask_misses(results, options, *asked, complaints, prepared);
    }
    complaints.end();
    question.feature = options.feature;
    question.rate = options.rate;
    question.gearboxes = options.gearboxes;
    prepared.confidence = results.study.detection.confidence;
    prepared.made = scene_of_asked(results, study_of_rare(results.study, question));
    return prepared;
}

std::string not_known(const RareQuestion& question, const RareAnswer& answer) {
    return !question.rate && answer.last_rate < kRarestMisses
               ? fmt::format("less than {:g}", kRarestMisses)
               : fmt::format(
                     "unknown from {} gearboxes per level: fewer than {:g} independent families "
                     "of gearboxes reach the last level. Use more gearboxes (--gearboxes)",
                     question.gearboxes, analysis::kLeastFamilies);
}

std::string alarms_text(const PreparedRare& prepared, const RareAnswer& answer) {
    const RareQuestion& q = prepared.question;
    const std::string asked = fmt::format("false-alarm rate {:g} of {} at noise x {:g}: ", *q.rate,
                                          q.feature, q.noise_level);
    if (!answer.estimate) {
        return asked + not_known(q, answer);
    }
    return asked + fmt::format(
                       "threshold {:.5g} [{:.5g}, {:.5g}] (alarm if {}); estimated rate of "
                       "this threshold {:.3g} [{:.3g}, {:.3g}] at {:g} % confidence",
                       answer.estimate->threshold, answer.threshold.lower, answer.threshold.upper,
                       alarm_symbol_of(q.feature), answer.estimate->expected,
                       answer.estimate->rate.lower, answer.estimate->rate.upper,
                       100.0 * prepared.confidence);
}

std::string misses_text(const PreparedRare& prepared, const RareAnswer& answer) {
    const RareQuestion& q = prepared.question;
    const std::string asked = asked_misses(prepared.size, q.feature, q.noise_level, q.threshold);
    return answer.estimate
               ? asked + fmt::format("{:.3g} [{:.3g}, {:.3g}] at {:g} % confidence",
                                     answer.estimate->expected, answer.estimate->rate.lower,
                                     answer.estimate->rate.upper, 100.0 * prepared.confidence)
               : asked + not_known(q, answer);
}

// Cost of the estimate, and how many gearboxes plain counting would need for the same error.
std::string cost_text(const RareQuestion& question, const RareAnswer& answer) {
    std::string text =
        fmt::format("{} gearboxes computed, {} per level, {} level{}", answer.computed,
                    question.gearboxes, answer.levels, answer.levels == 1 ? "" : "s");
    if (answer.levels > 1) {
        text += fmt::format("; acceptance rate of a level at least {:.0f} %",
                            100.0 * answer.least_kept);
    }
    if (answer.estimate) {
        const double times = answer.counted / static_cast<double>(answer.computed);
        text += fmt::format("; effectively {:.0f} independent families, relative error {:.2g}",
                            answer.estimate->families, std::sqrt(answer.estimate->variance));
        text += times > 1.0 ? fmt::format(
                                  "; simple counting needs {:.3g} gearboxes for the same error, "
                                  "{:.2g} times as many",
                                  answer.counted, times)
                            : "; not rare enough for this method: counting with `run` needs "
                              "fewer gearboxes";
    }
    return text;
}

// Random inputs whose mean over the last level's gearboxes differs from the mean over all.
std::string shift_text(const RareAnswer& answer) {
    std::string text = fmt::format("the last level ({:.2g} of all gearboxes) ", answer.last_rate);
    if (answer.shifted.empty()) {
        return text +
               "has the same mean random inputs as all gearboxes: tooth errors, planets or noise "
               "make the difference";
    }
    text += "has other mean inputs than all gearboxes:";
    for (const ShiftedInput& input : answer.shifted) {
        text += fmt::format("{} {} {:.4g}{} instead of {:.4g}",
                            &input == &answer.shifted[0] ? "" : ",", input.name, input.rare,
                            input.unit == "1" ? "" : " " + input.unit, input.all);
    }
    return text;
}

std::string rare_text(const PreparedRare& prepared, const RareAnswer& answer) {
    std::string text = wrapped_text(prepared.question.rate ? alarms_text(prepared, answer)
                                                           : misses_text(prepared, answer),
                                    2) +
                       "\n" + wrapped_text(cost_text(prepared.question, answer), 2) + "\n";
    if (answer.levels > 1) {
        text += wrapped_text(shift_text(answer), 2) + "\n";
    }
    if (answer.failed > 0) {
        text += fmt::format("{} of the gearboxes failed and count as no alarm\n", answer.failed);
    }
    return text;
}

nlohmann::json rare_json(const RareOptions& options, const PreparedRare& prepared,
                         const RareAnswer& answer) {
    const RareQuestion& q = prepared.question;
    nlohmann::json shifted = nlohmann::json::array();
    for (const ShiftedInput& input : answer.shifted) {
        shifted.push_back({{"name", input.name},
                           {"unit", input.unit},
                           {"mean_of_all", input.all},
                           {"mean", input.rare}});
    }
    nlohmann::json json{{"kind", q.rate ? "rare-false-alarms" : "rare-misses"},
                        {"results", options.results},
                        {"feature", q.feature},
                        {"noise_level", q.noise_level},
                        {"confidence", prepared.confidence},
                        {"gearboxes_a_level", q.gearboxes},
                        {"gearboxes", answer.computed},
                        {"failed", answer.failed},
                        {"levels", answer.levels},
                        {"last_rate", answer.last_rate},
                        {"least_kept", answer.least_kept},
                        {"shifted_inputs", shifted},
                        {"threshold", nullptr},
                        {"rate", nullptr},
                        {"lower", nullptr},
                        {"upper", nullptr},
                        {"families", nullptr},
                        {"relative_error", nullptr},
                        {"counted_gearboxes", nullptr}};
    if (q.rate) {
        json["rate_asked"] = *q.rate;
        json["threshold_lower"] = analysis::number(answer.threshold.lower);
        json["threshold_upper"] = analysis::number(answer.threshold.upper);
    } else {
        json["size"] = *options.size;
        json["size_unit"] = prepared.size.unit;
        json["threshold"] = q.threshold;
    }
    if (answer.estimate) {
        json["threshold"] = answer.estimate->threshold;
        json["rate"] = answer.estimate->expected;
        json["lower"] = answer.estimate->rate.lower;
        json["upper"] = answer.estimate->rate.upper;
        json["families"] = answer.estimate->families;
        json["relative_error"] = std::sqrt(answer.estimate->variance);
        json["counted_gearboxes"] = analysis::number(answer.counted);
    }
    return json;
}

}  // namespace

int rare_command(const RareOptions& options) {
    const Ranks ranks;
    const Interruption interruption({});
    std::optional<PreparedRare> prepared;
    if (!prepare_together(ranks, options.results, options.json,
                          [&] { prepared = prepare_rare(options); })) {
        return kBadInput;
    }
    Progress progress(rare_gearboxes(prepared->question), options.quiet || !ranks.leads());
    return answer_together(ranks, progress, options.json, [&] {
        const RareAnswer answer =
            rare_rates(*prepared->made.scene, prepared->question, ranks, progress, &interruption);
        return Answered{rare_text(*prepared, answer), rare_json(options, *prepared, answer),
                        answer.failed};
    });
}

}  // namespace gearpod::mc
