// Solver setting: one way to compute a study.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/scene/scene.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct SolverSetting {
    Numerics numerics;  // without a tolerance
    // Keys of [numerics] that the setting chooses in addition to integrator, steps and convergence
    // tolerance, e.g. "precision".
    std::vector<std::string_view> options = {};

    bool chooses(std::string_view option) const;
    std::string_view integrator() const;         // as a study file spells it
    std::vector<std::string> overrides() const;  // "numerics.integrator=sdirk3", ..., for --set
    std::string text() const;                    // "sdirk3, 864 steps, converged to 1e-06"
    bool operator==(const SolverSetting&) const = default;
};

// Setting that the study uses without a tolerance.
SolverSetting own_setting(const Study& study);

// Study with the numerics of a setting. Throws SceneError if the setting is invalid for the study.
Study with_setting(const Study& study, const SolverSetting& setting);

}  // namespace gearpod::mc
