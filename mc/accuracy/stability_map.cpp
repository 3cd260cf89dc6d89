#include "mc/accuracy/stability_map.hpp"

#include <cmath>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/step_limit.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
