#include "mc/recordings/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/no_value.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kLevel = "sensor_rms";

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw std::runtime_error(path + ": " + why);
}

// Refuses a file whose tooth numbers differ from the study's, because its features are not
// comparable.
void check_teeth(const std::string& path, const Results& results, const MemberArray<int>& teeth) {
    std::string text = results.provenance_value("study");
    if (text.empty()) {
        text = results.provenance_value("measured_by_study");
    }
    const auto theirs = measuring_facts(text, path);
    if (!theirs) {
        return;
    }
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        const int other = theirs->teeth[member];
        if (teeth[member] != other) {
            refuse(path,
                   fmt::format("has a gear with {} teeth, but the study has {}; use results of "
                               "the same gearbox",
                               other, teeth[member]));
        }
    }
}

std::size_t level_of(const std::string& path, const Results& results, double noise_level) {
    const auto found =
        std::find(results.noise_levels.begin(), results.noise_levels.end(), noise_level);
    if (found == results.noise_levels.end()) {
        refuse(path, fmt::format("has no noise level {:g}; choose --noise-level from {:g}",
                                 noise_level, fmt::join(results.noise_levels, ", ")));
    }
    return static_cast<std::size_t>(found - results.noise_levels.begin());
}

PopulationFeature feature_of(const Results& results, std::size_t f, std::size_t level,
                             const std::vector<double>& sizes) {
    PopulationFeature feature;
    feature.name = results.features[f].name;
    feature.alarm = results.features[f].alarm;
    std::vector<double> faulty;
    const std::size_t levels = results.noise_levels.size();
    for (std::size_t row = 0; row < results.group.size(); ++row) {
        const double value = results.features[f].values[row * levels + level];
        if (!std::isfinite(value) || results.group[row] == kNoGroup) {
            continue;
        }
        const bool healthy =
            results.group[row] == static_cast<int>(Group::threshold) || sizes[row] == 0.0;
        (healthy ? feature.healthy : faulty).push_back(value);
    }
    std::sort(feature.healthy.begin(), feature.healthy.end());
    for (const std::vector<double>* values : {&feature.healthy, &faulty}) {
        for (const double value : *values) {
            feature.least = std::fmin(feature.least, value);
            feature.most = std::fmax(feature.most, value);
        }
    }
    feature.auc = analysis::auc(feature.healthy, faulty, feature.alarm == analysis::Alarm::high,
                                results.request.confidence)
                      .auc;
    const analysis::LevelDetection& detection = results.detection[f].levels[level];
    feature.threshold = detection.threshold;
    feature.threshold_count = detection.threshold_sample;
    return feature;
}

std::vector<AlarmDecision> compare_with_population(
    const Population& population, std::span<const features::Feature* const> features,
    const std::vector<double>& measured, const std::string& feature) {
    std::vector<AlarmDecision> decisions;
    for (const PopulationFeature& known : population.features) {
        const auto index = static_cast<std::size_t>(
            std::ranges::find(features, known.name, &features::Feature::name) - features.begin());
        const double value = index < measured.size() ? measured[index] : kNan;
        if (!std::isfinite(value)) {
            continue;
        }
        AlarmDecision decision;
        decision.population = &known;
        decision.value = value;
        decision.alarm = analysis::is_alarm(value, known.threshold, known.alarm);
        const double side = analysis::alarm_sign(known.alarm);
        decision.margin = side * (value - known.threshold) / std::abs(known.threshold);
        decision.less_extreme =
            std::count_if(known.healthy.begin(), known.healthy.end(),
                          [&](double healthy) { return side * healthy < side * value; });
        decisions.push_back(decision);
    }
    const auto named =
        std::find_if(decisions.begin(), decisions.end(), [&](const AlarmDecision& decision) {
            return feature.empty() || decision.population->name == feature;
        });
    if (named == decisions.end()) {
        refuse(population.file,
               feature.empty()
                   ? "has no feature in common with the recording"
                   : fmt::format("the feature {} is missing in this file or in the recording",
                                 feature));
    }
    std::rotate(decisions.begin(), named, named + 1);
    return decisions;
}

std::string mismatch_text(const Population& population,
                          const std::vector<AlarmDecision>& decisions) {
    constexpr double kFactor = 3.0;
    for (const AlarmDecision& decision : decisions) {
        const PopulationFeature& known = *decision.population;
        const bool loud = decision.value > kFactor * known.most;
        if (!population.is_measured && known.name == kLevel &&
            (loud || kFactor * decision.value < known.least)) {
            const double nearest = loud ? known.most : known.least;
            return fmt::format(
                "its {}, {:.4g} m/s^2, is {:.3g} times the {} one there, {:.4g} m/s^2", kLevel,
                decision.value, decision.value / nearest, loud ? "largest" : "smallest", nearest);
        }
    }
    return "";
}

