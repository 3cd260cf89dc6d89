#include "mc/numerics/accuracy/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"

namespace gearpod::mc {
namespace {

void stiffen_bearings(dynamics::GearboxInputs& inputs, double factor) {
    std::visit(
        [&](auto& kind) {
            for (double& stiffness : kind.bearing_stiffness_N_m) {
                stiffness *= factor;
            }
        },
        inputs);
}

struct HardSystem {
    const char* name;
    dynamics::GearboxMatrices matrices;
};

// The nominal gearbox with the properties of tests/hard that change its stable steps.
std::vector<HardSystem> hard_systems(const StabilityCase& gearbox) {
    const auto& [layout, nominal, pairs] = gearbox;
    dynamics::GearboxInputs stiff = nominal, undamped = nominal;
    stiffen_bearings(stiff, 100.0);
    std::visit([](auto& kind) { kind.mesh_damping = {}; }, undamped);
    std::vector<double> broken = pairs;
    broken.front() = 0.0;
    return {{"bearings 100 times as stiff", dynamics::assemble(layout, stiff, pairs)},
            {"broken tooth: a mesh without stiffness", dynamics::assemble(layout, nominal, broken)},
            {"no mesh damping", dynamics::assemble(layout, undamped, pairs)}};
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
    const std::vector<HardSystem> hard = hard_systems(gearbox);
    for (const HardSystem& system : hard) {
        map.hard.push_back({system.name, {}});
    }
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        if (!lockstep::is_explicit(integrator)) {
            map.implicit.emplace_back(lockstep::name(integrator));
            continue;
        }
        const auto fewest_steps = [&](const dynamics::GearboxMatrices& system) {
            return period_s / lockstep::longest_stable_step(system, integrator);
        };
        StabilityCurve curve{lockstep::name(integrator), {}};
        for (const dynamics::GearboxMatrices& system : systems) {
            curve.steps.push_back(fewest_steps(system));
        }
        for (std::size_t i = 0; i < hard.size(); ++i) {
            map.hard[i].steps.push_back(fewest_steps(hard[i].matrices));
        }
        map.curves.push_back(std::move(curve));
    }
    return map;
}

}  // namespace gearpod::mc
