#include "lockstep/tile/excited_integrator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/kernel_choice.hpp"
#include "machine/cancellation.hpp"

namespace gearpod::lockstep {
namespace {

template <int W, class Lanes>
class ExcitedKernelIntegrator final : public ExcitedIntegrator<W> {
  public:
    ExcitedKernelIntegrator(KernelCall<Lanes> call, ExcitationRows rows)
        : call_(std::move(call)), rows_(std::move(rows)) {
        call_.lanes.excitation_forces.rows = rows_.rows().data();
    }

    void operator()(int mesh, const MeshOverrides& overrides, TileState& state,
                    MeshRecord& record) override {
        machine::throw_if_cancelled();
        rows_.fill(mesh);
        call_(overrides, state, record);
    }

  private:
    KernelCall<Lanes> call_;
    ExcitationRows rows_;
};

bool any_sample_inside(const PhaseGrid& grid) {
    return std::any_of(grid.steps.begin(), grid.steps.end(),
                       [](const Step& step) { return step.inside > 0; });
}

}  // namespace

bool supports_excitation(const IntegrationPlan& plan, const Excitation& excitation) {
    const IntegratorFacts& integrator = facts(plan.integrator);
    if (plan.precision != Precision::double_precision) {
        return false;
    }
    return excitation.speed ? integrator.supports_variable_speed && !any_sample_inside(plan.grid)
                            : integrator.supports_varying_forces;
}

template <int W>
std::unique_ptr<ExcitedIntegrator<W>> make_excited_integrator(
    const IntegrationPlan& plan, const Excitation& excitation,
    std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (!supports_excitation(plan, excitation)) {
        throw std::invalid_argument(fmt::format(
            "varying forces need double precision and one of: {}; a varying speed needs {} and a "
            "grid with a node on every sample",
            names_of(&IntegratorFacts::supports_varying_forces),
            names_of(&IntegratorFacts::supports_variable_speed)));
    }
    const ExcitationKind excitation_kind =
        excitation.speed ? ExcitationKind::variable_speed : ExcitationKind::forced;
    return with_lanes<W, double>(
        plan, inputs,
        [&]<class ModelLanes>(const ModelLanes& model,
                              MotionModel motion_model) -> std::unique_ptr<ExcitedIntegrator<W>> {
            using Lanes = ForcedLanes<ModelLanes, W>;
            const bool over_mass = is_explicit(plan.integrator);
            return std::make_unique<ExcitedKernelIntegrator<W, Lanes>>(
                KernelCall<Lanes>(
                    plan,
                    Lanes{model, make_excitation_forces<W>(plan, excitation, inputs, over_mass)},
                    inputs, excitation_kind, motion_model),
                ExcitationRows(plan, excitation, inputs));
        });
}

#define GEARPOD_EXCITED_INTEGRATOR(W, REAL)                                    \
    template std::unique_ptr<ExcitedIntegrator<W>> make_excited_integrator<W>( \
        const IntegrationPlan&, const Excitation&, std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_EXCITED_INTEGRATOR)
#undef GEARPOD_EXCITED_INTEGRATOR

}  // namespace gearpod::lockstep
