// measure_accuracy(): measures time and error of the solver settings.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/accuracy/report.hpp"
#include "mc/numerics/measured_effects.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {

namespace {

using analysis::SizeEstimate;

// True if a value raises the alarm.
bool alarm(const analysis::FeatureDetection& feature, std::size_t level, double value) {
    return analysis::is_alarm(value, feature.levels[level].threshold, feature.alarm);
}

double share_of_alarms_changed(const Results& a, const Results& b) {
    const std::size_t levels = a.noise_levels.size();
    long changed = 0, all = 0;
    for (std::size_t f = 0; f < a.features.size(); ++f) {
        for (std::size_t row = 0; row < a.group.size(); ++row) {
            if (a.group[row] != static_cast<int>(Group::test)) {
                continue;
            }
            for (std::size_t level = 0; level < levels; ++level) {
                const std::size_t value = row * levels + level;
                changed += alarm(a.detection[f], level, a.features[f].values[value]) !=
                                   alarm(b.detection[f], level, b.features[f].values[value])
                               ? 1
                               : 0;
                ++all;
            }
        }
    }
    return all > 0 ? static_cast<double>(changed) / static_cast<double>(all) : 0.0;
}

void compare_rates(const Results& here, const Results& reference, DetectionChange& change) {
    for (std::size_t f = 0; f < reference.detection.size(); ++f) {
        for (std::size_t level = 0; level < reference.noise_levels.size(); ++level) {
            const auto& cells = reference.detection[f].levels[level].cells;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const double moved =
                    std::abs(here.detection[f].levels[level].cells[c].pd - cells[c].pd);
                if (moved > change.pd || change.pd_half_width == 0.0) {
                    change.pd = std::max(change.pd, moved);
                    change.pd_half_width = 0.5 * (cells[c].upper - cells[c].lower);
                }
            }
        }
    }
}

bool reached(const SizeEstimate& estimate) {
    return estimate.where == SizeEstimate::Where::reached;
}

void compare_sizes(const analysis::Reliability& here, const analysis::Reliability& reference,
                   DetectionChange& change) {
    for (std::size_t f = 0; f < reference.features.size(); ++f) {
        for (std::size_t level = 0; level < reference.features[f].levels.size(); ++level) {
            const auto& there = reference.features[f].levels[level].hit_miss;
            const auto& compared = here.features[f].levels[level].hit_miss;
            if (!there.refusal.empty() || !compared.refusal.empty() ||
                !reached(there.a90.estimate) || !reached(compared.a90.estimate)) {
                continue;
            }
            const double a90 = there.a90.estimate.size;
            const double moved = std::abs(compared.a90.estimate.size - a90) / a90;
            if (moved > change.a90) {
                change.a90 = moved;
                change.a90_interval =
                    reached(there.a90.upper) ? (there.a90.upper.size - a90) / a90 : INFINITY;
            }
        }
    }
}

// Results of a pilot ensemble and the reliability derived from them.
struct PilotEnsemble {
    Results results;
    std::optional<analysis::Reliability> reliability;
};

PilotEnsemble run_pilot_ensemble(const TilePlan& tile, const EnsemblePlan& ensemble) {
    Progress silent(1, true);
    PilotEnsemble pilot;
    pilot.results = run_ensemble(tile, ensemble, silent);
    pilot.results.detection = detect_all(pilot.results);
    pilot.reliability =
        reliability_of(pilot.results, ColumnRows(pilot.results), "", thread_count(ensemble));
    return pilot;
}

// True if the healthy sample is large enough for thresholds.
bool has_rates(const PilotEnsemble& pilot) {
    const auto has_threshold = [](const analysis::LevelDetection& level) {
        return std::isfinite(level.threshold);
    };
    return std::any_of(pilot.results.detection.begin(), pilot.results.detection.end(),
                       [&](const analysis::FeatureDetection& feature) {
                           return std::any_of(feature.levels.begin(), feature.levels.end(),
                                              has_threshold);
                       });
}

DetectionChange detection_change(const PilotEnsemble& here, const PilotEnsemble& reference) {
    DetectionChange change;
    change.gearboxes = std::count(reference.results.group.begin(), reference.results.group.end(),
                                  static_cast<int>(Group::test));
    change.alarms = share_of_alarms_changed(here.results, reference.results);
    compare_rates(here.results, reference.results, change);
    if (here.reliability && reference.reliability) {
        compare_sizes(*here.reliability, *reference.reliability, change);
    }
    return change;
}

}  // namespace

StabilityMap stability_map(const StabilityCase& gearbox, const PlannedSteps& own) {
    constexpr int kFactors = 13;  // from 0.01 to 100, three in a decade
    const double period_s = dynamics::mesh_period_s(gearbox.nominal);
    StabilityMap map;
    map.own = lockstep::name(own.integrator);
    map.own_steps = own.steps;
    std::vector<dynamics::GearboxMatrices> systems;
    for (int i = 0; i < kFactors; ++i) {
        map.factors.push_back(std::pow(10.0, (i - kFactors / 2) / 3.0));
        std::vector<double> pairs = gearbox.stiffest_pairs;
        for (double& stiffness : pairs) {
            stiffness *= map.factors.back();
        }
        systems.push_back(dynamics::assemble(gearbox.layout, gearbox.nominal, pairs));
    }
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        if (!lockstep::is_explicit(integrator)) {
            map.implicit.emplace_back(lockstep::name(integrator));
            continue;
        }
        StabilityCurve curve{lockstep::name(integrator), {}};
        for (const dynamics::GearboxMatrices& system : systems) {
            curve.steps.push_back(period_s / lockstep::longest_stable_step(system, integrator));
        }
        map.curves.push_back(std::move(curve));
    }
    return map;
}

