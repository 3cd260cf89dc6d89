#include "mc/numerics/solver_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/facts.hpp"
#include "mc/study/keys/schema_line.hpp"

namespace gearpod::mc {
bool SolverSetting::chooses(std::string_view option) const {
    return std::ranges::find(options, option) != options.end();
}

std::vector<std::string_view> SolverSetting::keys() const {
    std::vector<std::string_view> all{"integrator", "steps_per_mesh", "settle_tolerance"};
    all.insert(all.end(), options.begin(), options.end());
    return all;
}

std::string_view SolverSetting::integrator() const {
    return numerics.integrator ? lockstep::name(*numerics.integrator) : kAutomatic.text;
}

std::vector<std::string> SolverSetting::overrides() const {
    std::vector<std::string> all{
        fmt::format("numerics.integrator={}", integrator()),
        fmt::format("numerics.steps_per_mesh={}", numerics.steps_per_mesh),
        fmt::format("numerics.settle_tolerance={:g}", numerics.convergence_tolerance)};
    for (const std::string_view option : options) {
        all.push_back("numerics." + numerics_text(numerics, option));
    }
    return all;
}

std::string SolverSetting::text() const {
    const int steps = numerics.steps_per_mesh;
    std::string text = fmt::format("{}, {}converged to {:g}", integrator(),
                                   steps > 0 ? fmt::format("{} steps, ", steps) : "",
                                   numerics.convergence_tolerance);
    for (const std::string_view option : options) {
        text += ", " + numerics_text(numerics, option);
    }
    return text;
}

SolverSetting own_setting(const Numerics& numerics) {
    SolverSetting setting{numerics};
    setting.numerics.tolerance = 0.0;
    if (numerics.mass_scaling_Hz > 0.0) {
        setting.options.emplace_back("mass_scaling_Hz");
    }
    return setting;
}

PlannedSteps steps_of(const Planner& planner, const SolverSetting& setting) {
    planner.check(setting.numerics, setting.keys());
    return planner.steps(setting.numerics);
}

namespace {

// Neighbouring candidates differ by this factor in steps, or by one step per sample.
constexpr double kStepRatio = 1.25;

// Candidate numbers of steps. A grid has at least one step per sample, and equally many for every
// sample. `rule`: steps by the integrator's own rule.
std::vector<int> candidate_steps(const PlannedSteps& rule, double beyond) {
    const int samples = rule.samples;
    const int least = (rule.least + samples - 1) / samples;
    // The rule of an explicit method ensures stability only.
    const double further = rule.least > 1 ? 2.0 * beyond : beyond;
    const double most = further * static_cast<double>(rule.steps) / samples;
    std::vector<int> steps;
    for (int a_sample = least; a_sample <= std::max<double>(most, least);
         a_sample = std::max(a_sample + 1, static_cast<int>(std::lround(kStepRatio * a_sample)))) {
        steps.push_back(a_sample * samples);
    }
    return steps;
}

// Tolerances of the signals for graded grids; the error of a feature is mostly smaller.
const std::vector<double> kGridTolerances{3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};

// Cost of single precision relative to double, eight lanes each.
constexpr double kSingleCost = 0.65;

void add_families(const Planner& planner, const Numerics& n, const SolverSetting& common,
                  double beyond, std::vector<SolverFamily>& all) {
    SolverFamily family{common, {}, {}, 0, ""};
    bool may_be_graded = false;
    try {
        const PlannedSteps rule = steps_of(planner, common);
        family.own_steps = rule.steps;
        if (n.grid == StepGrid::graded) {
            family.grid_tolerances = {n.grid_tolerance};
        } else if (n.steps_per_mesh > 0) {
            family.steps = {n.steps_per_mesh};
        } else {
            family.steps = candidate_steps(rule, beyond);
        }
        // Steps of an explicit method are limited by stability, which is the same everywhere, so
        // grading does not help.
        may_be_graded =
            n.steps_per_mesh == 0 && n.grid == StepGrid::uniform && !is_explicit(rule.integrator);
    } catch (const SceneError& error) {
        family.refusal = error.what();
    }
    all.push_back(family);
    if (may_be_graded) {
        family.common.numerics.grid = StepGrid::graded;
        family.common.options.emplace_back("grid");
        family.steps.clear();
        family.grid_tolerances = kGridTolerances;
        all.push_back(family);
    }
}

}  // namespace

SolverSetting SolverFamily::setting(std::size_t index, double convergence_tolerance) const {
    SolverSetting setting = common;
    setting.numerics.steps_per_mesh = graded() ? 0 : steps[index];
    setting.numerics.convergence_tolerance = convergence_tolerance;
    if (graded()) {
        setting.numerics.grid_tolerance = grid_tolerances[index];
        setting.options.emplace_back("grid_tolerance");
    }
    return setting;
}

std::vector<SolverFamily> solver_families(const Planner& planner, const Numerics& numerics,
                                          double beyond) {
    std::vector<SolverFamily> all;
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        if (numerics.integrator.value_or(integrator) != integrator) {
            continue;
        }
        SolverSetting setting = own_setting(numerics);
        setting.numerics.integrator = integrator;
        if (setting.numerics.precision == Precision::double_precision) {
            add_families(planner, numerics, setting, beyond, all);
        }
        setting.numerics.precision = Precision::single_precision;
        setting.options.emplace_back("precision");
        add_families(planner, numerics, setting, beyond, all);
    }
    return all;
}

const std::vector<double>& convergence_tolerances() {
    static const std::vector<double> all{1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
    return all;
}

std::optional<double> step_cost(const SolverFacts& facts, const SolverSetting& setting) {
    if (!setting.numerics.integrator || setting.chooses("horizon")) {
        return std::nullopt;
    }
    return (setting.chooses("precision") ? kSingleCost : 1.0) *
           lockstep::facts(*setting.numerics.integrator).cost.*facts.step_cost;
}

}  // namespace gearpod::mc
