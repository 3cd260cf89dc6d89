#include "mc/plan/solve_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/steps/stability.hpp"
#include "lockstep/tile/superposed_motion.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/plan/feature_plan.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::mc {
namespace {

constexpr int kMostSteps = 1'000'000;  // per mesh period

// Number of samples per mesh period of the sensor and of the encoders. A quasi-static gearbox has
// no sensor, and both are the encoders'.
struct Sampling {
    int samples = 0;
    int te_samples = 0;  // divides samples
};

struct SceneGrid {
    lockstep::PhaseGrid grid;
    std::optional<Calibration> calibration;  // empty for uniform steps
};

using std::numbers::pi;

constexpr int kMostSamples = 20'000;  // per mesh period; a span of thousands of them fits in memory
constexpr int kFewestSamples = 4;

// Smallest number of samples per mesh period for a rate given by `key`.
int samples_at_least(double rate_Hz, double mesh_frequency_Hz, const char* key) {
    const double samples = std::ceil(rate_Hz / mesh_frequency_Hz - 1e-9);
    if (samples > kMostSamples) {
        throw SceneError(key,
                         fmt::format("{:.3g} samples per mesh period are too many (at most {})",
                                     samples, kMostSamples),
                         "lower the rate or raise the speed");
    }
    return std::max(1, static_cast<int>(samples));
}

// Pilot sample of the ensemble, the same for every run of the study: inputs of the first `count`
// test gearboxes; none if all gearboxes are alike.
std::vector<InstanceInputs> pilot_inputs(const Study& study, const Sampler& sampler,
                                         std::uint64_t count = 32) {
    std::vector<InstanceInputs> all;
    for (std::uint64_t i = 0; i < (study.random.empty() ? 0 : count); ++i) {
        all.push_back(sampler.draw({Group::test, i}).inputs);
    }
    return all;
}

// Requirements on the number of steps per mesh period.
class StepNeeds {
  public:
    StepNeeds(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox,
              const lockstep::ModeInertia& mode_inertia)
        : study_(study),
          sampler_(sampler),
          gearbox_(gearbox),
          layout_(gearbox.bodies.layout),
          stiffest_(gearbox.stiffness->stiffest_pairs()),
          mode_inertia_(mode_inertia),
          low_pass_rad_s_(2.0 * pi * study.sensor.low_pass_Hz) {
        gearboxes_.push_back(gearbox.inputs(gearbox.nominal));
        for (const InstanceInputs& inputs : pilot_inputs(study, sampler)) {
            gearboxes_.push_back(gearbox.inputs(inputs));
        }
        const dynamics::GearboxInputs& nominal = gearboxes_[0];
        check_equal_masses();
        const double decay_1_s =
            lockstep::slowest_decay_1_s(system(nominal), dynamics::rigid_rotation(layout_));
        decay_meshes_ = 1.0 / (decay_1_s * period(nominal));
        usual_explicit_ = stable_steps(lockstep::kUsualExplicit);
    }

    double decay_meshes() const { return decay_meshes_; }
    // Number of steps with which an explicit method is stable for all gearboxes of the pilot.
    double stable(lockstep::Integrator integrator) const {
        return integrator == lockstep::kUsualExplicit ? usual_explicit_ : stable_steps(integrator);
    }
    // The same with a margin for gearboxes outside the pilot.
    double ample(lockstep::Integrator integrator) const {
        const double least_margin = lockstep::facts(integrator).least_margin;
        if (least_margin >= lockstep::kStepMargin) {
            return lockstep::kStepMargin * stable(integrator);
        }
        // Extrapolates beyond the largest value of a larger pilot by half its distance from the
        // upper decile, in logarithms. That is little for bounded distributions; for normal tails
        // it covers the maximum of 1e5 gearboxes.
        constexpr std::uint64_t kPilot = 256;
        std::vector<double> needs{needed_steps(gearboxes_[0], integrator)};
        for (const InstanceInputs& inputs : pilot_inputs(study_, sampler_, kPilot)) {
            needs.push_back(needed_steps(gearbox_.inputs(inputs), integrator));
        }
        std::sort(needs.begin(), needs.end());
        const double worst = needs.back(), upper = needs[needs.size() * 9 / 10];
        const double beyond = worst > 0.0 ? std::pow(worst / upper, 1.5) : 1.0;
        return worst * std::clamp(beyond, least_margin, lockstep::kStepMargin);
    }
    double band_periods() const { return low_pass_rad_s_ / (2.0 * pi) * period(gearboxes_[0]); }
    // Number of steps with which an implicit method is accurate for all gearboxes of the pilot.
    double implicit(lockstep::Integrator integrator) const {
        double steps = 1.0;
        for (const dynamics::GearboxInputs& gearbox : gearboxes_) {
            steps = std::max(steps, lockstep::implicit_steps(integrator, system(gearbox),
                                                             period(gearbox), low_pass_rad_s_));
        }
        return steps;
    }
    lockstep::StiffPart stiffest_part() const {
        return lockstep::stiffest_part(layout_, gearboxes_[0], stiffest_);
    }