namespace {

// Numerics without a given integrator, number of steps, mass scaling and single precision.
Numerics without_setting(Numerics numerics) {
    numerics.integrator.reset();
    numerics.steps_per_mesh = 0;
    numerics.mass_scaling_Hz = 0.0;
    numerics.precision = Precision::double_precision;
    numerics.lanes = std::min(numerics.lanes, full_lanes(Precision::double_precision));
    return numerics;
}

// Candidates have up to this many times the steps of an integrator's own rule, which aims at 0.1 %.
constexpr double kListedBeyondOwnRule = 1.5;
// Only three graded grids are measured, because each one costs a pilot. None is made if its fewest
// steps would cost more than this many times the least expensive integrator's own steps.
constexpr double kListedGridTolerances[] = {1e-2, 1e-3, 1e-4};
constexpr double kWorthGrading = 3.0;

// Cost of the integrator's own uniform steps, in rk4 steps.
double own_cost(const SolverFacts& facts, const SolverFamily& family) {
    const auto cost = step_cost(facts, family.common);
    return cost && family.own_steps > 0 ? *cost * family.own_steps : INFINITY;
}

void add_graded(const SolverFacts& facts, const SolverFamily& family, double least_cost,
                std::vector<ListedSetting>& all) {
    const double over = kFewestGradedFraction * own_cost(facts, family) / least_cost;
    if (over > kWorthGrading) {
        all.push_back({family.common,
                       fmt::format("not measured: even with an eighth of its {} uniform steps it "
                                   "would cost {:.0f} times as much as the least expensive "
                                   "integrator",
                                   family.own_steps, over)});
        return;
    }
    for (std::size_t i = 0; i < family.size(); ++i) {
        if (std::find(std::begin(kListedGridTolerances), std::end(kListedGridTolerances),
                      family.grid_tolerances[i]) != std::end(kListedGridTolerances)) {
            all.push_back({family.setting(i, convergence_tolerances().front()), ""});
        }
    }
}

// Longer steps of central differences by mass scaling, in both precisions; none for a study that
// cannot use it.
void add_scaled(const Planner& planner, std::vector<ListedSetting>& all) {
    constexpr int kMostScaledSteps = 8;  // per sample
    SolverSetting setting = own_setting(without_setting(planner.facts().numerics));
    setting.numerics.integrator = lockstep::Integrator::central_difference;
    setting.numerics.convergence_tolerance = convergence_tolerances().front();
    setting.options.emplace_back("mass_scaling_Hz");
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        setting.numerics.precision = precision;
        if (precision == Precision::single_precision) {
            setting.options.emplace_back("precision");
        }
        try {
            const PlannedSteps unscaled = steps_of(planner, setting);
            const double fastest_Hz = planner.fastest_mode_Hz(setting.numerics);
            for (int a_sample = 1;
                 a_sample <= kMostScaledSteps && a_sample * unscaled.samples < unscaled.least;
                 ++a_sample) {
                if (const auto numerics = scaled_numerics(planner, setting.numerics, fastest_Hz,
                                                          a_sample * unscaled.samples)) {
                    all.push_back({{*numerics, setting.options}, ""});
                }
            }
        } catch (const SceneError&) {  // the method or the scaling is invalid for this study
        }
    }
}

}  // namespace

std::vector<ListedSetting> listed_settings(const Planner& planner) {
    const SolverFacts& facts = planner.facts();
    const std::vector<SolverFamily> all_families =
        solver_families(planner, without_setting(facts.numerics), kListedBeyondOwnRule);
    double least_cost = INFINITY;
    for (const SolverFamily& family : all_families) {
        least_cost = family.graded() ? least_cost : std::min(least_cost, own_cost(facts, family));
    }
    std::vector<ListedSetting> all{{own_setting(facts.numerics), ""}};
    for (const SolverFamily& family : all_families) {
        if (family.graded()) {
            add_graded(facts, family, least_cost, all);
            continue;
        }
        if (family.size() == 0) {
            all.push_back({family.common, family.refusal});
        }
        for (std::size_t i = 0; i < family.size(); ++i) {
            all.push_back({family.setting(i, convergence_tolerances().front()), ""});
        }
    }
    add_scaled(planner, all);
    if (facts.every_mesh) {
        SolverSetting full = own_setting(facts.numerics);
        full.numerics.horizon = *facts.every_mesh;
        full.options.emplace_back("horizon");
        all.push_back({full, ""});
    }
    return all;
}

namespace {

bool integrates_every_mesh(const SolverSetting& setting) {
    return setting.chooses("horizon");
}

// Index of a setting in `settings`; settings.size() if it is not among them.
std::size_t index_of(const SolverSetting& setting, const std::vector<SettingResult>& settings) {
    const auto same = std::ranges::find(settings, setting, &SettingResult::setting);
    return static_cast<std::size_t>(same - settings.begin());
}

// Indices of `settings` from `from` on in the order of measurement: index 0 first, then by the cost
// model's time of a mesh period, those of unknown cost last.
std::vector<std::size_t> cheapest_first(const SolverFacts& facts,
                                        const std::vector<SettingResult>& settings,
                                        std::size_t from) {
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = from; i < settings.size(); ++i) {
        const SolverSetting& setting = settings[i].setting;
        const auto step = step_cost(facts, setting);
        const int steps = setting.numerics.steps_per_mesh;
        const double cost = step && steps > 0 ? *step * steps : INFINITY;
        costs.emplace_back(i == 0 ? 0.0 : cost, i);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<std::size_t> order;
    for (const auto& [cost, index] : costs) {
        order.push_back(index);
    }
    return order;
}

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
