#include "mc/calibration/calibration_report.hpp"

#include <fmt/format.h>

#include "mc/input/wrapped_text.hpp"

namespace gearpod::mc {

std::vector<std::string> calibration_intro(const Study& study, const HealthySet& set,
                                           const CalibrationResult& result) {
    std::vector<std::string> lines{
        fmt::format("Calibrated to {} record(s) of {} healthy gearbox(es) by approximate",
                    set.records, set.lengths.size()),
        fmt::format("Bayesian computation: {} simulated sets ({} failed), seed {}.", result.sets,
                    result.failed, study.ensemble.seed),
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

std::string calibration_text(const CalibrationResult& result) {
    std::string text =
        fmt::format("{:<36}{:>11}{:>11}{:>11}{:>8}\n", "input", "median", "5 %", "95 %", "width");
    for (const InputPosterior& one : result.found) {
        const std::string source =
            one.is_informed
                ? fmt::format("determined by {}", fmt::join(one.strongest_summaries, ", "))
                : "NOT DETERMINED by the recordings: this is the prior";
        text += fmt::format("{:<36}{:>11.4g}{:>11.4g}{:>11.4g}{:>6.0f} %\n    {}\n", one.input.key,
                            one.median, one.low, one.high, 100.0 * one.width_ratio,
                            wrapped_text(source, 4));
    }
    for (const CorrelatedPair& pair : result.pairs) {
        const std::string both =
            fmt::format("{} and {} are only determined jointly, rank correlation {:+.2f}",
                        result.found[pair.first].input.key, result.found[pair.second].input.key,
                        pair.correlation);
        text += fmt::format("{}\n", wrapped_text(both, 2));
    }
    text += fmt::format(
        "width: width of the 90 % interval divided by that of the prior\n"
        "determined by: features that determine the input, with their rank "
        "correlations\n\n{:<22}{:>12}{:>26}\n",
        "feature", "measured", "simulated, 98 %");
    for (const FeatureCheck& check : result.checks) {
        text +=
            fmt::format("{:<22}{:>12.5g}{:>13.5g} to{:>10.5g}  {}\n", check.name, check.measured,
                        check.low, check.high, check.outside() ? "NOT REPRODUCED" : "");
    }
    if (result.failed > 0) {
        text += fmt::format("{} of {} simulated sets have no features and were ignored\n",
                            result.failed, result.sets);
    }
    return text;
}

nlohmann::ordered_json calibration_json(const HealthySet& set, const CalibrationTask& task,
                                        const CalibrationResult& result) {
    nlohmann::ordered_json json;
    json["records"] = set.records;
    json["gearboxes"] = set.lengths.size();
    json["left_out"] = set.left_out;
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

}  // namespace gearpod::mc
