#include "mc/numerics/solver_families.hpp"

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/facts.hpp"

namespace gearpod::mc {
namespace {

// Neighbouring candidates differ by this factor in steps, or by one step per sample.
constexpr double kStepRatio = 1.25;

// Candidate numbers of steps. A grid has at least one step per sample, and equally many for every
// sample.
std::vector<int> candidate_steps(const Scene& own_rule, double beyond) {
    const int samples = own_rule.samples_per_mesh();
    const int least = (own_rule.least_steps() + samples - 1) / samples;
    // The rule of an explicit method ensures stability only.
    const double further = own_rule.least_steps() > 1 ? 2.0 * beyond : beyond;
    const double most = further * static_cast<double>(own_rule.plan().grid.steps.size()) / samples;
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

void add_families(const Study& study, const SolverSetting& common, double beyond,
                  std::vector<SolverFamily>& all) {
    const Numerics& n = study.numerics;
    SolverFamily family{common, {}, {}, 0, ""};
    bool may_be_graded = false;
    try {
        const Scene scene(with_setting(study, common));
        family.own_steps = static_cast<int>(scene.plan().grid.steps.size());
        if (n.grid == StepGrid::graded) {
            family.grid_tolerances = {n.grid_tolerance};
        } else if (n.steps_per_mesh > 0) {
            family.steps = {n.steps_per_mesh};
        } else {
            family.steps = candidate_steps(scene, beyond);
        }
        // Steps of an explicit method are limited by stability, which is the same everywhere, so
        // grading does not help.
        may_be_graded = n.steps_per_mesh == 0 && n.grid == StepGrid::uniform &&
                        !is_explicit(scene.plan().integrator);
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

SolverSetting SolverFamily::setting(std::size_t place, double convergence_tolerance) const {
    SolverSetting setting = common;
    setting.numerics.steps_per_mesh = graded() ? 0 : steps[place];
    setting.numerics.convergence_tolerance = convergence_tolerance;
    if (graded()) {
        setting.numerics.grid_tolerance = grid_tolerances[place];
        setting.options.emplace_back("grid_tolerance");
    }
    return setting;
}

std::vector<SolverFamily> solver_families(const Study& study, double beyond) {
    std::vector<SolverFamily> all;
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        if (study.numerics.integrator.value_or(integrator) != integrator) {
            continue;
        }
        SolverSetting setting = own_setting(study);
        setting.numerics.integrator = integrator;
        if (setting.numerics.precision == Precision::double_precision) {
            add_families(study, setting, beyond, all);
        }
        setting.numerics.precision = Precision::single_precision;
        setting.options.emplace_back("precision");
        add_families(study, setting, beyond, all);
    }
    return all;
}

const std::vector<double>& convergence_tolerances() {
    static const std::vector<double> all{1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
    return all;
}

std::optional<double> step_cost(const Study& study, const SolverSetting& setting) {
    if (!setting.numerics.integrator || setting.chooses("horizon")) {
        return std::nullopt;
    }
    const lockstep::StepCost& cost = lockstep::facts(*setting.numerics.integrator).cost;
    return (setting.chooses("precision") ? kSingleCost : 1.0) *
           (study.gearbox.kind == GearboxKind::fixed_shaft ? cost.fixed_shaft
            : study.effects.torsional()                    ? cost.rotations
                                                           : cost.planetary);
}

}  // namespace gearpod::mc
