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
std::vector<HardSystem> hard_systems(const Scene& scene, const dynamics::GearboxInputs& nominal) {
    const dynamics::GearboxLayout& layout = scene.plan().layout;
    const std::vector<double>& pairs = scene.stiffest_pairs();
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

StabilityMap stability_map(const Scene& scene) {
    constexpr int kFactors = 13;  // from 0.01 to 100, three in a decade
    const dynamics::GearboxInputs nominal = scene.inputs(nominal_inputs(scene.study()));
    const double period_s = dynamics::mesh_period_s(nominal);
    StabilityMap map;
    map.own = lockstep::name(scene.plan().integrator);
    map.own_steps = static_cast<double>(scene.plan().grid.steps.size());
    std::vector<dynamics::GearboxMatrices> systems;
    for (int i = 0; i < kFactors; ++i) {
        map.factors.push_back(std::pow(10.0, (i - kFactors / 2) / 3.0));
        std::vector<double> pairs = scene.stiffest_pairs();
        for (double& stiffness : pairs) {
            stiffness *= map.factors.back();
        }
        systems.push_back(dynamics::assemble(scene.plan().layout, nominal, pairs));
    }
    const std::vector<HardSystem> hard = hard_systems(scene, nominal);
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