  private:
    // The additional inertia is that of the nominal gearbox.
    void check_equal_masses() const {
        const Eigen::MatrixXd nominal = system(gearboxes_[0]).mass;
        for (const dynamics::GearboxInputs& gearbox : gearboxes_) {
            if (mode_inertia_.modes > 0 && system(gearbox).mass != nominal) {
                throw SceneError("numerics.mass_scaling_Hz",
                                 "needs the same masses and moments of inertia in all gearboxes",
                                 "remove it, or the scatter of the masses");
            }
        }
    }
    dynamics::GearboxMatrices system(const dynamics::GearboxInputs& gearbox) const {
        return lockstep::with_mode_inertia(dynamics::assemble(layout_, gearbox, stiffest_),
                                           mode_inertia_);
    }
    double needed_steps(const dynamics::GearboxInputs& gearbox,
                        lockstep::Integrator integrator) const {
        const dynamics::GearboxMatrices matrices =
            lockstep::facts(integrator).scales_mass
                ? system(gearbox)
                : dynamics::assemble(layout_, gearbox, stiffest_);
        return period(gearbox) / lockstep::longest_stable_step(matrices, integrator);
    }
    double stable_steps(lockstep::Integrator integrator) const {
        double steps = 0.0;
        for (const dynamics::GearboxInputs& gearbox : gearboxes_) {
            steps = std::max(steps, needed_steps(gearbox, integrator));
        }
        return steps;
    }
    static double period(const dynamics::GearboxInputs& gearbox) {
        return dynamics::mesh_period_s(gearbox);
    }

