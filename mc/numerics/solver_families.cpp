#include "mc/numerics/solver_families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/facts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Neighbouring candidates differ by this factor in steps, or by one step per sample.
constexpr double kStepRatio = 1.25;
// Choice keys of [numerics] other than the integrator that change how a step is computed.
constexpr std::string_view kStepOptions[] = {"precision"};

// All combinations of these choices that this version of the program has; the first is the default.
std::vector<std::vector<std::string>> option_combinations() {
    std::vector<std::vector<std::string>> all{{}};
    for (const std::string_view name : kStepOptions) {
        const Key* const key = find_key("numerics", name);
        if (key == nullptr) {
            continue;
        }
        const int normal = *std::get<ChoiceAccess>(key->access).get(Study{});
        const std::vector<std::vector<std::string>> before = all;
        for (const ChoiceName& choice : std::get<ChoiceAccess>(key->access).names) {
            if (choice.value == normal) {
                continue;
            }
            for (std::vector<std::string> options : before) {
                options.push_back(key->path() + "=" + std::string(choice.text));
                all.push_back(options);
            }
        }
    }
    return all;
}

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
constexpr std::string_view kSingle = "numerics.precision=single", kGraded = "numerics.grid=graded";

// Cost of single precision relative to double, eight lanes each.
constexpr double kSingleCost = 0.65;

void add_families(const Study& study, const std::string& integrator,
                  const std::vector<std::string>& options, double beyond,
                  std::vector<SolverFamily>& all) {
    const Numerics& n = study.numerics;
    SolverFamily family{integrator, options, {}, {}, 0, ""};
    bool may_be_graded = false;
    try {
        const Scene scene =
            setting_scene(study, {integrator, n.steps_per_mesh, n.convergence_tolerance, options});
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
        family.other.emplace_back(kGraded);
        family.steps.clear();
        family.grid_tolerances = kGridTolerances;
        all.push_back(family);
    }
}

}  // namespace

SolverSetting SolverFamily::setting(std::size_t place, double convergence_tolerance) const {
    SolverSetting setting{integrator, graded() ? 0 : steps[place], convergence_tolerance, other};
    if (graded()) {
        setting.other.push_back(
            fmt::format("numerics.grid_tolerance={:g}", grid_tolerances[place]));
    }
    return setting;
}

std::vector<SolverFamily> solver_families(const Study& study, double beyond) {
    std::vector<SolverFamily> all;
    for (const std::string& integrator : integrator_names()) {
        if (!study.numerics.integrator ||
            choice_text(study, "numerics", "integrator") == integrator) {
            for (const std::vector<std::string>& options : option_combinations()) {
                add_families(study, integrator, options, beyond, all);
            }
        }
    }
    return all;
}

const std::vector<double>& convergence_tolerances() {
    static const std::vector<double> all{1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
    return all;
}

std::optional<double> step_cost(const Study& study, const std::string& integrator,
                                const std::vector<std::string>& other) {
    const std::span<const lockstep::Integrator> all = lockstep::all_integrators();
    const auto row = std::find_if(all.begin(), all.end(), [&](lockstep::Integrator known_one) {
        return lockstep::name(known_one) == integrator;
    });
    const auto known = [](const std::string& key) {
        return key == kSingle || key.starts_with("numerics.grid") ||
               key.starts_with("numerics.stiffness_tolerance");
    };
    if (row == all.end() || !std::all_of(other.begin(), other.end(), known)) {
        return std::nullopt;
    }
    const bool single = std::find(other.begin(), other.end(), kSingle) != other.end();
    const lockstep::StepCost& cost = lockstep::facts(*row).cost;
    return (single ? kSingleCost : 1.0) * (study.gearbox.kind == GearboxKind::fixed_shaft
                                               ? cost.fixed_shaft
                                           : study.effects.torsional() ? cost.rotations
                                                                       : cost.planetary);
}

}  // namespace gearpod::mc
