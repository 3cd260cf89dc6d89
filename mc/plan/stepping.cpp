#include "mc/plan/stepping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"
#include "mc/plan/feature_plan.hpp"
#include "mc/plan/scene_error.hpp"
#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::mc {
namespace {

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
        // A pilot sample of the ensemble, the same for every run of the study, represents the other
        // gearboxes.
        constexpr std::uint64_t kPilot = 32;
        for (std::uint64_t i = 0; i < (study.random.empty() ? 0 : kPilot); ++i) {
            gearboxes_.push_back(test_gearbox(i));
        }
        const dynamics::GearboxInputs& nominal = gearboxes_[0];
        check_equal_masses();
        const double decay_1_s =
            lockstep::slowest_decay_1_s(system(nominal), dynamics::rigid_rotation(layout_));
        if (decay_1_s == 0.0) {
            throw SceneError("gearbox", "a vibration without damping has no steady state",
                             "add damping to the meshes, or to all bearings and couplings");
        }
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
        for (std::uint64_t i = 0; i < (study_.random.empty() ? 0 : kPilot); ++i) {
            needs.push_back(needed_steps(test_gearbox(i), integrator));
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
    dynamics::GearboxInputs test_gearbox(std::uint64_t i) const {
        return gearbox_.inputs(sampler_.draw({Group::test, i}).inputs);
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

}  // namespace

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

}  // namespace gearpod::mc