std::string decision_sentence(const std::string& recording, const Population& population,
                              const AlarmDecision& decision, const std::vector<WorstTooth>& teeth) {
    const PopulationFeature& known = *decision.population;
    const char* whom =
        population.is_measured ? "healthy recordings" : "simulated healthy gearboxes";
    std::string text = fmt::format(
        "{}: {}: {} is {:.4g}, {:.3g} % {} the threshold of {:.4g} (from {} {} at {:.3g} % false "
        "alarms), and {} than {} of {} healthy values ({:.4g} %)",
        printable(recording), decision.alarm ? "ALARM" : "no alarm", known.name, decision.value,
        100.0 * std::abs(decision.margin), decision.alarm ? "beyond" : "short of", known.threshold,
        known.threshold_count, whom, 100.0 * population.false_alarm_rate,
        known.alarm == analysis::Alarm::high ? "larger" : "smaller", decision.less_extreme,
        known.healthy.size(),
        100.0 * static_cast<double>(decision.less_extreme) /
            static_cast<double>(known.healthy.size()));
    for (const WorstTooth& tooth : teeth) {
        text += fmt::format(
            "{} {} tooth {} of {}, counted from the first mesh of the recording, has {:.3g} times "
            "the median vibration",
            &tooth == &teeth.front() ? "; the" : ", the", tooth.gear, tooth.tooth, tooth.teeth,
            tooth.ratio);
    }
    return text + ".";
}

}  // namespace

Population read_population(const std::string& path, double noise_level,
                           const MemberArray<int>& teeth) {
    const Results results = read_results(path);
    if (results.provenance_value("kind") == kLivesKind) {
        refuse(path, "holds lives; compare with the results of `run`");
    }
    check_teeth(path, results, teeth);
    Population population;
    population.file = path;
    population.is_measured = results.provenance_value("kind") == kRecordingsKind;
    population.noise_level = noise_level;
    population.false_alarm_rate = results.request.false_alarm_rate;
    const std::size_t level = level_of(path, results, noise_level);
    std::vector<double> sizes(results.group.size(), 0.0);
    if (const auto size = results.parameter_index(results.request.size.name)) {
        sizes = results.parameters[*size].values;
    }
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        PopulationFeature feature = feature_of(results, f, level, sizes);
        if (!feature.healthy.empty() && std::isfinite(feature.threshold)) {
            population.features.push_back(std::move(feature));
        }
    }
    if (population.features.empty()) {
        refuse(path, "has too few healthy gearboxes to set a threshold");
    }
    std::stable_sort(population.features.begin(), population.features.end(),
                     [](const PopulationFeature& a, const PopulationFeature& b) {
                         return (std::isfinite(a.auc) ? a.auc : 0.0) >
                                (std::isfinite(b.auc) ? b.auc : 0.0);
                     });
    return population;
}

std::vector<double> values_of(const std::vector<MeasuredFeature>& measured) {
    std::vector<double> values;
    for (const MeasuredFeature& feature : measured) {
        values.push_back(feature.missing.empty() ? feature.value : kNan);
    }
    return values;
}

PopulationDecisions decide(const Population& population, const std::string& recording,
                           std::span<const features::Feature* const> features,
                           const std::vector<double>& measured, const std::string& feature,
                           const std::vector<WorstTooth>& teeth) {
    PopulationDecisions decided{compare_with_population(population, features, measured, feature),
                                "", ""};
    decided.mismatch = mismatch_text(population, decided.decisions);
    if (!decided.mismatch.empty()) {
        for (AlarmDecision& decision : decided.decisions) {
            decision.alarm = false;
        }
        decided.sentence = fmt::format(
            "{}: no decision: {} does not describe this machine: {}. Correct the study (load, "
            "noise, "
            "unit), calibrate it, or compare with recordings of this machine.",
            printable(recording), population.file, decided.mismatch);
        return decided;
    }
    const AlarmDecision& decision = decided.decisions.front();
    decided.sentence = decision_sentence(recording, population, decision, teeth);
    if (const std::string& best = population.features.front().name;
        feature.empty() && decision.population->name != best) {
        decided.sentence += fmt::format(" {}, which ranks best there, has no value here.", best);
    }
    if (std::ranges::none_of(decided.decisions, [](const AlarmDecision& one) {
            return one.population->name == kLevel;
        })) {
        decided.sentence += fmt::format(
            " Whether the levels agree is not known, since {} is missing in one of both.", kLevel);
    }
    return decided;
}

}  // namespace gearpod::mc
