// measure_accuracy(): measures time and error of the solver settings.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lockstep/integrators/facts.hpp"
#include "machine/upper_median.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/accuracy/measured_settings.hpp"
#include "mc/numerics/accuracy/report.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/numerics/time_budget.hpp"
#include "mc/study/random/philox.hpp"

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
    std::vector<std::size_t> indices{0};
    for (std::size_t i = 0; i < report.settings.size(); ++i) {
        if (report.settings[i].frontier) {
            indices.push_back(i);
        }
    }
    for (const ChoiceCheck& check : report.choices) {
        if (check.chosen >= 0) {
            indices.push_back(static_cast<std::size_t>(check.chosen));
        }
    }
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return indices;
}

// Number of gearboxes for which there is time; 0 if too few for a result.
long pilot_size(const Planner& planner, const AccuracyRequest& request, const TimeBudget& time,
                const std::vector<std::size_t>& indices, AccuracyReport& report) {
    if (request.gearboxes) {
        return *request.gearboxes;
    }
    double gearbox_s = report.settings[most_accurate_setting(report)].total_s;
    for (const std::size_t i : indices) {
        gearbox_s += report.settings[i].total_s;
    }
    const long all = std::min(kPilotGearboxes, planner.facts().gearboxes);
    const double needed_s = gearbox_s * static_cast<double>(all);
    if (time.enough(needed_s)) {
        return all;
    }
    const long some = static_cast<long>(std::max(0.0, time.seconds()) / gearbox_s);
    report.left_out.push_back(fmt::format(
        "detection rates of {} gearboxes with each of {} settings{} (to get them, use "
        "--gearboxes {}: about {:.0f} s on one processor)",
        all, indices.size(),
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

// Fills SettingResult::detection of the most relevant solver settings (the Pareto frontier, the
// study's own and the chosen ones), compared with the most accurate setting. Uses the requested
// number of gearboxes, or as many as there is time for, and records what was omitted.
void measure_detection(const Planner& planner, const AccuracyRequest& request,
                       const TimeBudget& time, AccuracyReport& report) {
    const std::vector<std::size_t> indices = relevant_settings(report);
    const long gearboxes = pilot_size(planner, request, time, indices, report);
    if (gearboxes == 0) {
        return;
    }
    const Planner pilot = planner.with_gearboxes(gearboxes);
    const auto run = [&](const SolverSetting& setting) {
        pilot.check(setting.numerics, setting.keys());
        return run_pilot_ensemble(pilot.tile(setting.numerics), pilot.ensemble(setting.numerics));
    };
    const PilotEnsemble reference = run(report.settings[most_accurate_setting(report)].setting);
    if (!has_rates(reference)) {
        return;
    }
    report.scatter = scatter_of(reference.results);
    for (const std::size_t i : indices) {
        SettingResult& result = report.settings[i];
        request.progress(fmt::format("detection rates with {}", result.setting.text()));
        result.detection = detection_change(run(result.setting), reference);
    }
}

// Measures AccuracyReport::effects in a quarter of `time`, and records what was omitted.
void measure_effect_costs(const Planner& planner, const AccuracyRequest& request,
                          const TimeBudget& time, AccuracyReport& report) {
    constexpr double kTimeShare = 0.25;
    // A budget of 0 would have no limit.
    const double seconds =
        std::isfinite(time.seconds()) ? std::max(1e-9, kTimeShare * time.seconds()) : 0.0;
    EffectMeasurement measured = measure_effects(
        planner, {.repeats = request.repeats, .seconds = seconds, .progress = request.progress});
    report.effects = std::move(measured.effects);
    if (!measured.omitted.empty()) {
        report.left_out.push_back(
            fmt::format("cost of effects: {}", fmt::join(measured.omitted, ", ")));
    }
}

// Settings slower than equally accurate ones by more than this factor are timed only once.
constexpr double kNearFrontier = 3.0;
// Settings within this factor of the fastest for a tolerance are timed more often.
constexpr double kContender = 1.5;
constexpr int kContenderRepeats = 10;
// Fraction of the processor time for the reference.
constexpr double kReferenceErrorShare = 1.0 / 3.0;
// Stiffness tolerances tried with the fastest setting for each tolerance.
constexpr double kStiffnessTolerances[] = {1e-8, 1e-6, 1e-5, 1e-4, 1e-3};

class AccuracyMeasurement {
  public:
    AccuracyMeasurement(const Planner& planner, const AccuracyRequest& request)
        : planner_(planner),
          facts_(planner.facts()),
          request_(request),
          time_(request.seconds),
          pilot_(planner) {
        const TilePlan plan = planner.tile(facts_.numerics);
        report_.features = facts_.features;
        report_.noise_levels = facts_.noise_levels;
        report_.gearboxes = static_cast<int>(pilot_.size());
        report_.signal_meshes = pilot_.signal_meshes();
        report_.span_meshes = plan.record.span.meshes();
        report_.mesh_frequency_Hz = plan.gearbox->mesh_frequency_Hz;
        report_.explicit_limit.steps = plan.solve->stepping().explicit_steps;
        own_steps_ = planner.steps(facts_.numerics);
        stability_case_ = {plan.solve->integration().layout,
                           plan.gearbox->inputs(plan.gearbox->nominal),
                           plan.gearbox->stiffness->stiffest_pairs()};
    }

    AccuracyReport run() {
        request_.progress("reference: refining two methods until they agree");
        ReferenceRequest reference;
        reference.seconds = kReferenceErrorShare * time_.seconds();
        report_.reference =
            converged_reference(pilot_, without_setting(facts_.numerics), reference);
        measure_effect_costs(planner_, request_, time_, report_);
        for (const ListedSetting& listed : listed_settings(planner_)) {
            add(listed.setting, listed.refusal);
        }
        times_.resize(report_.settings.size());
        request_.progress(fmt::format("{} solver settings", report_.settings.size()));
        measure_new(0);
        finish_times();
        for (const double tolerance : request_.tolerances) {
            choose(tolerance);
        }
        loosen_convergence();
        for (int repeat = 1; repeat < request_.repeats; ++repeat) {
            finish_times();
            request_.progress(fmt::format("timing {} of {}", repeat + 1, request_.repeats));
            if (!time_again()) {
                record_omission(fmt::format("all but {} of {} timings", repeat, request_.repeats));
                break;
            }
        }
        measure_truncated_stiffness();
        time_contenders();
        finish_times();
        for (ChoiceCheck& check : report_.choices) {
            compare(check);
        }
        mark_frontier();
        measure_explicit_limit();
        check_step_costs();
        report_.stability = stability_map(stability_case_, own_steps_);
        measure_detection(planner_, request_, time_, report_);
        return std::move(report_);
    }

  private:
    void add(const SolverSetting& setting, const std::string& refusal = "") {
        report_.settings.emplace_back();
        report_.settings.back().setting = setting;
        report_.settings.back().refusal = refusal;
    }

    // Measures the fastest settings again with fewer terms in the stiffness curves.
    void measure_truncated_stiffness() {
        if (!time_.enough()) {
            return record_omission("settings with shorter stiffness series");
        }
        finish_times();
        std::vector<SolverSetting> fastest_settings;
        for (const ChoiceCheck& check : report_.choices) {
            const double best = fastest(check.tolerance);
            for (const SettingResult& result : report_.settings) {
                if (holds(result, check.tolerance) && result.integration_s == best &&
                    std::ranges::find(fastest_settings, result.setting) == fastest_settings.end()) {
                    fastest_settings.push_back(result.setting);
                }
            }
        }
        const std::size_t first = report_.settings.size();
        for (const SolverSetting& setting : fastest_settings) {
            for (const double tolerance : kStiffnessTolerances) {
                SolverSetting thin = setting;
                thin.numerics.stiffness_tolerance = tolerance;
                thin.options.emplace_back("stiffness_tolerance");
                add(thin);
            }
        }
        times_.resize(report_.settings.size());
        request_.progress(fmt::format("{} settings with shorter stiffness series",
                                      report_.settings.size() - first));
        measure_new(first);
    }

    // Measures looser convergence tolerances; settings with the same steps use one scene in turn.
    void loosen_convergence() {
        if (!time_.enough()) {
            return record_omission("settings with a larger settle_tolerance");
        }
        finish_times();
        std::vector<SolverSetting> loose;
        for (const SettingResult& result : report_.settings) {
            if (!result.refusal.empty() || !near_frontier(result) ||
                result.setting.numerics.convergence_tolerance != convergence_tolerances().front() ||
                !result.setting.numerics.integrator || integrates_every_mesh(result.setting)) {
                continue;
            }
            for (std::size_t i = 1; i < convergence_tolerances().size(); ++i) {
                loose.push_back(result.setting);
                loose.back().numerics.convergence_tolerance = convergence_tolerances()[i];
            }
        }
        const std::size_t first = report_.settings.size();
        for (const SolverSetting& setting : loose) {
            if (index_of(setting, report_.settings) == report_.settings.size()) {
                add(setting);
            }
        }
        times_.resize(report_.settings.size());
        request_.progress(fmt::format("measuring {} settings with a larger settle_tolerance",
                                      report_.settings.size() - first));
        measure_new(first);
    }

    bool near_frontier(const SettingResult& result) const {
        return std::ranges::none_of(report_.settings, [&](const SettingResult& other) {
            return other.steps > 0 &&
                   other.error.largest_feature() <= result.error.largest_feature() &&
                   kNearFrontier * other.integration_s < result.integration_s;
        });
    }

    void record_omission(const std::string& what) { report_.left_out.push_back(what); }

    // Lower bound of the processor time of a setting, s; only known where every mesh period is
    // integrated.
    double least_s(const SolverSetting& setting) const {
        const double meshes = report_.settings[0].meshes;
        return integrates_every_mesh(setting) && meshes > 0.0 && !times_[0].run.empty()
                   ? times_[0].run.front() * report_.gearboxes * report_.span_meshes / meshes
                   : 0.0;
    }

    void measure_new(std::size_t from) {
        int untried = 0;
        for (const std::size_t i : cheapest_first(facts_, report_.settings, from)) {
            SettingResult& result = report_.settings[i];
            if (i > 0 && result.refusal.empty() && !time_.enough(least_s(result.setting))) {
                result.refusal = kNotTried;
                ++untried;
                continue;
            }
            measure_setting(i, true);
        }
        if (untried > 0) {
            record_omission(fmt::format("{} solver settings", untried));
        }
    }

    // Times the settings again; false if the time ran out.
    bool time_again() {
        for (std::size_t i = 0; i < report_.settings.size(); ++i) {
            if (!time_.enough()) {
                return false;
            }
            if (near_frontier(report_.settings[i])) {
                measure_setting(i, false);
            }
        }
        return true;
    }

    void measure_setting(std::size_t index, bool first) {
        SettingResult& result = report_.settings[index];
        if (!result.refusal.empty() || (integrates_every_mesh(result.setting) && !first)) {
            return;
        }
        try {
            planner_.check(result.setting.numerics, result.setting.keys());
            const PilotRecord record = pilot_.run(result.setting.numerics);
            times_[index].run.push_back(record.integration_s);
            times_[index].total.push_back(record.total_s);
            if (first) {
                fill(record, result);
            }
        } catch (const SceneError& error) {
            result.refusal = error.what();
        }
    }

    void fill(const PilotRecord& record, SettingResult& result) const {
        result.steps = record.steps;
        result.meshes = record.meshes_per_tile();
        result.failed = static_cast<double>(std::count(record.ok.begin(), record.ok.end(), false));
        result.error = pilot_error(record, report_.reference.record);
        SolverSetting setting = result.setting;
        // The integrator of the study's own setting may be chosen by the program.
        setting.numerics.integrator = setting.numerics.integrator.value_or(own_steps_.integrator);
        result.cost = step_cost(facts_, setting).value_or(0.0) * result.steps * result.meshes;
    }

    bool holds(const SettingResult& r, double tolerance) const {
        return r.refusal.empty() && r.steps > 0 && r.error.largest_feature() <= tolerance;
    }

    // Finds the setting that numerics.tolerance chooses, and measures it if it is new.
    void choose(double tolerance) {
        request_.progress(fmt::format("setting for numerics.tolerance = {:g}", tolerance));
        ChoiceCheck check;
        check.tolerance = tolerance;
        if (!time_.enough()) {
            check.refusal = kNotTried;
            record_omission(fmt::format("the setting for numerics.tolerance = {:g}", tolerance));
            report_.choices.push_back(check);
            return;
        }
        Numerics numerics = without_setting(facts_.numerics);
        numerics.tolerance = tolerance;
        try {
            const SolverSetting setting = resolve_numerics(planner_, numerics).choice->setting;
            const std::size_t index = index_of(setting, report_.settings);
            check.chosen = static_cast<int>(index);
            if (index == report_.settings.size()) {
                add(setting);
                times_.emplace_back();
                measure_setting(index, true);
            }
        } catch (const SceneError& error) {
            check.refusal = error.what();
        }
        report_.choices.push_back(check);
    }

    // Times the contenders alternately, so that other load slows all of them equally.
    void time_contenders() {
        finish_times();
        std::vector<std::size_t> contenders;
        for (const ChoiceCheck& check : report_.choices) {
            const double best = fastest(check.tolerance);
            for (std::size_t i = 0; i < report_.settings.size(); ++i) {
                if ((holds(report_.settings[i], check.tolerance) &&
                     report_.settings[i].integration_s < kContender * best) ||
                    static_cast<int>(i) == check.chosen) {
                    contenders.push_back(i);
                }
            }
        }
        std::sort(contenders.begin(), contenders.end());
        contenders.erase(std::unique(contenders.begin(), contenders.end()), contenders.end());
        request_.progress(fmt::format("repeat {} of the fastest settings", contenders.size()));
        for (int repeat = 0; repeat < kContenderRepeats; ++repeat) {
            for (const std::size_t index : contenders) {
                if (!time_.enough()) {
                    record_omission(
                        fmt::format("repeated timings ({} of {} done)", repeat, kContenderRepeats));
                    return;
                }
                measure_setting(index, false);
            }
        }
    }

    double fastest(double tolerance) const {
        double best = INFINITY;
        for (const SettingResult& result : report_.settings) {
            best = holds(result, tolerance) ? std::min(best, result.integration_s) : best;
        }
        return best;
    }

    void finish_times() {
        for (std::size_t i = 0; i < report_.settings.size(); ++i) {
            SettingResult& result = report_.settings[i];
            if (times_[i].run.empty()) {
                continue;
            }
            result.integration_s = *std::min_element(times_[i].run.begin(), times_[i].run.end());
            result.integration_median_s = machine::upper_median(times_[i].run);
            result.total_s = *std::min_element(times_[i].total.begin(), times_[i].total.end());
            result.mesh_s = result.integration_s / result.meshes;
        }
    }

    void compare(ChoiceCheck& check) const {
        const double best = fastest(check.tolerance);
        for (std::size_t i = 0; i < report_.settings.size(); ++i) {
            if (holds(report_.settings[i], check.tolerance) &&
                report_.settings[i].integration_s == best) {
                check.best = static_cast<int>(i);
            }
        }
        if (check.chosen >= 0 && check.best >= 0) {
            check.over_best =
                report_.settings[static_cast<std::size_t>(check.chosen)].integration_s / best - 1.0;
        }
    }

    void mark_frontier() {
        std::vector<SettingResult*> integrated;
        for (SettingResult& result : report_.settings) {
            if (result.refusal.empty() && std::isfinite(result.error.largest_feature())) {
                integrated.push_back(&result);
            }
        }
        std::sort(integrated.begin(), integrated.end(),
                  [](const auto* a, const auto* b) { return a->integration_s < b->integration_s; });
        double least = INFINITY;
        for (SettingResult* result : integrated) {
            result->frontier = result->error.largest_feature() < least;
            least = std::min(least, result->error.largest_feature());
        }
    }

    void measure_explicit_limit() {
        ExplicitLimit& limit = report_.explicit_limit;
        const TilePlan plan = planner_.tile(facts_.numerics);
        limit.step_s = explicit_step_s(*plan.gearbox, *plan.solve);
        limit.meshes = report_.settings[0].meshes;
        limit.refused = std::ranges::none_of(report_.settings, [](const auto& r) {
            return r.setting.numerics.integrator == lockstep::kUsualExplicit && r.refusal.empty();
        });
    }

    // Compares the measured times of steps with the cost model's table.
    void check_step_costs() {
        struct StepCosts {
            std::vector<double> measured;
            double modelled = 0.0;
        };
        std::map<std::string_view, StepCosts> all;
        for (const SettingResult& r : report_.settings) {
            if (r.steps > 0 && r.setting.numerics.integrator && r.setting.options.empty()) {
                StepCosts& costs = all[r.setting.integrator()];
                costs.measured.push_back(r.mesh_s / r.steps);
                costs.modelled = step_cost(facts_, r.setting).value();
            }
        }
        for (auto& [integrator, costs] : all) {
            report_.step_costs.push_back(
                fmt::format("{}: {:.1f} measured, {:.1f} in the table", integrator,
                            machine::upper_median(costs.measured) / report_.explicit_limit.step_s,
                            costs.modelled));
        }
    }

    struct Times {
        std::vector<double> run, total;
    };
    const Planner& planner_;
    const SolverFacts& facts_;
    const AccuracyRequest& request_;
    const TimeBudget time_;
    const Pilot pilot_;
    PlannedSteps own_steps_;
    StabilityCase stability_case_;
    AccuracyReport report_;
    std::vector<Times> times_;
};

}  // namespace

AccuracyReport measure_accuracy(const Planner& planner, const AccuracyRequest& request) {
    return AccuracyMeasurement(planner, request).run();
}

}  // namespace gearpod::mc
