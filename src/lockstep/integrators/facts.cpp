#include "lockstep/integrators/facts.hpp"

#include <string_view>

#include "lockstep/integrators/all_integrators.hpp"
#include "lockstep/integrators/filter_system.hpp"

namespace gearpod::lockstep {
namespace {

// `kernels`: those of its line in integrators.def.
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
    facts.marches_singles = has("singles");
    facts.marches_forced = has("forced");
    facts.marches_paced = has("paced");
    if constexpr (kImplicit<Method>) {
        facts.span = Method::kSpan;
    }
    if constexpr (requires(std::complex<double> z) { Method::growth(z); }) {
        facts.growth = [](std::complex<double> z) { return Method::growth(z); };
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

}  // namespace gearpod::lockstep
