#include "mc/scene/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/facts.hpp"
#include "mc/scene/scene_error.hpp"

namespace gearpod::mc {
namespace {

constexpr int kMostPilotSteps = 50'000;  // per mesh period; a pilot integrates many of them

lockstep::PhaseGrid with_nodes(lockstep::PhaseGrid grid, lockstep::Integrator integrator) {
    grid.stage_nodes = lockstep::stage_nodes(integrator);
    return grid;
}

[[noreturn]] void refuse_tolerance(const char* key, double tolerance, const std::string& what) {
    throw SceneError(key, fmt::format("{:g} cannot be met: {}", tolerance, what),
                     "allow a larger one, or use grid = \"uniform\" and numerics.steps_per_mesh");
}

// Steps of an integrator from its own error estimate. Graded: in each cell between samples and
// transitions as long as the estimate allows. Uniform: everywhere as short as the worst cell
// requires.
SceneGrid estimated_grid(const Study& study, const Stepping& stepping, int samples,
                         const std::vector<double>& transitions, const lockstep::Pilot& pilot) {
    // Twice as many steps as stability requires: at the stability limit the method damps the motion
    // whose error is to be estimated.
    lockstep::PhaseGrid uniform =
        lockstep::make_phase_grid(samples, 2 * stepping.steps, transitions);
    uniform.stage_nodes = lockstep::stage_nodes(stepping.integrator);
    uniform.stage_nodes.push_back(1.0);  // requests the error estimate
    const lockstep::StepProfile profile =
        lockstep::estimated_profile(pilot, uniform, study.numerics.step_tolerance);
    const auto longest = [&](double start, double end) {
        return std::min(stepping.longest_step, profile.longest_step(start, end));
    };
    const double steps = std::ceil(1.0 / longest(0.0, 1.0));
    if (!(steps <= kMostSteps)) {
        refuse_tolerance("numerics.step_tolerance", study.numerics.step_tolerance,
                         fmt::format("{:.3g} steps per mesh period would be needed (at most {})",
                                     steps, kMostSteps));
    }
    lockstep::PhaseGrid grid =
        study.numerics.grid == StepGrid::graded
            ? lockstep::make_divided_grid(samples, transitions, longest)
            : lockstep::make_phase_grid(samples, static_cast<int>(steps), transitions);
    Calibration calibration;
    calibration.estimated = true;
    return {with_nodes(std::move(grid), stepping.integrator), calibration};
}

// Explicit steps must stay stable and have a node on every sample; implicit ones may have any
// length.
SceneGrid graded_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions, const lockstep::Pilot& pilot) {
    const auto grid_of = [&](const lockstep::Grading& grading) {
        if (!is_explicit(stepping.integrator)) {
            return with_nodes(lockstep::make_graded_grid(samples, transitions, grading),
                              stepping.integrator);
        }
        const auto longest = [&](double start, double) {
            const double since = lockstep::since_transition(transitions, start);
            return std::min(stepping.longest_step, lockstep::longest_step(grading, since));
        };
        return with_nodes(lockstep::make_divided_grid(samples, transitions, longest),
                          stepping.integrator);
    };
    const double tolerance = study.numerics.grid_tolerance;
    lockstep::GradedChoice choice =
        lockstep::choose_grading(pilot, 1.0 / stepping.steps, tolerance, grid_of);
    if (!choice.reached) {
        refuse_tolerance(
            "numerics.grid_tolerance", tolerance,
            fmt::format("with {} steps per mesh period the pilot's signals have an error of {:.2g}",
                        choice.grid.steps.size(), choice.error));
    }
    Calibration calibration;
    calibration.signal_error = choice.error;
    calibration.grading = choice.grading;
    return {std::move(choice.grid), calibration};
}

}  // namespace

SceneGrid choose_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions,
                      const std::function<lockstep::Pilot()>& pilot) {
    const Numerics& n = study.numerics;
    const bool moves = !study.effects.quasi_static();
    const bool graded = moves && n.grid == StepGrid::graded;
    const bool estimated = moves && lockstep::facts(stepping.integrator).estimates_error &&
                           (graded || n.steps_per_mesh == 0);
    if ((graded || estimated) && stepping.steps > kMostPilotSteps) {
        throw SceneError(
            graded ? "numerics.grid" : "numerics.steps_per_mesh",
            fmt::format("a pilot with {} steps per mesh period takes too long (at most {})",
                        stepping.steps, kMostPilotSteps),
            graded ? "use grid = \"uniform\"" : "give steps_per_mesh, or use another integrator");
    }
    if (estimated) {
        return estimated_grid(study, stepping, samples, transitions, pilot());
    }
    if (graded) {
        return graded_grid(study, stepping, samples, transitions, pilot());
    }
    return {with_nodes(lockstep::make_phase_grid(samples, stepping.steps, transitions),
                       stepping.integrator),
            std::nullopt};
}

}  // namespace gearpod::mc
