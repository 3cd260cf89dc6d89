#include "mc/scene/excitation_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/excited_integrator.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/scene/stepping.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// Highest fluctuation frequency of a gearbox (sine or noise band), in cycles per mesh period.
double highest_frequency(const Study& study, const Drivetrain& drivetrain,
                         const InstanceInputs& in) {
    const FluctuationInstance& f = in.fluctuations;
    const double period_s = dynamics::mesh_period_s(gearbox_inputs(study, drivetrain, in));
    const double turns = drivetrain.input_turns_per_mesh();
    double result = 0.0;
    if (torque_has_sine(study)) {
        result = std::max(f.torque_order * turns, f.torque_Hz * period_s);
    }
    if (speed_has_sine(study)) {
        result = std::max(result, f.speed_order * turns);
    }
    if (torque_has_noise(study)) {
        result = std::max(result, f.torque_noise_Hz * period_s);
    }
    if (speed_has_noise(study)) {
        result = std::max(result, f.speed_noise_Hz * period_s);
    }
    return result;
}

// The same, the maximum over the nominal gearbox and a pilot sample of the ensemble.
double highest_frequency(const Study& study, const Sampler& sampler, const Drivetrain& drivetrain) {
    double result = highest_frequency(study, drivetrain, nominal_inputs(study));
    constexpr std::uint64_t kPilot = 32;
    for (std::uint64_t i = 0; i < (study.random.empty() ? 0 : kPilot); ++i) {
        const InstanceInputs inputs = sampler.draw({Group::graded, i}).inputs;
        result = std::max(result, highest_frequency(study, drivetrain, inputs));
    }
    return result;
}

void check_kernels(const Study& study, const lockstep::IntegrationPlan& plan) {
    lockstep::Excitation excitation;
    if (speed_fluctuates(study)) {
        excitation.speed.emplace();
    }
    if (lockstep::supports_excitation(plan, excitation)) {
        return;
    }
    const std::string what = speed_fluctuates(study)    ? "a fluctuating speed"
                             : torque_fluctuates(study) ? "a fluctuating torque"
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
void check_samples(const Study& study, const Sampler& sampler, const Drivetrain& drivetrain,
                   int samples) {
    const double rate = highest_frequency(study, sampler, drivetrain);
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
                               const Drivetrain& drivetrain,
                               const lockstep::IntegrationPlan& plan) {
    if (!has_variable_excitation(study)) {
        return;
    }
    if (study.effects.quasi_static()) {
        check_samples(study, sampler, drivetrain, plan.grid.samples);
        return;
    }
    check_kernels(study, plan);
    constexpr double kStepsPerPeriod = 20.0;
    const double needed = kStepsPerPeriod * highest_frequency(study, sampler, drivetrain);
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

}  // namespace gearpod::mc
