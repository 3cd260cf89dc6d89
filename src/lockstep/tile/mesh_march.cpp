#include "lockstep/tile/mesh_march.hpp"

#include <cassert>
#include <stdexcept>
#include <type_traits>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/kernels/explicit_march.hpp"
#include "lockstep/kernels/implicit_march.hpp"

namespace gearpod::lockstep {
namespace {

constexpr int kMostDoubleLanes = 8;

template <class Lanes>
using Kernel = MarchKernel<Lanes>*;

// The kernel NAME of the plan's mesh law and of width W.
#define GEARPOD_KERNEL_OF_LAW(LAW, NAME, WIDTH)                           \
    (LAW == dynamics::MeshLaw::linear       ? linear_##NAME##_##WIDTH     \
     : LAW == dynamics::MeshLaw::with_error ? with_error_##NAME##_##WIDTH \
                                            : separating_##NAME##_##WIDTH)
#define GEARPOD_DOUBLE_KERNEL_OF(PLAN, NAME)            \
    [](dynamics::MeshLaw law) {                         \
        if constexpr (W == 1)                           \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 1); \
        else if constexpr (W == 4)                      \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 4); \
        else                                            \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 8); \
    }(PLAN.mesh_law)
#define GEARPOD_SINGLE_KERNEL_OF(PLAN, NAME)             \
    [](dynamics::MeshLaw law) {                          \
        if constexpr (W == 1)                            \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 1);  \
        else if constexpr (W == 4)                       \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 4);  \
        else if constexpr (W == 8)                       \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 8);  \
        else                                             \
            return GEARPOD_KERNEL_OF_LAW(law, NAME, 16); \
    }(PLAN.mesh_law)

// The explicit kernel of model NAME.
#define GEARPOD_EXPLICIT_KERNEL_OF(PLAN, NAME)                                  \
    [](const MarchPlan& p) {                                                    \
        const bool central = p.integrator == Integrator::central_difference;    \
        if constexpr (std::is_same_v<Real, float>)                              \
            return central ? GEARPOD_SINGLE_KERNEL_OF(p, central_single_##NAME) \
                           : GEARPOD_SINGLE_KERNEL_OF(p, rk4_single_##NAME);    \
        else                                                                    \
            return central ? GEARPOD_DOUBLE_KERNEL_OF(p, central_double_##NAME) \
                   : p.integrator == Integrator::bs3                            \
                       ? GEARPOD_DOUBLE_KERNEL_OF(p, bs3_double_##NAME)         \
                       : GEARPOD_DOUBLE_KERNEL_OF(p, rk4_double_##NAME);        \
    }(PLAN)

template <int W, class Real>
Kernel<dynamics::PlanetaryLanes<W, Real>> kernel_of(const MarchPlan& plan,
                                                    const dynamics::PlanetaryLayout& layout) {
    if (layout.motion == dynamics::Motion::torsional) {
        return GEARPOD_EXPLICIT_KERNEL_OF(plan, torsional);
    }
    return layout.inertial_terms ? GEARPOD_EXPLICIT_KERNEL_OF(plan, translational_inertial)
                                 : GEARPOD_EXPLICIT_KERNEL_OF(plan, translational);
}

template <int W, class Real>
Kernel<dynamics::FixedShaftLanes<W, Real>> kernel_of(const MarchPlan& plan,
                                                     const dynamics::FixedShaftLayout&) {
    return GEARPOD_EXPLICIT_KERNEL_OF(plan, fixed_shaft);
}

template <int W>
Kernel<ImplicitLanes<W>> implicit_kernel_of(const MarchPlan& plan) {
    switch (plan.integrator) {
        case Integrator::newmark:
            return GEARPOD_DOUBLE_KERNEL_OF(plan, newmark);
        case Integrator::generalized_alpha:
            return GEARPOD_DOUBLE_KERNEL_OF(plan, generalized_alpha);
        default:
            return GEARPOD_DOUBLE_KERNEL_OF(plan, sdirk3);
    }
}

#undef GEARPOD_EXPLICIT_KERNEL_OF
#undef GEARPOD_SINGLE_KERNEL_OF
#undef GEARPOD_DOUBLE_KERNEL_OF
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

template <int W, class Real, class Inputs, class Layout>
std::unique_ptr<const MeshMarch<W>> make_explicit(const MarchPlan& plan, const Layout& layout,
                                                  std::span<const dynamics::GearboxInputs> inputs,
                                                  machine::AlignedVector filter) {
    const std::vector<Inputs> own = inputs_of<Inputs>(inputs);
    auto lanes = dynamics::make_lanes<W, Real>(layout, std::span<const Inputs>(own));
    return std::make_unique<KernelMarch<W, decltype(lanes)>>(
        plan, std::move(lanes), std::move(filter), kernel_of<W, Real>(plan, layout));
}

template <int W, class Real>
std::unique_ptr<const MeshMarch<W>> make_explicit(const MarchPlan& plan,
                                                  std::span<const dynamics::GearboxInputs> inputs,
                                                  machine::AlignedVector filter) {
    if (const auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&plan.layout)) {
        return make_explicit<W, Real, dynamics::PlanetaryInputs>(plan, *planetary, inputs,
                                                                 std::move(filter));
    }
    return make_explicit<W, Real, dynamics::FixedShaftInputs>(
        plan, std::get<dynamics::FixedShaftLayout>(plan.layout), inputs, std::move(filter));
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
    machine::AlignedVector filter = filter_coefficients(
        plan.integrator, plan.low_pass_rad_s, plan.grid.lengths, dynamics::mesh_periods_s(inputs));
    if (plan.precision == Precision::single_precision) {
        if (marches_singles(plan.integrator)) {
            return make_explicit<W, float>(plan, inputs, std::move(filter));
        }
    } else if constexpr (W <= kMostDoubleLanes) {
        return is_explicit(plan.integrator)
                   ? make_explicit<W, double>(plan, inputs, std::move(filter))
                   : make_implicit<W>(plan, inputs, std::move(filter));
    }
    throw std::invalid_argument(
        "only rk4 and central differences march singles, and doubles march at most eight abreast");
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
