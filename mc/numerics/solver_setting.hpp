// Solver setting: one way to compute a study, as a set of keys of [numerics].
#pragma once

#include <string>
#include <vector>

#include "mc/scene/scene.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct SolverSetting {
    std::string integrator;  // as a study file spells it
    int steps = 0;           // per mesh period; 0: chosen by the integrator's own rule
    double convergence_tolerance = 0.0;
    std::vector<std::string> other;  // further overrides, e.g. "numerics.horizon=full"

    // Arguments for --set: "numerics.integrator=sdirk3", ...
    std::vector<std::string> overrides() const;
    std::string text() const;  // "sdirk3, 864 steps, settled to 1e-06"
};

// Setting that the study uses without a tolerance.
SolverSetting own_setting(const Study& study);

// Study with the keys of a setting and without a tolerance. Throws SceneError if the setting is
// invalid for the study.
Study with_setting(const Study& study, const SolverSetting& setting);
Scene setting_scene(const Study& study, const SolverSetting& setting);

// Names of all integrators but "auto".
std::vector<std::string> integrator_names();

}  // namespace gearpod::mc
