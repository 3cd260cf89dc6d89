#include "mc/commands/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "mc/ensemble/results_check.hpp"
#include "mc/files/json_text.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

void require_none(const Problems& problems) {
    if (std::string lines = format(problems); !problems.empty()) {
        lines.pop_back();
        throw std::runtime_error(lines);
    }
}

StudyResults read_study_results(const std::string& path) {
    StudyResults requested{path, read_frame(path), {}};
    const FileRows rows(path, requested.frame);
    check_results(path, requested.frame, rows);
    requested.source = rare_event_source(requested.frame.provenance_value("study"), path);
    requested.frame.detection = detect_all(requested.frame, rows);
    return requested;
}

std::optional<FeatureAtLevel> find_feature_at_level(const StudyResults& results,
                                                    const std::string& feature,
                                                    const std::optional<double>& noise_level,
                                                    Problems& problems) {
    const Results& frame = results.frame;
    const auto found =
        std::ranges::find(frame.detection, feature, &analysis::FeatureDetection::feature);
    if (found == frame.detection.end()) {
        std::vector<std::string> names;
        for (const FeatureResult& known : frame.features) {
            names.push_back(known.name);
        }
        problems.push_back({.file = "--feature",
                            .what = fmt::format("\"{}\" is not in {}; its features are {}", feature,
                                                results.path, fmt::join(names, ", "))});
        return std::nullopt;
    }
    const double requested_level =
        noise_level.value_or(frame.noise_levels[reference_level(frame.noise_levels)]);
    const auto level = std::ranges::find(frame.noise_levels, requested_level);
    if (level == frame.noise_levels.end()) {
        problems.push_back(
            {.file = "--noise-level",
             .what = fmt::format("{:g} is not a noise level of the file; choose from {:g}",
                                 requested_level, fmt::join(frame.noise_levels, ", "))});
        return std::nullopt;
    }
    const auto at = static_cast<std::size_t>(level - frame.noise_levels.begin());
    return FeatureAtLevel{features::find_feature(feature), &found->levels[at]};
}

void require_threshold(const FeatureAtLevel& requested, Problems& problems) {
    if (std::isnan(requested.detection->threshold)) {
        problems.push_back(
            {.file = "--feature",
             .what = fmt::format("\"{}\" has no threshold at noise x {:g}: too few healthy "
                                 "gearboxes for the false-alarm rate; run the study with more "
                                 "(ensemble.threshold_instances)",
                                 requested.feature->name, requested.detection->noise_level)});
    }
}

RequestedSize read_requested_size(const FaultPlan& fault, double size, Problems& problems) {
    if (!(size > 0.0) || std::isinf(size)) {
        problems.push_back(
            {.file = "--size", .what = fmt::format("must be > 0 and finite, but is {:g}", size)});
    }
    const Unit& unit = fault.unit();
    return {size * unit.to_si, size, unit.suffix.empty() ? "" : std::string(unit.name)};
}

const char* alarm_symbol_of(const std::string& feature) {
    return analysis::alarm_symbol(features::find_feature(feature)->alarm);
}

std::string miss_probability_text(const RequestedSize& size, const std::string& feature,
                                  double noise_level, double threshold) {
    return fmt::format(
        "probability that {} misses a fault of {:g}{}{} at noise x {:g} (alarm if {} {:.5g}): ",
        feature, size.given, size.unit.empty() ? "" : " ", size.unit, noise_level,
        alarm_symbol_of(feature), threshold);
}

StudyScene scene_for_results(const StudyResults& results, const std::string& study) {
    StudyScene made =
        make_scene(results.path, read_study_text(study, results.path), Choosing::nothing);
    if (!made) {
        const std::string size = results.source.fault.size_key->path();
        for (Problem& problem : made.problems) {
            const bool of_size = problem.key == size;
            problem.file = of_size ? "--size" : results.path;
            problem.line = 0;
            problem.key = of_size ? "" : problem.key;
        }
        require_none(made.problems);
    }
    return made;
}

bool prepare_together(const Ranks& ranks, const std::string& results, const FileRole& json,
                      bool force, const std::function<void()>& prepare) {
    std::string problem;
    if (ranks.leads() &&
        !can_write(json, {{"the results file", results}}, {json_output(), force})) {
        problem = "-";  // can_write() has printed the reason
    } else {
        try {
            prepare();
        } catch (const std::exception& error) {
            problem = exception_text(error);
        }
    }
    for (const std::string& found : ranks.gather(problem)) {
        if (!found.empty()) {
            if (ranks.leads() && found != "-") {
                fmt::print(stderr, "{}\n", found);
            }
            return false;
        }
    }
    return true;
}

int compute_together(const Ranks& ranks, Progress& progress, const std::string& json,
                     const std::function<CommandResult()>& compute) {
    try {
        const CommandResult command_result = compute();
        progress.finish();
        if (!ranks.leads()) {
            return kDone;
        }
        if (json != "-") {
            fmt::print("{}", command_result.text);
        }
        if (!json.empty() && !write_text_to(json, json_text(command_result.json, 2) + "\n")) {
            return kBadInput;
        }
        return command_result.failed == 0 ? kDone : kSomeFailed;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;  // there is no checkpoint to resume from
    }
}

}  // namespace gearpod::mc
