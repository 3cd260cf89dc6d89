#include "lockstep/tile/mesh_march.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/filter_coefficients.hpp"
#include "lockstep/tile/kernel_choice.hpp"
#include "machine/stop.hpp"

namespace gearpod::lockstep {
namespace {

constexpr int kMostDoubleLanes = 8;

template <int W, class Lanes>
class KernelMarch final : public MeshMarch<W> {
  public:
    KernelMarch(const MarchPlan& plan, Lanes lanes, machine::AlignedVector filter,
                MarchKernel<Lanes>* kernel)
        : plan_(plan), lanes_(std::move(lanes)), filter_(std::move(filter)), kernel_(kernel) {}

    void operator()(const MeshOverrides& overrides, TileState& state,
                    MeshRecord& record) const override {
        machine::leave_if_stopped();
        kernel_(plan_, lanes_, filter_, overrides, state, record);
    }

  private:
    const MarchPlan& plan_;
    const Lanes lanes_;
    const machine::AlignedVector filter_;
    MarchKernel<Lanes>* const kernel_;
};

template <int W, class Real>
std::unique_ptr<const MeshMarch<W>> make_march(const MarchPlan& plan,
                                               std::span<const dynamics::GearboxInputs> inputs) {
    machine::AlignedVector filter = filter_coefficients(
        plan.integrator, plan.low_pass_rad_s, plan.grid.lengths, dynamics::mesh_periods_s(inputs));
    return with_lanes<W, Real>(
        plan, inputs,
        [&]<class Lanes>(Lanes lanes, Moving moving) -> std::unique_ptr<const MeshMarch<W>> {
            return std::make_unique<KernelMarch<W, Lanes>>(
                plan, std::move(lanes), std::move(filter),
                choose_kernel<Lanes>(plan, Drive::steady, moving, W));
        });
}

}  // namespace

template <int W>
std::unique_ptr<const MeshMarch<W>> make_mesh_march(
    const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (plan.precision == Precision::single_precision) {
        if (marches_singles(plan.integrator)) {
            return make_march<W, float>(plan, inputs);
        }
    } else if constexpr (W <= kMostDoubleLanes) {
        return make_march<W, double>(plan, inputs);
    }
    throw std::invalid_argument(
        fmt::format("only {} march singles, and doubles march at most eight abreast",
                    names_of(&IntegratorFacts::marches_singles)));
}

#define GEARPOD_MESH_MARCH(W)                                        \
    template std::unique_ptr<const MeshMarch<W>> make_mesh_march<W>( \
        const MarchPlan&, std::span<const dynamics::GearboxInputs>);
GEARPOD_MESH_MARCH(1)
GEARPOD_MESH_MARCH(4)
GEARPOD_MESH_MARCH(8)
GEARPOD_MESH_MARCH(16)
#undef GEARPOD_MESH_MARCH

}  // namespace gearpod::lockstep
