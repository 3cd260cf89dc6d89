#include "lockstep/mesh_march.hpp"

#include <cassert>

#include "lockstep/explicit_march.hpp"
#include "lockstep/implicit_march.hpp"
#include "lockstep/sensor_filter.hpp"

namespace gearpod::lockstep {
namespace {

template <class Lanes>
using Kernel = MarchKernel<Lanes>*;

// The kernel NAME of the plan's mesh law and of width W.
#define GEARPOD_KERNEL_OF_LAW(LAW, NAME, WIDTH)                           \
    (LAW == dynamics::MeshLaw::linear       ? linear_##NAME##_##WIDTH     \
     : LAW == dynamics::MeshLaw::with_error ? with_error_##NAME##_##WIDTH \
                                            : separating_##NAME##_##WIDTH)
#define GEARPOD_KERNEL_OF(PLAN, NAME)                   \
    [](dynamics::MeshLaw law) {                         \
        if constexpr (W == 1)                           \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 1); \
        else if constexpr (W == 4)                      \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 4); \
        else                                            \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 8); \
    }(PLAN.mesh_law)

template <int W>
Kernel<dynamics::PlanetaryLanes<W>> kernel_of(const MarchPlan& plan,
                                              const dynamics::PlanetaryLayout& layout) {
    if (layout.motion == dynamics::Motion::torsional) {
        return GEARPOD_KERNEL_OF(plan, torsional);
    }
    return layout.inertial_terms ? GEARPOD_KERNEL_OF(plan, translational_inertial)
                                 : GEARPOD_KERNEL_OF(plan, translational);
}

template <int W>
Kernel<dynamics::FixedShaftLanes<W>> kernel_of(const MarchPlan& plan,
                                               const dynamics::FixedShaftLayout&) {
    return GEARPOD_KERNEL_OF(plan, fixed_shaft);
}

template <int W>
Kernel<ImplicitLanes<W>> implicit_kernel_of(const MarchPlan& plan) {
    switch (plan.integrator) {
        case Integrator::newmark:
            return GEARPOD_KERNEL_OF(plan, newmark);
        case Integrator::generalized_alpha:
            return GEARPOD_KERNEL_OF(plan, generalized_alpha);
        default:
            return GEARPOD_KERNEL_OF(plan, sdirk3);
    }
}

#undef GEARPOD_KERNEL_OF
#undef GEARPOD_KERNEL_OF_LAW

template <int W, class Lanes>
class KernelMarch final : public MeshMarch<W> {
  public:
    KernelMarch(const MarchPlan& plan, Lanes lanes, machine::AlignedVector filter,
                Kernel<Lanes> kernel)
        : plan_(plan), lanes_(std::move(lanes)), filter_(std::move(filter)), kernel_(kernel) {}

    void operator()(const std::vector<PairOverride>& overrides, TileState& state,
                    MeshRecord& record) const override {
        kernel_(plan_, lanes_, filter_, overrides, state, record);
    }

  private:
    const MarchPlan& plan_;
    const Lanes lanes_;
    const machine::AlignedVector filter_;
    const Kernel<Lanes> kernel_;
};

// The inputs as those of one kind.
template <class Inputs>
std::vector<Inputs> inputs_of(std::span<const dynamics::GearboxInputs> inputs) {
    std::vector<Inputs> result;
    for (const auto& in : inputs) {
        result.push_back(std::get<Inputs>(in));
    }
    return result;
}

template <int W, class Inputs, class Layout>
std::unique_ptr<const MeshMarch<W>> make_explicit(const MarchPlan& plan, const Layout& layout,
                                                  std::span<const dynamics::GearboxInputs> inputs,
                                                  machine::AlignedVector filter) {
    const std::vector<Inputs> own = inputs_of<Inputs>(inputs);
    auto lanes = dynamics::make_lanes<W>(layout, std::span<const Inputs>(own));
    return std::make_unique<KernelMarch<W, decltype(lanes)>>(
        plan, std::move(lanes), std::move(filter), kernel_of<W>(plan, layout));
}

template <int W>
std::unique_ptr<const MeshMarch<W>> make_implicit(const MarchPlan& plan,
                                                  std::span<const dynamics::GearboxInputs> inputs,
                                                  machine::AlignedVector filter) {
    return std::make_unique<KernelMarch<W, ImplicitLanes<W>>>(
        plan, make_implicit_lanes<W>(plan, inputs), std::move(filter), implicit_kernel_of<W>(plan));
}

}  // namespace

template <int W>
std::unique_ptr<const MeshMarch<W>> make_mesh_march(
    const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    std::vector<double> periods;
    for (const auto& in : inputs) {
        periods.push_back(dynamics::mesh_period_s(in));
    }
    machine::AlignedVector filter =
        filter_coefficients(plan.integrator, plan.low_pass_rad_s, plan.grid.lengths, periods);
    if (plan.integrator != Integrator::rk4) {
        return make_implicit<W>(plan, inputs, std::move(filter));
    }
    if (const auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&plan.layout)) {
        return make_explicit<W, dynamics::PlanetaryInputs>(plan, *planetary, inputs,
                                                           std::move(filter));
    }
    return make_explicit<W, dynamics::FixedShaftInputs>(
        plan, std::get<dynamics::FixedShaftLayout>(plan.layout), inputs, std::move(filter));
}

template std::unique_ptr<const MeshMarch<1>> make_mesh_march<1>(
    const MarchPlan&, std::span<const dynamics::GearboxInputs>);
template std::unique_ptr<const MeshMarch<4>> make_mesh_march<4>(
    const MarchPlan&, std::span<const dynamics::GearboxInputs>);
template std::unique_ptr<const MeshMarch<8>> make_mesh_march<8>(
    const MarchPlan&, std::span<const dynamics::GearboxInputs>);

}  // namespace gearpod::lockstep
