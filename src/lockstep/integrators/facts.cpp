#include "lockstep/integrators/facts.hpp"

#include <string_view>

#include "lockstep/integrators/all_integrators.hpp"
#include "lockstep/integrators/sensor_filter.hpp"

namespace gearpod::lockstep {
namespace {

// `kernels` lists the kernel kinds of its line in integrators.def.
template <class Method>
IntegratorFacts facts_of(std::string_view kernels) {
    IntegratorFacts facts{};
    facts.name = Method::kName;
    facts.order = Method::kOrder;
    facts.stage_nodes.assign(std::begin(Method::kStageNodes), std::end(Method::kStageNodes));
    facts.steps_in_band = Method::kStepsInBand;
    facts.cost = Method::kCost;
    facts.is_explicit = !kImplicit<Method>;
    const auto has = [&](std::string_view kind) {
        return kernels.find(kind) != std::string_view::npos;
    };
    facts.has_single_precision = has("singles");
    facts.supports_varying_forces = has("forced");
    facts.supports_variable_speed = has("variable_speed");
    if constexpr (kImplicit<Method>) {
        facts.diagonal = Method::kDiagonal;
    }
    if constexpr (requires(std::complex<double> z) { Method::growth(z); }) {
        facts.growth = [](std::complex<double> z) { return Method::growth(z); };
    }
    if constexpr (requires(const dynamics::GearboxMatrices& m) { Method::stable_step(m); }) {
        facts.stable_step = &Method::stable_step;
    }
    facts.least_margin = kStepMargin;
    if constexpr (requires { Method::kLeastMargin; }) {
        facts.least_margin = Method::kLeastMargin;
    }
    if constexpr (requires { Method::kScalesMass; }) {
        facts.scales_mass = Method::kScalesMass;
    }
    facts.filter = [](const FilterSystem& s) -> FilterMap { return Method::filter(s); };
    return facts;
}

constexpr Integrator kIntegrators[] = {
#define GEARPOD_INTEGRATOR(NAME, ...) Integrator::NAME,
#include "lockstep/plan/integrators.def"
#undef GEARPOD_INTEGRATOR
};

}  // namespace

const IntegratorFacts& facts(Integrator integrator) {
    static const IntegratorFacts all[] = {
#define GEARPOD_INTEGRATOR(NAME, TYPE, HEADER, KERNELS) facts_of<TYPE>(#KERNELS),
#include "lockstep/plan/integrators.def"
#undef GEARPOD_INTEGRATOR
    };
    return all[static_cast<std::size_t>(integrator)];
}

std::span<const Integrator> all_integrators() {
    return kIntegrators;
}

std::string names_of(bool IntegratorFacts::*fact) {
    std::vector<const char*> names;
    for (const Integrator integrator : kIntegrators) {
        if (facts(integrator).*fact) {
            names.push_back(name(integrator));
        }
    }
    std::string text = names.empty() ? "none" : names.front();
    for (std::size_t i = 1; i < names.size(); ++i) {
        text += std::string(i + 1 < names.size() ? ", " : " and ") + names[i];
    }
    return text;
}

}  // namespace gearpod::lockstep
