#include "lockstep/tile/driven_march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "lockstep/driven/excitation_rows.hpp"
#include "lockstep/driven/forced_motion.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/filter_coefficients.hpp"
#include "lockstep/tile/kernel_choice.hpp"
#include "machine/stop.hpp"

namespace gearpod::lockstep {
namespace {

template <int W, class Lanes>
class DrivenKernelMarch final : public DrivenMarch<W> {
  public:
    DrivenKernelMarch(const MarchPlan& plan, Lanes lanes, machine::AlignedVector filter,
                      MarchKernel<Lanes>* kernel, ExcitationRows rows)
        : plan_(plan),
          lanes_(std::move(lanes)),
          filter_(std::move(filter)),
          kernel_(kernel),
          rows_(std::move(rows)) {
        lanes_.drive.rows = rows_.rows().data();
    }

    void operator()(int mesh, const MeshOverrides& overrides, TileState& state,
                    MeshRecord& record) override {
        machine::leave_if_stopped();
        rows_.fill(mesh);
        kernel_(plan_, lanes_, filter_, overrides, state, record);
    }

  private:
    const MarchPlan& plan_;
    Lanes lanes_;
    const machine::AlignedVector filter_;
    MarchKernel<Lanes>* const kernel_;
    ExcitationRows rows_;
};

bool any_sample_inside(const PhaseGrid& grid) {
    return std::any_of(grid.steps.begin(), grid.steps.end(),
                       [](const Step& step) { return step.inside > 0; });
}

}  // namespace

bool can_be_driven(const MarchPlan& plan, const Excitation& excitation) {
    const IntegratorFacts& integrator = facts(plan.integrator);
    if (plan.precision != Precision::double_precision) {
        return false;
    }
    return excitation.speed ? integrator.marches_paced && !any_sample_inside(plan.grid)
                            : integrator.marches_forced;
}

template <int W>
std::unique_ptr<DrivenMarch<W>> make_driven_march(const MarchPlan& plan,
                                                  const Excitation& excitation,
                                                  std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (!can_be_driven(plan, excitation)) {
        throw std::invalid_argument(fmt::format(
            "only {} march doubles under varying forces, and at a varying speed only {} "
            "on a grid with a node on every sample",
            names_of(&IntegratorFacts::marches_forced), names_of(&IntegratorFacts::marches_paced)));
    }
    const Drive drive = excitation.speed ? Drive::paced : Drive::forced;
    return with_lanes<W, double>(
        plan, inputs,
        [&]<class ModelLanes>(const ModelLanes& model,
                              Moving moving) -> std::unique_ptr<DrivenMarch<W>> {
            using Lanes = DrivenLanes<ModelLanes, W>;
            const bool over_mass = is_explicit(plan.integrator);
            return std::make_unique<DrivenKernelMarch<W, Lanes>>(
                plan, Lanes{model, make_driven_forces<W>(plan, excitation, inputs, over_mass)},
                filter_coefficients(plan.integrator, plan.low_pass_rad_s, plan.grid.lengths,
                                    dynamics::mesh_periods_s(inputs)),
                choose_kernel<Lanes>(plan, drive, moving, W),
                ExcitationRows(plan, excitation, inputs));
        });
}

#define GEARPOD_DRIVEN_MARCH(W, REAL)                              \
    template std::unique_ptr<DrivenMarch<W>> make_driven_march<W>( \
        const MarchPlan&, const Excitation&, std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_DRIVEN_MARCH)
#undef GEARPOD_DRIVEN_MARCH

}  // namespace gearpod::lockstep
