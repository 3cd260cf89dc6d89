// Properties of the integrators (method.hpp), for code that selects them at run time.
#pragma once

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "lockstep/integrators/method.hpp"
#include "lockstep/plan/integrator.hpp"

namespace gearpod::dynamics {
struct GearboxMatrices;
}

namespace gearpod::lockstep {

struct FilterMap;
struct FilterSystem;

struct IntegratorFacts {
    const char* name;
    int order;
    std::vector<double> stage_nodes;
    double steps_in_band;
    StepCost cost;
    bool is_explicit, has_single_precision;
    bool supports_varying_forces,
        supports_variable_speed;  // under time-varying forces, at variable speed
    double diagonal;              // 0 for an explicit method
    std::complex<double> (*growth)(std::complex<double>);  // or null
    FilterMap (*filter)(const FilterSystem&);
    double (*stable_step)(const dynamics::GearboxMatrices&);  // of explicit ones without growth()
    double least_margin;                                      // of explicit ones
    bool scales_mass;                                         // may use plan/mode_inertia.hpp
};

const IntegratorFacts& facts(Integrator integrator);

// All integrators, in display order.
std::span<const Integrator> all_integrators();

// Names of the integrators that have a property: "rk4 and central-difference".
std::string names_of(bool IntegratorFacts::*fact);

inline const char* name(Integrator integrator) {
    return facts(integrator).name;
}
inline const std::vector<double>& stage_nodes(Integrator integrator) {
    return facts(integrator).stage_nodes;
}
inline bool is_explicit(Integrator integrator) {
    return facts(integrator).is_explicit;
}
inline bool has_single_precision(Integrator integrator) {
    return facts(integrator).has_single_precision;
}

}  // namespace gearpod::lockstep
