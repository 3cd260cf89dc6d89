#include "lockstep/tile/mesh_integrator.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/kernel_choice.hpp"
#include "machine/cancellation.hpp"

namespace gearpod::lockstep {
namespace {

constexpr int kMostDoubleLanes = 8;

template <int W, class Lanes>
class KernelIntegrator final : public MeshIntegrator<W> {
  public:
    explicit KernelIntegrator(KernelCall<Lanes> call) : call_(std::move(call)) {}

    void operator()(const MeshOverrides& overrides, TileState& state,
                    MeshRecord& record) const override {
        machine::throw_if_cancelled();
        call_(overrides, state, record);
    }

  private:
    const KernelCall<Lanes> call_;
};

template <int W, class Real>
std::unique_ptr<const MeshIntegrator<W>> make_kernel_integrator(
    const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs) {
    return with_lanes<W, Real>(
        plan, inputs,
        [&]<class Lanes>(Lanes lanes,
                         MotionModel motion_model) -> std::unique_ptr<const MeshIntegrator<W>> {
            return std::make_unique<KernelIntegrator<W, Lanes>>(KernelCall<Lanes>(
                plan, std::move(lanes), inputs, ExcitationKind::steady, motion_model));
        });
}

}  // namespace

template <int W>
std::unique_ptr<const MeshIntegrator<W>> make_mesh_integrator(
    const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (plan.precision == Precision::single_precision) {
        if (has_single_precision(plan.integrator)) {
            return make_kernel_integrator<W, float>(plan, inputs);
        }
    } else if constexpr (W <= kMostDoubleLanes) {
        return make_kernel_integrator<W, double>(plan, inputs);
    }
    throw std::invalid_argument(
        fmt::format("only {} support single precision; double precision supports at most {} lanes",
                    names_of(&IntegratorFacts::has_single_precision), kMostDoubleLanes));
}

#define GEARPOD_MESH_INTEGRATOR(W)                                             \
    template std::unique_ptr<const MeshIntegrator<W>> make_mesh_integrator<W>( \
        const IntegrationPlan&, std::span<const dynamics::GearboxInputs>);
GEARPOD_MESH_INTEGRATOR(1)
GEARPOD_MESH_INTEGRATOR(4)
GEARPOD_MESH_INTEGRATOR(8)
GEARPOD_MESH_INTEGRATOR(16)
#undef GEARPOD_MESH_INTEGRATOR

}  // namespace gearpod::lockstep
