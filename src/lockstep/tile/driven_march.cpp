#include "lockstep/tile/driven_march.hpp"

#include <cassert>
#include <stdexcept>

#include "lockstep/driven/excitation_rows.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/kernels/driven_kernels.hpp"

namespace gearpod::lockstep {
namespace {

template <class Lanes>
using Kernel = MarchKernel<Lanes>*;

// The kernel KIND of the plan's mesh law and of width W.
#define GEARPOD_DRIVEN_KERNEL(LAW, NAME, WIDTH)                           \
    (LAW == dynamics::MeshLaw::linear       ? linear_##NAME##_##WIDTH     \
     : LAW == dynamics::MeshLaw::with_error ? with_error_##NAME##_##WIDTH \
                                            : separating_##NAME##_##WIDTH)
#define GEARPOD_DRIVEN_KERNEL_OF(PLAN, NAME)            \
    [](dynamics::MeshLaw law) {                         \
        if constexpr (W == 1)                           \
            return GEARPOD_DRIVEN_KERNEL(law, NAME, 1); \
        else if constexpr (W == 4)                      \
            return GEARPOD_DRIVEN_KERNEL(law, NAME, 4); \
        else                                            \
            return GEARPOD_DRIVEN_KERNEL(law, NAME, 8); \
    }(PLAN.mesh_law)
#define GEARPOD_DRIVEN_KERNEL_OF_MODEL(PLAN, PACED, MODEL)   \
    ((PACED) ? GEARPOD_DRIVEN_KERNEL_OF(PLAN, paced_##MODEL) \
             : GEARPOD_DRIVEN_KERNEL_OF(PLAN, forced_##MODEL))

template <int W>
Kernel<DrivenPlanetaryLanes<W>> kernel_of(const MarchPlan& plan, bool paced,
                                          const dynamics::PlanetaryLayout& layout) {
    if (layout.motion == dynamics::Motion::torsional) {
        return GEARPOD_DRIVEN_KERNEL_OF_MODEL(plan, paced, torsional);
    }
    return layout.inertial_terms
               ? GEARPOD_DRIVEN_KERNEL_OF_MODEL(plan, paced, translational_inertial)
               : GEARPOD_DRIVEN_KERNEL_OF_MODEL(plan, paced, translational);
}

template <int W>
Kernel<DrivenFixedShaftLanes<W>> kernel_of(const MarchPlan& plan, bool paced,
                                           const dynamics::FixedShaftLayout&) {
    return GEARPOD_DRIVEN_KERNEL_OF_MODEL(plan, paced, fixed_shaft);
}

template <int W>
Kernel<DrivenImplicitLanes<W>> implicit_kernel_of(const MarchPlan& plan) {
    return GEARPOD_DRIVEN_KERNEL_OF(plan, forced_sdirk3);
}

#undef GEARPOD_DRIVEN_KERNEL_OF_MODEL
#undef GEARPOD_DRIVEN_KERNEL_OF
#undef GEARPOD_DRIVEN_KERNEL

template <int W, class Lanes>
class DrivenKernelMarch final : public DrivenMarch<W> {
  public:
    DrivenKernelMarch(const MarchPlan& plan, const Lanes& lanes, machine::AlignedVector filter,
                      Kernel<Lanes> kernel, ExcitationRows rows)
        : plan_(plan),
          lanes_(lanes),
          filter_(std::move(filter)),
          kernel_(kernel),
          rows_(std::move(rows)) {
        lanes_.drive.rows = rows_.rows().data();
    }

    void operator()(int mesh, const std::vector<PairOverride>& overrides, TileState& state,
                    MeshRecord& record) override {
        rows_.fill(mesh);
        kernel_(plan_, lanes_, filter_, overrides, state, record);
    }

  private:
    const MarchPlan& plan_;
    Lanes lanes_;
    const machine::AlignedVector filter_;
    const Kernel<Lanes> kernel_;
    ExcitationRows rows_;
};

// Everything a driven march is made from.
struct Parts {
    const MarchPlan& plan;
    const Excitation& excitation;
    std::span<const dynamics::GearboxInputs> inputs;
};

template <int W, class ModelLanes>
std::unique_ptr<DrivenMarch<W>> make_march(const Parts& parts, const ModelLanes& model_lanes,
                                           Kernel<DrivenLanes<ModelLanes, W>> kernel) {
    const auto& [plan, excitation, inputs] = parts;
    const DrivenLanes<ModelLanes, W> lanes{
        model_lanes, make_driven_forces<W>(plan, excitation, inputs, is_explicit(plan.integrator))};
    return std::make_unique<DrivenKernelMarch<W, DrivenLanes<ModelLanes, W>>>(
        plan, lanes,
        filter_coefficients(plan.integrator, plan.low_pass_rad_s, plan.grid.lengths,
                            dynamics::mesh_periods_s(inputs)),
        kernel, ExcitationRows(plan, excitation, inputs));
}

template <int W, class Inputs, class Layout>
std::unique_ptr<DrivenMarch<W>> make_explicit(const Parts& parts, const Layout& layout) {
    std::vector<Inputs> own;
    for (const auto& in : parts.inputs) {
        own.push_back(std::get<Inputs>(in));
    }
    const bool paced = parts.excitation.speed.has_value();
    return make_march<W>(parts,
                         dynamics::make_lanes<W, double>(layout, std::span<const Inputs>(own)),
                         kernel_of<W>(parts.plan, paced, layout));
}

bool any_sample_inside(const PhaseGrid& grid) {
    for (const Step& step : grid.steps) {
        if (step.inside > 0) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool can_be_driven(const MarchPlan& plan, const Excitation& excitation) {
    if (plan.precision != Precision::double_precision) {
        return false;
    }
    return excitation.speed
               ? plan.integrator == Integrator::rk4 && !any_sample_inside(plan.grid)
               : plan.integrator == Integrator::rk4 || plan.integrator == Integrator::sdirk3;
}

template <int W>
std::unique_ptr<DrivenMarch<W>> make_driven_march(const MarchPlan& plan,
                                                  const Excitation& excitation,
                                                  std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (!can_be_driven(plan, excitation)) {
        throw std::invalid_argument(
            "only rk4 and sdirk3 march doubles under varying forces, and only rk4 on a grid with a "
            "node on every sample at a varying speed");
    }
    const Parts parts{plan, excitation, inputs};
    if (plan.integrator == Integrator::sdirk3) {
        return make_march<W>(parts, make_implicit_lanes<W>(plan, inputs),
                             implicit_kernel_of<W>(plan));
    }
    if (const auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&plan.layout)) {
        return make_explicit<W, dynamics::PlanetaryInputs>(parts, *planetary);
    }
    return make_explicit<W, dynamics::FixedShaftInputs>(
        parts, std::get<dynamics::FixedShaftLayout>(plan.layout));
}

#define GEARPOD_DRIVEN_MARCH(W, REAL)                              \
    template std::unique_ptr<DrivenMarch<W>> make_driven_march<W>( \
        const MarchPlan&, const Excitation&, std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_DRIVEN_MARCH)
#undef GEARPOD_DRIVEN_MARCH

}  // namespace gearpod::lockstep
