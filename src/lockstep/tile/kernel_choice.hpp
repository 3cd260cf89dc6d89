// Chooses the kernel that integrates a tile of the plan's gearboxes, and makes the lanes it takes.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/filter_coefficients.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"
#include "lockstep/kernels/kernel_table.hpp"

namespace gearpod::lockstep {

// Kernel with this number of lanes for the active instruction set. Throws MissingKernel.
template <class Lanes>
IntegrationKernel<Lanes>* choose_kernel(const IntegrationPlan& plan, ExcitationKind excitation_kind,
                                        MotionModel motion_model, int lanes) {
    return kernel_table().find<Lanes>({plan.integrator, plan.mesh_law, excitation_kind,
                                       plan.precision, machine::active_instruction_set(),
                                       motion_model, lanes});
}

// A kernel together with what it takes at every call, for a tile of the plan's gearboxes. The plan
// must outlive the object.
template <class Lanes>
class KernelCall {
  public:
    // `inputs` has one gearbox per lane. Throws MissingKernel.
    KernelCall(const IntegrationPlan& plan, Lanes own,
               std::span<const dynamics::GearboxInputs> inputs, ExcitationKind excitation_kind,
               MotionModel motion_model)
        : lanes(std::move(own)),
          plan_(plan),
          filter_(filter_coefficients(plan.integrator, plan.low_pass_rad_s, plan.grid.lengths,
                                      dynamics::mesh_periods_s(inputs))),
          kernel_(choose_kernel<Lanes>(plan, excitation_kind, motion_model,
                                       static_cast<int>(inputs.size()))) {}

    void operator()(const MeshOverrides& overrides, TileState& state, MeshRecord& record) const {
        kernel_(plan_, lanes, filter_, overrides, state, record);
    }

    Lanes lanes;

  private:
    const IntegrationPlan& plan_;
    const machine::AlignedVector filter_;
    IntegrationKernel<Lanes>* const kernel_;
};

// Calls use(lanes, moving) with the lanes and the model for the plan's integrator. `inputs` holds W
// gearboxes of the plan's kind.
template <int W, class Real, class Use>
auto with_lanes(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                Use&& use) {
    const IntegratorFacts& integrator = facts(plan.integrator);
    if constexpr (std::is_same_v<Real, double>) {
        if (!integrator.is_explicit) {
            return use(make_implicit_lanes<W>(plan, integrator.span, inputs),
                       MotionModel::matrices);
        }
    }
    const auto lanes_of = [&]<class Inputs>(const auto& layout, std::vector<Inputs> own) {
        for (const auto& in : inputs) {
            own.push_back(std::get<Inputs>(in));
        }
        return dynamics::make_lanes<W, Real>(layout, std::span<const Inputs>(own));
    };
    if (const auto* layout = std::get_if<dynamics::PlanetaryLayout>(&plan.layout)) {
        const MotionModel motion_model =
            layout->motion == dynamics::Motion::torsional ? MotionModel::torsional
            : layout->inertial_terms                      ? MotionModel::translational_inertial
                                                          : MotionModel::translational;
        return use(lanes_of(*layout, std::vector<dynamics::PlanetaryInputs>{}), motion_model);
    }
    return use(lanes_of(std::get<dynamics::FixedShaftLayout>(plan.layout),
                        std::vector<dynamics::FixedShaftInputs>{}),
               MotionModel::fixed_shaft);
}

}  // namespace gearpod::lockstep
