#include "mc/numerics/accuracy/measured_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {
namespace {

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

Numerics without_setting(Numerics numerics) {
    numerics.integrator.reset();
    numerics.steps_per_mesh = 0;
    numerics.mass_scaling_Hz = 0.0;
    numerics.precision = Precision::double_precision;
    numerics.lanes = std::min(numerics.lanes, full_lanes(Precision::double_precision));
    return numerics;
}

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

bool integrates_every_mesh(const SolverSetting& setting) {
    return setting.chooses("horizon");
}

std::size_t index_of(const SolverSetting& setting, const std::vector<SettingResult>& settings) {
    const auto same = std::ranges::find(settings, setting, &SettingResult::setting);
    return static_cast<std::size_t>(same - settings.begin());
}

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

}  // namespace gearpod::mc
