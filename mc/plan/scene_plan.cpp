#include "mc/plan/scene_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/plan/stepping.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

constexpr int kMostPilotSteps = 50'000;  // per mesh period; a pilot integrates many of them

lockstep::PhaseGrid with_nodes(lockstep::PhaseGrid grid, lockstep::Integrator integrator) {
    grid.stage_nodes = lockstep::stage_nodes(integrator);
    return grid;
}

// Graded grid with the fewest steps that keep the tolerance on the pilot.
SceneGrid graded_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions, const lockstep::Pilot& pilot) {
    const auto grid_of = [&](const lockstep::Grading& grading) {
        return with_nodes(lockstep::make_graded_grid(samples, transitions, grading),
                          stepping.integrator);
    };
    const double tolerance = study.numerics.grid_tolerance;
    lockstep::GradedChoice choice =
        lockstep::choose_grading(pilot, 1.0 / stepping.steps, tolerance, grid_of);
    if (!choice.reached) {
        throw SceneError(
            "numerics.grid_tolerance",
            fmt::format("{:g} cannot be met: with {} steps per mesh period the pilot's signals "
                        "have an error of {:.2g}",
                        tolerance, choice.grid.steps.size(), choice.error),
            "allow a larger one, or use grid = \"uniform\" and numerics.steps_per_mesh");
    }
    return {std::move(choice.grid), Calibration{choice.error, choice.grading}};
}

}  // namespace

SceneGrid choose_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions,
                      const std::function<lockstep::Pilot()>& pilot) {
    if (study.numerics.grid == StepGrid::uniform || study.effects.quasi_static()) {
        return {with_nodes(lockstep::make_phase_grid(samples, stepping.steps, transitions),
                           stepping.integrator),
                std::nullopt};
    }
    if (is_explicit(stepping.integrator)) {
        throw SceneError(
            "numerics.grid",
            fmt::format("graded steps need an implicit integrator, but this study uses {}, whose "
                        "steps are limited by stability everywhere",
                        name(stepping.integrator)),
            "use grid = \"uniform\", or integrator = \"sdirk3\"");
    }
    if (stepping.steps > kMostPilotSteps) {
        throw SceneError("numerics.grid",
                         fmt::format("a pilot with {} steps per mesh period takes too long (at "
                                     "most {})",
                                     stepping.steps, kMostPilotSteps),
                         "use grid = \"uniform\"");
    }
    return graded_grid(study, stepping, samples, transitions, pilot());
}

namespace {

// Highest fluctuation frequency of a gearbox (sine or noise band), in cycles per mesh period.
double highest_frequency(const GearboxPlan& gearbox, const InstanceInputs& in) {
    const FluctuationInstance& f = in.fluctuations;
    const auto& [torque_noise, speed, gravity] = *gearbox.excitation;
    const double period_s = dynamics::mesh_period_s(gearbox.inputs(in));
    const double turns = gearbox.drivetrain->input_turns_per_mesh();
    double result = 0.0;
    if (speed && speed->sine) {
        result = f.speed_order * turns;
    }
    if (torque_noise) {
        result = std::max(result, f.torque_noise_Hz * period_s);
    }
    if (speed && speed->noise) {
        result = std::max(result, f.speed_noise_Hz * period_s);
    }
    return result;
}

// The same, the maximum over the nominal gearbox and a pilot sample of the ensemble.
double highest_frequency(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox) {
    double result = highest_frequency(gearbox, gearbox.nominal);
    constexpr std::uint64_t kPilot = 32;
    for (std::uint64_t i = 0; i < (study.random.empty() ? 0 : kPilot); ++i) {
        const InstanceInputs inputs = sampler.draw({Group::test, i}).inputs;
        result = std::max(result, highest_frequency(gearbox, inputs));
    }
    return result;
}

void check_kernels(const ExcitationModel& model, const lockstep::IntegrationPlan& plan) {
    lockstep::Excitation excitation;
    if (model.speed) {
        excitation.speed.emplace();
    }
    if (lockstep::supports_excitation(plan, excitation)) {
        return;
    }
    const std::string what = model.speed          ? "a fluctuating speed"
                             : model.torque_noise ? "a fluctuating torque"
                                                  : "gravity";
    if (plan.precision != lockstep::Precision::double_precision) {
        throw SceneError("numerics.precision", what + " needs double precision",
                         "use precision = \"double\"");
    }
    const auto able = excitation.speed ? &lockstep::IntegratorFacts::supports_variable_speed
                                       : &lockstep::IntegratorFacts::supports_varying_forces;
    if (lockstep::facts(plan.integrator).*able) {
        throw SceneError("numerics.grid", what + " needs steps that end on every sample",
                         "use grid = \"uniform\"");
    }
    throw SceneError(
        "numerics.integrator",
        fmt::format("{} is supported by {}{}, not by {}", what, lockstep::names_of(able),
                    excitation.speed ? " (time is then not proportional to the mesh phase)" : "",
                    lockstep::name(plan.integrator)),
        excitation.speed
            ? fmt::format("use integrator = \"{}\"; a gearbox that is too stiff for it needs a "
                          "steady speed",
                          lockstep::name(lockstep::kUsualExplicit))
            : "use integrator = \"auto\"");
}

// A quasi-static gearbox has no time steps, only the encoders' samples.
void check_samples(double rate, int samples) {
    if (samples < 2.0 * rate) {
        throw SceneError("sensor.encoder_sampling_Hz",
                         fmt::format("{} samples per mesh period are too few for the fastest "
                                     "fluctuation ({:.3g} cycles per mesh period)",
                                     samples, rate),
                         "raise the rate, or use a slower fluctuation");
    }
}

}  // namespace

