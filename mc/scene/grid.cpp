#include "mc/scene/grid.hpp"

#include <fmt/format.h>

#include <utility>

#include "lockstep/integrators/facts.hpp"
#include "mc/scene/scene_error.hpp"

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

}  // namespace gearpod::mc
