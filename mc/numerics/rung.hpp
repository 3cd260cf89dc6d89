// A rung: one way to compute a study, as the keys of [numerics] that say it.
#pragma once

#include <string>
#include <vector>

#include "mc/scene/scene.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct Rung {
    std::string integrator;  // as a study file spells it
    int steps = 0;           // a mesh period; 0: chosen by the integrator's own rule
    double settle_tolerance = 0.0;
    std::vector<std::string> other;  // further overrides, e.g. "numerics.horizon=march"

    // As --set takes them: "numerics.integrator=sdirk3", ...
    std::vector<std::string> overrides() const;
    std::string text() const;  // "sdirk3, 864 steps, settled to 1e-06"
};

// What the study marches by without a tolerance.
Rung own_rung(const Study& study);

// The study with a rung's keys, and no tolerance of its own. Throws SceneError where the rung has
// no place in the study.
Study with_rung(const Study& study, const Rung& rung);
Scene rung_scene(const Study& study, const Rung& rung);

// The integrators that a study may name, but for "auto".
std::vector<std::string> integrator_names();

}  // namespace gearpod::mc
