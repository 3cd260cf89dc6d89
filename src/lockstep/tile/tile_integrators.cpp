#include "lockstep/tile/tile_integrators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/planetary_motion.hpp"
#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/filter_coefficients.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/contracts.hpp"
#include "machine/team.hpp"

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
    KernelCall(const IntegrationPlan& plan, Lanes model_lanes,
               std::span<const dynamics::GearboxInputs> inputs, ExcitationKind excitation_kind,
               MotionModel motion_model)
        : lanes(std::move(model_lanes)),
          plan_(plan),
          filter_(filter_coefficients(plan.integrator, plan.low_pass_rad_s, plan.grid.lengths,
                                      dynamics::mesh_periods_s(inputs))),
          kernel_(choose_kernel<Lanes>(plan, excitation_kind, motion_model,
                                       static_cast<int>(inputs.size()))) {}

    void operator()(const MeshOverrides& overrides, TileState& state, MeshRecord& record) const {
        EXPECTS(!record.te.empty() && record.te.size() % plan_.samples() == 0 &&
                record.acceleration.size() == record.te.size() * plan_.channels());
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
            return use(make_implicit_lanes<W>(plan, integrator.diagonal, inputs),
                       MotionModel::matrices);
        }
    }
    const auto lanes_of = [&]<class Inputs>(const auto& layout, std::vector<Inputs> of_kind) {
        for (const auto& in : inputs) {
            of_kind.push_back(std::get<Inputs>(in));
        }
        return dynamics::make_lanes<W, Real>(layout, std::span<const Inputs>(of_kind));
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
    EXPECTS(inputs.size() == W);
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
    return std::ranges::any_of(grid.steps, [](const Step& step) { return step.inside > 0; });
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
    EXPECTS(inputs.size() == W);
    EXPECTS(!excitation.speed ||
            std::ranges::all_of(excitation.speed->turns_per_s, [](double n) { return n == 0.0; }));
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
        EXPECTS(step == 0 || step == part().last);
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
    EXPECTS(inputs.size() == W);
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
