#include "mc/accuracy_ladder.hpp"

#include <algorithm>
#include <cmath>

#include "mc/schema.hpp"

namespace gearpod::mc {
namespace {

// Steps of neighbouring rungs differ by this factor, or by one step a sample.
constexpr double kStepRatio = 1.25;
// The choices of [numerics] that change how a step is taken, besides the integrator. Graded grids
// are no rungs: each would take a pilot of its own, with its own tolerance.
constexpr std::string_view kWays[] = {"precision"};

// All combinations of those choices that a program of this version has; the first is the default.
std::vector<std::vector<std::string>> ways() {
    std::vector<std::vector<std::string>> all{{}};
    for (const std::string_view name : kWays) {
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
            for (std::vector<std::string> way : before) {
                way.push_back(key->path() + "=" + std::string(choice.text));
                all.push_back(way);
            }
        }
    }
    return all;
}

// A grid has at least one step a sample, and as many for every sample.
std::vector<int> step_ladder(const Scene& own_rule, double beyond) {
    const int samples = own_rule.samples_per_mesh();
    const int least = (own_rule.least_steps() + samples - 1) / samples;
    // An explicit method's rule sees to stability alone.
    const double further = own_rule.least_steps() > 1 ? 2.0 * beyond : beyond;
    const double most = further * static_cast<double>(own_rule.plan().grid.steps.size()) / samples;
    std::vector<int> steps;
    for (int a_sample = least; a_sample <= std::max<double>(most, least);
         a_sample = std::max(a_sample + 1, static_cast<int>(std::lround(kStepRatio * a_sample)))) {
        steps.push_back(a_sample * samples);
    }
    return steps;
}

struct StepCost {
    std::string_view integrator;
    double planetary, rotations, fixed_shaft;
};
constexpr StepCost kStepCosts[] = {
    {"rk4", 1.0, 1.0, 1.0},    {"newmark", 4.3, 2.0, 2.6},
    {"sdirk3", 6.8, 4.0, 4.2}, {"generalized-alpha", 2.4, 2.0, 1.4},
    {"bs3", 0.9, 0.9, 0.9},    {"central-difference", 0.32, 0.34, 0.34}};
// Of singles, eight abreast, over doubles.
constexpr double kSingleCost = 0.65;

}  // namespace

std::vector<Flight> flights(const Study& study, double beyond) {
    std::vector<Flight> all;
    for (const std::string& integrator : integrator_names()) {
        if (study.numerics.integrator != Integrator::automatic &&
            choice_text(study, "numerics", "integrator") != integrator) {
            continue;
        }
        for (const std::vector<std::string>& way : ways()) {
            Flight flight{integrator, way, {}, 0, ""};
            try {
                const auto scene = rung_scene(study, {integrator, study.numerics.steps_per_mesh,
                                                      study.numerics.settle_tolerance, way});
                flight.own_steps = static_cast<int>(scene->plan().grid.steps.size());
                flight.steps = study.numerics.steps_per_mesh > 0
                                   ? std::vector<int>{study.numerics.steps_per_mesh}
                                   : step_ladder(*scene, beyond);
            } catch (const SceneError& error) {
                flight.refusal = error.what();
            }
            all.push_back(flight);
        }
    }
    return all;
}

const std::vector<double>& settle_tolerances() {
    static const std::vector<double> all{1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
    return all;
}

std::optional<double> step_cost(const Study& study, const std::string& integrator,
                                const std::vector<std::string>& other) {
    const auto* row = std::find_if(std::begin(kStepCosts), std::end(kStepCosts),
                                   [&](const StepCost& c) { return c.integrator == integrator; });
    const bool single = other == std::vector<std::string>{"numerics.precision=single"};
    if (row == std::end(kStepCosts) || !(other.empty() || single)) {
        return std::nullopt;
    }
    return (single ? kSingleCost : 1.0) * (study.gearbox.kind == GearboxKind::fixed_shaft
                                               ? row->fixed_shaft
                                           : study.effects.torsional() ? row->rotations
                                                                       : row->planetary);
}

}  // namespace gearpod::mc
