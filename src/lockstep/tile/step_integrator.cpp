#include "lockstep/tile/step_integrator.hpp"

#include <cassert>
#include <stdexcept>

#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/tile/kernel_choice.hpp"
#include "machine/cancellation.hpp"

namespace gearpod::lockstep {
namespace {

template <int W, class Lanes>
class StepKernelIntegrator final : public StepIntegrator<W> {
  public:
    explicit StepKernelIntegrator(KernelCall<Lanes> call)
        : call_(std::move(call)),
          torques_(static_cast<std::size_t>(call_.lanes.excitation_forces.columns) * W) {
        call_.lanes.excitation_forces.rows = torques_.data();
        call_.lanes.excitation_forces.nodes_per_step = 0;  // one row for all steps
    }
    StepKernelIntegrator(const StepKernelIntegrator&) = delete;
    StepKernelIntegrator& operator=(const StepKernelIntegrator&) = delete;
    ~StepKernelIntegrator() override {
        if (part().workspace != nullptr) {
            part().release(part().workspace);
        }
    }

    machine::AlignedVector& torques() override { return torques_; }

    void operator()(int step, const MeshOverrides& overrides, TileState& state,
                    MeshRecord& record) override {
        if (step == 0) {
            machine::throw_if_cancelled();
        }
        part().first = step;
        part().last = step + 1;
        call_(overrides, state, record);
    }

  private:
    MeshPart& part() { return call_.lanes.part; }

    KernelCall<Lanes> call_;
    machine::AlignedVector torques_;
};

}  // namespace

bool supports_steps(const IntegrationPlan& plan) {
    return plan.integrator == Integrator::central_difference &&
           plan.precision == Precision::double_precision;
}

template <int W>
std::unique_ptr<StepIntegrator<W>> make_step_integrator(
    const IntegrationPlan& plan, const std::vector<ShaftEnd>& shafts,
    std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    if (!supports_steps(plan) || shafts.size() > kMostShafts) {
        throw std::invalid_argument(
            "coupled stages need the central difference method in double precision, and at most "
            "four shafts each");
    }
    Excitation excitation;
    excitation.shafts = shafts;
    return with_lanes<W, double>(
        plan, inputs,
        [&]<class ModelLanes>(const ModelLanes& model,
                              MotionModel motion_model) -> std::unique_ptr<StepIntegrator<W>> {
            using Lanes = ForcedLanes<ModelLanes, W>;
            return std::make_unique<StepKernelIntegrator<W, Lanes>>(KernelCall<Lanes>(
                plan, Lanes{model, make_excitation_forces<W>(plan, excitation, inputs, true)},
                inputs, ExcitationKind::forced, motion_model));
        });
}

#define GEARPOD_STEP_INTEGRATOR(W, REAL)                                 \
    template std::unique_ptr<StepIntegrator<W>> make_step_integrator<W>( \
        const IntegrationPlan&, const std::vector<ShaftEnd>&,            \
        std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_STEP_INTEGRATOR)
#undef GEARPOD_STEP_INTEGRATOR

}  // namespace gearpod::lockstep