void check_excitation_resolved(const Study& study, const Sampler& sampler,
                               const GearboxPlan& gearbox, const lockstep::IntegrationPlan& plan) {
    if (!gearbox.excitation) {
        return;
    }
    if (study.effects.quasi_static()) {
        check_samples(highest_frequency(study, sampler, gearbox), plan.grid.samples);
        return;
    }
    check_kernels(*gearbox.excitation, plan);
    constexpr double kStepsPerPeriod = 20.0;
    const double needed = kStepsPerPeriod * highest_frequency(study, sampler, gearbox);
    const auto steps = static_cast<double>(plan.grid.steps.size());
    if (steps < needed) {
        throw SceneError(
            "numerics.steps_per_mesh",
            fmt::format("{} steps per mesh period are too few for the fastest fluctuation ({:.3g} "
                        "cycles per mesh period)",
                        steps, needed / kStepsPerPeriod),
            fmt::format("use at least {:.0f}, or a slower fluctuation", std::ceil(needed)));
    }
}

void check_shaft_orders(const Study& study, const Drivetrain& drivetrain, int samples_per_mesh) {
    const auto check = [&](const char* key, const char* what, std::size_t number, Member shaft,
                           double order) {
        const double most = 0.5 * samples_per_mesh / drivetrain.shaft_turns_per_mesh(shaft);
        if (order >= most) {
            throw SceneError(key,
                             fmt::format("{} {}: {:g} per turn of the {} are not below half the "
                                         "sampling rate, {:.5g} per turn",
                                         what, number, order, member_name(shaft), most),
                             "lower it or raise sampling_Hz");
        }
    };
    for (std::size_t i = 0; i < study.sensor.tones.size(); ++i) {
        const Tone& tone = study.sensor.tones[i];
        if (tone.shaft) {
            check("sensor.tones", "tone", i + 1, *tone.shaft, tone.order);
        }
    }
    for (std::size_t i = 0; i < study.sensor.bearings.size(); ++i) {
        const Bearing& bearing = study.sensor.bearings[i];
        if (bearing.shaft) {
            check("sensor.bearings", "bearing", i + 1, *bearing.shaft, impulses_per_turn(bearing));
        }
    }
}

namespace {

using std::numbers::pi;

class PlanBuilder {
  public:
    PlanBuilder(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox)
        : study_(study),
          sampler_(sampler),
          gearbox_(gearbox),
          drivetrain_(*gearbox.drivetrain),
          stiffness_(*gearbox.stiffness) {}

    ScenePlan make() && {
        const Sampling sampling = choose_sampling(study_, gearbox_.mesh_frequency_Hz);
        plan_.te_samples = sampling.te_samples;
        check_shaft_orders(study_, drivetrain_, sampling.samples);
        begin_plan(sampling.samples);
        SceneGrid chosen = choose_grid(study_, plan_.stepping, sampling.samples,
                                       stiffness_.transitions(), [this] { return pilot(); });
        plan_.calibration = chosen.calibration;
        plan_.integration = complete_plan(std::move(chosen.grid));
        check_excitation_resolved(study_, sampler_, gearbox_, plan_.integration);
        return std::move(plan_);
    }

  private:
    // Sets everything in the integration plan but the grid.
    void begin_plan(int samples) {
        lockstep::IntegrationPlan& integration = plan_.integration;
        integration.layout = gearbox_.bodies.layout;
        // A quasi-static gearbox is computed at the samples only.
        plan_.stepping.steps = samples;
        if (!study_.effects.quasi_static()) {
            integration.mode_inertia = lockstep::mode_inertia(
                dynamics::assemble(integration.layout, gearbox_.inputs(gearbox_.nominal),
                                   stiffness_.mean_pairs()),
                2.0 * pi * study_.numerics.mass_scaling_Hz);
            plan_.stepping = choose_stepping(study_, sampler_, gearbox_, integration.mode_inertia);
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
                             "use teeth with a lower contact ratio, or without crowning",
                             ProblemKind::tooth_pairs);
        }
    }

    // Static transmission errors of one kind of mesh are the same for all planets, shifted by their
    // mesh phases.
    lockstep::MeshError first_errors() const {
        return error_of(gearbox_.kind == GearboxKind::fixed_shaft ? MeshKind::pinion_gear
                                                                  : MeshKind::sun_planet);
    }
    lockstep::MeshError second_errors() const { return error_of(MeshKind::ring_planet); }
    lockstep::MeshError error_of(MeshKind kind) const {
        const MeshValues& mesh = study_.gearbox.meshes[kind];
        return {mesh.error_m, mesh.error_phase_rad};
    }

    // Pilot sample: the nominal gearbox and the first test gearboxes. All have the largest fault,
    // or every second one if it is wear. The same for every run of the study.
    lockstep::Pilot pilot() const {
        const SceneFault& fault = stiffness_.fault();
        const std::vector<double> sizes = fault_sizes(study_);
        lockstep::Pilot pilot;
        pilot.faults = {&stiffness_.pairs(), fault.pattern(), {}};
        pilot.faults.curve.resize(static_cast<std::size_t>(fault.curves()));
        for (LaneId lane{0}; lane < lockstep::kPilotLanes; ++lane) {
            const InstanceInputs inputs =
                lane == 0
                    ? gearbox_.nominal
                    : sampler_.draw({Group::test, static_cast<std::uint64_t>(lane - 1)}).inputs;
            pilot.inputs.push_back(gearbox_.inputs(inputs));
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
    const GearboxPlan& gearbox_;
    const Drivetrain& drivetrain_;
    const SceneStiffness& stiffness_;
    ScenePlan plan_;
};

}  // namespace

ScenePlan make_plan(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox) {
    return PlanBuilder(study, sampler, gearbox).make();
}

}  // namespace gearpod::mc
