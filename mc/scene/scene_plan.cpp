#include "mc/scene/scene_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/plan/transmission_error.hpp"
#include "mc/scene/body.hpp"
#include "mc/scene/excitation_checks.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

using std::numbers::pi;

class PlanBuilder {
  public:
    PlanBuilder(const Study& study, const Sampler& sampler, const Drivetrain& drivetrain,
                const SceneStiffness& stiffness)
        : study_(study), sampler_(sampler), drivetrain_(drivetrain), stiffness_(stiffness) {}

    ScenePlan make() && {
        const double mesh_frequency_rad_s =
            drivetrain_.mesh_frequency_rad_s(nominal_inputs(study_).speed_rad_s);
        const Sampling sampling = choose_sampling(study_, mesh_frequency_rad_s / (2.0 * pi));
        plan_.te_samples = sampling.te_samples;
        check_shaft_orders(study_, drivetrain_, sampling.samples);
        begin_plan(sampling.samples);
        SceneGrid chosen = choose_grid(study_, plan_.stepping, sampling.samples,
                                       stiffness_.transitions(), [this] { return pilot(); });
        plan_.calibration = chosen.calibration;
        plan_.integration = complete_plan(std::move(chosen.grid));
        check_excitation_resolved(study_, sampler_, drivetrain_, plan_.integration);
        return std::move(plan_);
    }

  private:
    // Sets everything in the integration plan but the grid.
    void begin_plan(int samples) {
        lockstep::IntegrationPlan& integration = plan_.integration;
        integration.layout = gearbox_layout(study_);
        // A quasi-static gearbox is computed at the samples only.
        plan_.stepping.steps = samples;
        if (!study_.effects.quasi_static()) {
            integration.mode_inertia = lockstep::mode_inertia(
                dynamics::assemble(integration.layout,
                                   gearbox_inputs(study_, drivetrain_, nominal_inputs(study_)),
                                   stiffness_.mean_pairs()),
                2.0 * pi * study_.numerics.mass_scaling_Hz);
            plan_.stepping = choose_stepping(study_, sampler_, drivetrain_, integration.layout,
                                             stiffness_.stiffest_pairs(), integration.mode_inertia);
            integration.low_pass_rad_s = 2.0 * pi * study_.sensor.low_pass_Hz;
        }
        integration.integrator = plan_.stepping.integrator;
        integration.precision = study_.numerics.precision;
        integration.te_weight = drivetrain_.te_weight(integration.layout);
        integration.mesh_law = mesh_law(study_);
    }

    // Complete integration plan with this grid: stiffness and transmission errors tabulated at its
    // nodes.
    lockstep::IntegrationPlan complete_plan(lockstep::PhaseGrid grid) const {
        const lockstep::PairSet& pairs = stiffness_.pairs();
        lockstep::IntegrationPlan integration = plan_.integration;
        integration.grid = std::move(grid);
        integration.nodes =
            lockstep::tabulate(pairs, integration.grid, study_.effects.mesh_damping);
        if (dynamics::has_teeth(integration.mesh_law)) {
            add_tooth_pairs(integration);
        }
        if (dynamics::has_error(integration.mesh_law)) {
            std::vector<lockstep::MeshError> errors(
                static_cast<std::size_t>(drivetrain_.pairs_per_mesh()), first_errors());
            errors.resize(static_cast<std::size_t>(pairs.pairs()), second_errors());
            lockstep::add_errors(pairs, integration.grid, errors, integration.nodes);
        }
        return integration;
    }

    void add_tooth_pairs(lockstep::IntegrationPlan& integration) const {
        try {
            lockstep::add_tooth_pairs(stiffness_.pairs(), integration.grid, integration.nodes,
                                      stiffness_.fault().worn_pairs());
        } catch (const std::invalid_argument& error) {
            throw SceneError("gearbox.addendum_coefficient", error.what(),
                             "use teeth with a lower contact ratio, or fewer face_slices",
                             ProblemKind::tooth_pairs);
        }
    }

    // Static transmission errors of one kind of mesh are the same for all planets, shifted by their
    // mesh phases.
    lockstep::MeshError first_errors() const {
        const MeshErrors& e = study_.errors;
        return study_.gearbox.kind == GearboxKind::fixed_shaft
                   ? lockstep::MeshError{e.mesh_m, e.mesh_phase_rad}
                   : lockstep::MeshError{e.sun_planet_m, e.sun_planet_phase_rad};
    }
    lockstep::MeshError second_errors() const {
        return {study_.errors.ring_planet_m, study_.errors.ring_planet_phase_rad};
    }

    // Pilot sample: the nominal gearbox and the first graded ones. All have the largest fault, or
    // every second one if it is wear. The same for every run of the study.
    lockstep::Pilot pilot() const {
        const SceneFault& fault = stiffness_.fault();
        const std::vector<double> sizes = fault_sizes(study_);
        lockstep::Pilot pilot;
        pilot.faults = {&stiffness_.pairs(), fault.pattern(), {}};
        pilot.faults.curve.resize(static_cast<std::size_t>(fault.curves()));
        for (int lane = 0; lane < lockstep::kPilotLanes; ++lane) {
            const InstanceInputs inputs =
                lane == 0
                    ? nominal_inputs(study_)
                    : sampler_.draw({Group::graded, static_cast<std::uint64_t>(lane - 1)}).inputs;
            pilot.inputs.push_back(gearbox_inputs(study_, drivetrain_, inputs));
            const double largest = sizes.empty() ? 0.0 : sizes.back();
            for (int curve = 0; curve < fault.curves(); ++curve) {
                pilot.faults.curve[static_cast<std::size_t>(curve)].push_back(
                    fault.mesh(curve, largest));
            }
            // Wear has no healthy mesh periods, so every second gearbox is healthy.
            if (!fault.worn_pairs().empty()) {
                pilot.faults.wear.push_back(lane % 2 == 0 ? largest : 0.0);
            }
        }
        // Converges to a thousandth of the periodic orbit; the remaining transient is the same on
        // all grids.
        constexpr double kDecays = 7.0, kMostMeshes = 100.0;
        const double decays = std::ceil(1.0 + kDecays * plan_.stepping.decay_meshes);
        pilot.convergence_meshes = static_cast<int>(std::min(kMostMeshes, decays));
        pilot.plan = [this](lockstep::PhaseGrid grid) { return complete_plan(std::move(grid)); };
        return pilot;
    }

    const Study& study_;
    const Sampler& sampler_;
    const Drivetrain& drivetrain_;
    const SceneStiffness& stiffness_;
    ScenePlan plan_;
};

}  // namespace

ScenePlan make_plan(const Study& study, const Sampler& sampler, const Drivetrain& drivetrain,
                    const SceneStiffness& stiffness) {
    return PlanBuilder(study, sampler, drivetrain, stiffness).make();
}

}  // namespace gearpod::mc