    const Study& study_;
    const Sampler& sampler_;
    const GearboxPlan& gearbox_;
    const dynamics::GearboxLayout& layout_;
    const std::vector<double> stiffest_;  // of every gear pair, which bounds an explicit step
    const lockstep::ModeInertia& mode_inertia_;
    double low_pass_rad_s_;
    std::vector<dynamics::GearboxInputs> gearboxes_;  // pilot sample, the nominal one first
    double decay_meshes_ = 0.0, usual_explicit_ = 0.0;
};

[[noreturn]] void refuse_explicit(const StepNeeds& needs, double steps) {
    const lockstep::StiffPart stiff = needs.stiffest_part();
    throw SceneError("numerics.integrator",
                     fmt::format("the explicit method would need {:.3g} steps per mesh period ({} "
                                 "moves {} at a rate of {:.3g} 1/s)",
                                 steps, stiff.part, stiff.motion, stiff.rate_1_s),
                     fmt::format("use integrator = \"{}\", which is stable for any stiffness, or "
                                 "\"auto\"",
                                 lockstep::name(lockstep::kUsualImplicit)));
}

// One grid is used for all gearboxes, so it must be stable for the stiffest and lightest of them. A
// gearbox outside the margin is reported as diverged.
// With additional inertia of fast modes, which changes more, the low-pass may be as inaccurate as
// the choice for a share of the features' scatter allows.
Stepping explicit_stepping(const StepNeeds& needs, lockstep::Integrator integrator, int given,
                           bool scales_mass) {
    const double stable = needs.stable(integrator), ample = needs.ample(integrator);
    const double band = lockstep::facts(integrator).steps_in_band * needs.band_periods();
    const double coarse = (scales_mass ? 0.15 : 0.5) * band;
    const double least = std::ceil(std::max(stable, coarse));
    const double chosen = std::ceil(std::max(ample, scales_mass ? coarse : band));
    const bool is_usable = given >= least && given <= kMostSteps;
    if (!is_usable && stable > lockstep::kMostExplicitSteps) {
        refuse_explicit(needs, chosen);
    }
    if (!(chosen <= kMostSteps)) {
        throw SceneError(
            "numerics.steps_per_mesh",
            fmt::format(
                "the sensor's low-pass would need {:.3g} steps per mesh period (at most {})",
                chosen, kMostSteps),
            "lower sensor.low_pass_Hz or raise the speed");
    }
    if (given > 0 && given < least) {
        throw SceneError(
            "numerics.steps_per_mesh",
            fmt::format("{} steps are too few (with fewer than {}, {} is unstable for the stiffest "
                        "gearbox of this study, or the sensor's low-pass filter is inaccurate)",
                        given, least, name(integrator)),
            "remove the key, so that the steps are chosen automatically");
    }
    return {
        integrator,           given > 0 ? given : static_cast<int>(chosen), static_cast<int>(least),
        needs.decay_meshes(), 1.0 / std::max({1.0, ample, coarse}),         0.0};
}

Stepping implicit_stepping(const StepNeeds& needs, lockstep::Integrator integrator, int given) {
    const double chosen = given > 0 ? given : std::ceil(needs.implicit(integrator));
    if (!(chosen <= kMostSteps)) {
        throw SceneError("numerics.steps_per_mesh",
                         fmt::format("{:.3g} steps per mesh period would be needed (at most {})",
                                     chosen, kMostSteps),
                         "lower sensor.low_pass_Hz or raise the speed");
    }
    return {integrator, static_cast<int>(chosen), 1, needs.decay_meshes(), 1.0, 0.0};
}

lockstep::Integrator integrator_of(const Study& study, const StepNeeds& needs) {
    if (study.numerics.integrator) {
        return *study.numerics.integrator;
    }
    const lockstep::Integrator chosen =
        lockstep::choose_integrator(needs.stable(lockstep::kUsualExplicit));
    if (study.numerics.precision == Precision::single_precision && !is_explicit(chosen)) {
        const lockstep::StiffPart stiff = needs.stiffest_part();
        throw SceneError(
            "numerics.precision",
            fmt::format("\"single\" needs an explicit integrator, which would take too "
                        "many steps for this gearbox ({} moves {} at a rate of {:.3g} "
                        "1/s)",
                        stiff.part, stiff.motion, stiff.rate_1_s),
            "use precision = \"double\"");
    }
    return chosen;
}

// Throws SceneError if the encoders, or an additional sensor with a sampling rate of its own, do
// not resolve the mesh frequency.
void check_own_rates(const Study& study, double mesh_frequency_Hz) {
    const auto check = [&](const char* key, const std::string& name, double rate_Hz) {
        if (rate_Hz < 2.0 * mesh_frequency_Hz) {
            throw SceneError(key,
                             fmt::format("{}{} Hz is below twice the mesh frequency ({:.4g} Hz)",
                                         name, rate_Hz, mesh_frequency_Hz),
                             fmt::format("use at least {:.4g} Hz", 2.0 * mesh_frequency_Hz));
        }
    };
    for (const AdditionalSensor& sensor : study.sensor.additional) {
        if (sensor.sampling_Hz) {
            check("sensor.additional", fmt::format("sensor \"{}\": sampling_Hz = ", sensor.name),
                  *sensor.sampling_Hz);
        }
    }
    check("sensor.encoder_sampling_Hz", "", study.sensor.encoder_sampling_Hz);
}

Sampling choose_sampling(const Study& study, double mesh_frequency_Hz) {
    const bool sensor = !study.effects.quasi_static();
    const char* const key = sensor ? "sensor.sampling_Hz" : "sensor.encoder_sampling_Hz";
    const double rate = sensor ? study.sensor.sampling_Hz : study.sensor.encoder_sampling_Hz;
    Sampling result;
    // Fourier transforms of a whole planet turn stay fast.
    result.samples = signals::smooth_length(samples_at_least(rate, mesh_frequency_Hz, key));
    if (result.samples < kFewestSamples) {
        throw SceneError(
            key,
            fmt::format("{} sample(s) per mesh period are too few to {} (mesh frequency {:.4g} Hz)",
                        result.samples, sensor ? "window" : "average", mesh_frequency_Hz),
            fmt::format("use at least {:.4g} Hz", kFewestSamples * mesh_frequency_Hz));
    }
    check_own_rates(study, mesh_frequency_Hz);
    result.te_samples = std::min(samples_at_least(study.sensor.encoder_sampling_Hz,
                                                  mesh_frequency_Hz, "sensor.encoder_sampling_Hz"),
                                 result.samples);
    while (result.samples % result.te_samples != 0) {
        ++result.te_samples;
    }
    const features::SignalSet needs = compared_needs(used_features(study)).all();
    if (needs.has<features::TeParts>() && result.te_samples < kFewestSamples) {
        throw SceneError("sensor.encoder_sampling_Hz",
                         fmt::format("{} sample(s) per mesh period are too few for te_fm4, te_m6a "
                                     "and te_m8a, which split the transmission error",
                                     result.te_samples),
                         fmt::format("use at least {:.4g} Hz, or remove these features",
                                     kFewestSamples * mesh_frequency_Hz));
    }
    return result;
}

// `mode_inertia`: additional inertia of the nominal gearbox. Throws SceneError.
Stepping choose_stepping(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox,
                         const lockstep::ModeInertia& mode_inertia) {
    const StepNeeds needs(study, sampler, gearbox, mode_inertia);
    const lockstep::Integrator integrator = integrator_of(study, needs);
    const int given = study.numerics.steps_per_mesh;
    Stepping stepping = is_explicit(integrator)
                            ? explicit_stepping(needs, integrator, given, mode_inertia.modes > 0)
                            : implicit_stepping(needs, integrator, given);
    stepping.explicit_steps = needs.stable(lockstep::kUsualExplicit);
    return stepping;
}

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

// Chooses the phase grid. `transitions`: phases at which steps must end. `pilot` is called only if
// the study requests graded steps. Throws SceneError.
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
    for (const InstanceInputs& inputs : pilot_inputs(study, sampler)) {
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

// Throws SceneError if kernels are missing, or if steps or samples are too coarse for a
// fluctuation.
void check_excitation_resolved(const Study& study, const Sampler& sampler,
                               const GearboxPlan& gearbox, const lockstep::IntegrationPlan& plan) {
    if (!gearbox.excitation) {
        return;
    }
    if (study.effects.quasi_static()) {
        // It has no time steps, only the encoders' samples.
        const double rate = highest_frequency(study, sampler, gearbox);
        if (plan.grid.samples < 2.0 * rate) {
            throw SceneError("sensor.encoder_sampling_Hz",
                             fmt::format("{} samples per mesh period are too few for the fastest "
                                         "fluctuation ({:.3g} cycles per mesh period)",
                                         plan.grid.samples, rate),
                             "raise the rate, or use a slower fluctuation");
        }
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

// Throws SceneError if a tone of a shaft, or the impulses of a bearing, are not below half the
// sampling rate.
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
            // Static transmission errors of one kind of mesh are the same for all planets, shifted
            // by their mesh phases.
            const MeshKind first = gearbox_.kind == GearboxKind::fixed_shaft ? MeshKind::pinion_gear
                                                                             : MeshKind::sun_planet;
            std::vector<lockstep::MeshError> errors(
                static_cast<std::size_t>(drivetrain_.pairs_per_mesh()), error_of(first));
            errors.resize(static_cast<std::size_t>(pairs.pairs()), error_of(MeshKind::ring_planet));
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

double resolved_tolerance(const Numerics& numerics) {
    constexpr double kFinestInSingle = 1e-5;
    return numerics.precision == Precision::single_precision
               ? std::max(numerics.convergence_tolerance, kFinestInSingle)
               : numerics.convergence_tolerance;
}

std::optional<std::size_t> distinct_integrations(const Study& study) {
    if (has_tooth_errors(study) || has_random_planets(study) || has_random_fluctuations(study)) {
        return std::nullopt;
    }
    std::size_t count = 1;
    for (const RandomInput& input : study.random) {
        if (input.kind == InputKind::sensor) {
            continue;
        }
        std::vector<double> values = input.distribution.levels();
        if (values.empty()) {
            return std::nullopt;
        }
        if (input.kind == InputKind::fault_size) {
            values.push_back(0.0);  // the healthy gearboxes of the threshold sample
        }
        std::ranges::sort(values);
        count *=
            static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
    }
    return count;
}

// Largest number of mesh periods within which a gearbox must converge: twice that in which the
// nominal gearbox's slowest mode decays to the tolerance, within bounds.
int max_meshes(const SolveSettings& settings, double decay_meshes) {
    constexpr double kFewest = 200.0, kMost = 1e6;
    if (settings.quasi_static) {
        return 1;
    }
    const double decay = -2.0 * decay_meshes * std::log(settings.convergence_tolerance);
    return settings.numerics.max_meshes > 0
               ? settings.numerics.max_meshes
               : static_cast<int>(std::isfinite(decay) ? std::clamp(decay, kFewest, kMost)
                                                       : kFewest);
}

int run_in(const SolvePlan& plan, const GearboxPlan& gearbox) {
    constexpr double kFewest = 10.0;
    if (plan.settings.repeats || plan.settings.quasi_static) {
        return 0;
    }
    // Twice the decay time of the nominal gearbox and its sensor, because other gearboxes decay
    // more slowly.
    const double decays = -2.0 * std::log(plan.convergence.tolerance);
    // Decay of the slowest mode of the sensor's low-pass filter to 1/e.
    const double filter_1_s = 0.5 * lockstep::kFilterDamping[1] * plan.integration().low_pass_rad_s;
    const double meshes =
        decays * std::max(plan.stepping().decay_meshes, gearbox.mesh_frequency_Hz / filter_1_s);
    return static_cast<int>(
        std::min(std::ceil(std::max(kFewest, meshes)), static_cast<double>(plan.longest_run_in())));
}

// Mesh periods that the nominal gearbox needs to converge to its periodic orbit.
double approach_meshes(const SolvePlan& plan) {
    return plan.settings.quasi_static ? 0.0
                                      : std::min(1.0 + plan.stepping().decay_meshes *
                                                           -std::log(plan.convergence.tolerance),
                                                 static_cast<double>(plan.convergence.max_meshes));
}

// Mesh periods of the fault pattern that a fault changes: its passages and the decay after them.
double passage_meshes_of_pattern(const GearboxPlan& gearbox, double approach_meshes) {
    const lockstep::FaultPattern& pattern = gearbox.fault().pattern();
    if (pattern.passages.empty()) {
        return 0.0;
    }
    const auto& curve = gearbox.pairs().curve(pattern.passages[0].pair);
    const double passage = std::ceil(curve.contact_ratio()) + approach_meshes;
    return std::min(passage * static_cast<double>(pattern.passages.size()),
                    static_cast<double>(pattern.length));
}

// Periods of the motions that are superposed.
std::vector<int> part_periods(const GearboxPlan& gearbox) {
    std::vector<int> teeth;
    for (const int count : gearbox.teeth.values) {
        if (count > 0) {
            teeth.push_back(count);
        }
    }
    return lockstep::part_periods(std::move(teeth));
}

}  // namespace

ScenePlan make_plan(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox) {
    return PlanBuilder(study, sampler, gearbox).make();
}

SolveSettings::SolveSettings(const Study& study)
    : numerics(study.numerics),
      quasi_static(study.effects.quasi_static()),
      repeats(reason_not_periodic(study).empty()),
      convergence_tolerance(resolved_tolerance(study.numerics)),
      distinct_integrations(mc::distinct_integrations(study)) {}

SolvePlan::SolvePlan(const SolveSettings& given, const GearboxPlan& gearbox,
                     const RecordPlan& record, std::shared_ptr<const ScenePlan> scene_plan)
    : settings(given),
      steps(std::move(scene_plan)),
      convergence{settings.convergence_tolerance, max_meshes(settings, stepping().decay_meshes)} {
    const bool periodic = settings.numerics.horizon == Horizon::periodic;
    const bool coupled = std::ranges::any_of(
        gearbox.stages, [](const StagePlan& stage) { return stage.shaft.has_value(); });
    run_in_meshes = run_in(*this, gearbox);
    records_during_integration =
        !periodic && !settings.quasi_static && !settings.distinct_integrations;
    reuses_results = settings.distinct_integrations && !coupled;
    perturbation_only = !periodic && !settings.quasi_static && !gearbox.excitation && !coupled &&
                        record.recorded_meshes == record.span.meshes();

    const double approach = approach_meshes(*this);
    const double pattern_meshes = passage_meshes_of_pattern(gearbox, approach);
    const double span_meshes = run_in_meshes + record.recorded_meshes;
    passage_meshes =
        std::min(pattern_meshes * span_meshes / gearbox.fault().pattern().length, span_meshes);
    bool records_only = false;
    test_record_meshes = record.recorded_meshes;
    if (record.same_window > 1 && !periodic) {
        const int meshes = record.turns(gearbox.nominal) * record.span.planet_teeth;
        records_only = 2 * (run_in_meshes + meshes) <= record.signal_meshes;
        if (records_only) {
            test_record_meshes = std::min(meshes, test_record_meshes);
        }
    }
    const double full_meshes = approach + run_in_meshes + test_record_meshes;
    const lockstep::MeshRecord mesh =
        lockstep::make_record(integration(), settings.numerics.lanes, false);
    mesh_record_bytes = 8.0 * static_cast<double>(mesh.acceleration.size() + mesh.te.size());
    if (periodic) {
        strategy = PeriodicOrbit{};
        healthy_meshes = approach;
        integrated_meshes = approach + pattern_meshes;
        record_bytes = mesh_record_bytes * (1.0 + pattern_meshes);
    } else {
        strategy = EveryMeshPeriod{records_only};
        healthy_meshes = integrated_meshes = full_meshes;
        record_bytes = mesh_record_bytes * (1.0 + record.recorded_meshes);
    }
    if (settings.quasi_static) {
        strategy = StaticEquilibrium{periodic};
    } else if (coupled) {
        strategy = CoupledStages{
            static_cast<int>(coupled_run_in(gearbox, convergence.tolerance, run_in_meshes))};
    } else if (settings.numerics.horizon == Horizon::superposed) {
        const std::vector<int> periods = part_periods(gearbox);
        const double parts = approach + lockstep::part_meshes(periods, run_in_meshes);
        if (parts < full_meshes) {
            const bool faulty = parts + passage_meshes < full_meshes;
            strategy = Superposed{faulty};
            healthy_meshes = parts;
            integrated_meshes = faulty ? parts + passage_meshes : full_meshes;
            record_bytes = mesh_record_bytes *
                           (1.0 + record.recorded_meshes + lockstep::part_meshes(periods, 0));
        }
    }
}

std::string integrated_records_text(const RecordPlan& record, const SolvePlan& solve) {
    const auto* every_mesh = std::get_if<EveryMeshPeriod>(&solve.strategy);
    return !record.length || every_mesh == nullptr ? ""
           : every_mesh->records_only
               ? fmt::format("; only the records, each after a run-in of {}", solve.run_in_meshes)
           : record.same_window > 1
               ? "; all of the signal, because the records alone would save less than half"
               : "; all of the signal, because fluctuating speed, an elastic shaft or a response "
                 "of "
                 "the housing needs it";
}

}  // namespace gearpod::mc
