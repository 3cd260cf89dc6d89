#include "mc/description/effect_costs.hpp"

#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

bool inertial(const Study& s) {
    return s.effects.inertial_terms && !s.effects.torsional() &&
           s.gearbox.kind == GearboxKind::planetary;
}
bool has_separation(const Study& s) {
    return s.effects.separation != Separation::none && !has_unilateral_teeth(s);
}
// True if transmission errors cost extra time; the tooth separation kernel includes them.
bool has_errors(const Study& s) {
    return has_static_errors(s) && !has_separation(s) && !has_unilateral_teeth(s);
}
bool has_gravity(const Study& s) {
    return s.effects.gravity;
}

struct Cost {
    const char* effect;
    bool (*on)(const Study&);
    double planetary, rotations, fixed_shaft;
};
// Fractions of a step of the classical Runge-Kutta method with eight lanes on an AVX-512 core.
constexpr Cost kCosts[] = {{"inertial terms", inertial, 0.05, 0.0, 0.0},
                           {"transmission error", has_errors, 0.12, 0.20, 0.04},
                           {"tooth separation", has_separation, 0.21, 0.31, 0.13},
                           {"unilateral teeth", has_unilateral_teeth, 0.8, 1.4, 0.4},
                           {"sinusoidal torque", torque_has_sine, 0.10, 0.30, 0.29},
                           {"random torque", torque_has_noise, 0.15, 0.29, 0.34},
                           {"gravity", has_gravity, 0.19, 0.43, 0.12},
                           {"variable speed", speed_fluctuates, 0.80, 0.87, 0.71}};

}  // namespace

std::vector<EffectCost> effect_costs(const Study& study) {
    std::vector<EffectCost> costs;
    for (const Cost& cost : kCosts) {
        if (!study.effects.quasi_static() && cost.on(study)) {
            costs.push_back({cost.effect, study.gearbox.kind == GearboxKind::fixed_shaft
                                              ? cost.fixed_shaft
                                          : study.effects.torsional() ? cost.rotations
                                                                      : cost.planetary});
        }
    }
    return costs;
}

}  // namespace gearpod::mc
