#include "mc/accuracy/measure_detection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mc/numerics/numerical_error.hpp"
#include "mc/random/philox.hpp"

namespace gearpod::mc {
namespace {

// Number of gearboxes of the pilot ensemble, both groups: default, and smallest for which results
// are given.
constexpr long kPilotGearboxes = 480;
constexpr long kFewestGearboxes = 60;

std::size_t most_accurate_setting(const AccuracyReport& report) {
    const auto error_of = [](const SettingResult& r) {
        return r.refusal.empty() && r.steps > 0 ? r.error.largest_feature() : INFINITY;
    };
    const auto closest =
        std::min_element(report.settings.begin(), report.settings.end(),
                         [&](const auto& a, const auto& b) { return error_of(a) < error_of(b); });
    return static_cast<std::size_t>(closest - report.settings.begin());
}

std::vector<std::size_t> relevant_settings(const AccuracyReport& report) {
    std::vector<std::size_t> places{0};
    for (std::size_t i = 0; i < report.settings.size(); ++i) {
        if (report.settings[i].frontier) {
            places.push_back(i);
        }
    }
    for (const ChoiceCheck& check : report.choices) {
        if (check.chosen >= 0) {
            places.push_back(static_cast<std::size_t>(check.chosen));
        }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

// Number of gearboxes for which there is time; 0 if too few for a result.
long pilot_size(const Study& study, const AccuracyRequest& request, const TimeBudget& time,
                const std::vector<std::size_t>& places, AccuracyReport& report) {
    if (request.gearboxes) {
        return *request.gearboxes;
    }
    double gearbox_s = report.settings[most_accurate_setting(report)].total_s;
    for (const std::size_t place : places) {
        gearbox_s += report.settings[place].total_s;
    }
    const Ensemble& e = study.ensemble;
    const long all = std::min<long>(kPilotGearboxes, e.instances + e.threshold_instances);
    const double needed_s = gearbox_s * static_cast<double>(all);
    if (time.enough(needed_s)) {
        return all;
    }
    const long some = static_cast<long>(std::max(0.0, time.seconds()) / gearbox_s);
    report.left_out.push_back(fmt::format(
        "detection rates of {} gearboxes with each of {} settings{} (to get them, use "
        "--gearboxes {}: about {:.0f} s on one processor)",
        all, places.size(),
        some >= kFewestGearboxes ? fmt::format("; {} gearboxes are used instead", some) : "", all,
        needed_s));
    return some >= kFewestGearboxes ? some : 0;
}

// Standard deviation of every feature at every noise level over the threshold group.
std::vector<double> scatter_of(const Results& results) {
    std::vector<double> all;
    const std::size_t levels = results.noise_levels.size();
    for (const FeatureResult& feature : results.features) {
        for (std::size_t level = 0; level < levels; ++level) {
            std::vector<double> values;
            for (std::size_t row = 0; row < results.group.size(); ++row) {
                const double value = feature.values[row * levels + level];
                if (results.group[row] == static_cast<int>(Group::threshold) &&
                    std::isfinite(value)) {
                    values.push_back(value);
                }
            }
            all.push_back(standard_deviation(values));
        }
    }
    return all;
}

}  // namespace

void measure_detection(const Study& study, const AccuracyRequest& request, const TimeBudget& time,
                       AccuracyReport& report) {
    const std::vector<std::size_t> places = relevant_settings(report);
    const long gearboxes = pilot_size(study, request, time, places, report);
    if (gearboxes == 0) {
        return;
    }
    const Study pilot = pilot_ensemble_study(study, gearboxes);
    const PilotEnsemble reference = run_pilot_ensemble(
        with_setting(pilot, report.settings[most_accurate_setting(report)].setting));
    if (!has_rates(reference)) {
        return;
    }
    report.scatter = scatter_of(reference.results);
    for (const std::size_t place : places) {
        SettingResult& result = report.settings[place];
        request.progress(fmt::format("detection rates with {}", result.setting.text()));
        result.detection =
            detection_change(run_pilot_ensemble(with_setting(pilot, result.setting)), reference);
    }
}

void measure_effect_costs(const Scene& own, const AccuracyRequest& request, const TimeBudget& time,
                          AccuracyReport& report) {
    constexpr double kTimeShare = 0.25;
    // A budget of 0 would have no limit.
    const double seconds =
        std::isfinite(time.seconds()) ? std::max(1e-9, kTimeShare * time.seconds()) : 0.0;
    EffectMeasurement measured = measure_effects(
        own, {.repeats = request.repeats, .seconds = seconds, .progress = request.progress});
    report.effects = std::move(measured.effects);
    if (!measured.omitted.empty()) {
        report.left_out.push_back(
            fmt::format("cost of effects: {}", fmt::join(measured.omitted, ", ")));
    }
}

}  // namespace gearpod::mc
