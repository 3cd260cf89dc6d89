// Numerics that were chosen on pilot gearboxes, and the error with which they were.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

struct NumericsChoice {
    SolverSetting setting;
    // Relative error of the pilot's worst feature, or its error over the feature's scatter.
    double error = 0.0;
    bool of_scatter = false;    // true for the latter
    double tolerance = 0.0;     // of that error
    std::string worst_feature;  // name of that feature
    double cost = 0.0;  // of integrating the pilot by the cost model, in rk4 steps per gearbox
    int gearboxes = 0;  // number of pilot gearboxes
    // Rows with fine steps of numerics.scatter_tolerance: of the pilot, and of the pairs if they
    // were asked for.
    std::shared_ptr<const FineRows> fine = {};

    std::string text() const;
};

// Numerics with at most this many steps per mesh period, apart from those at contact transitions,
// and the highest limit of the mass scaling found that allows them; empty if none does.
// `unscaled`: central differences without mass scaling. `fastest_Hz`:
// Planner::fastest_mode_Hz(). Throws SceneError if they cannot be used.
std::optional<Numerics> scaled_numerics(const Planner& planner, const Numerics& unscaled,
                                        double fastest_Hz, int steps);

// Numerics with the steps of a tolerance, and how they were chosen; `choice` is empty without one.
struct ResolvedNumerics {
    Numerics numerics;
    std::optional<NumericsChoice> choice;
};

// Chooses the numerics of a study for the tolerance in `numerics`. With numerics.tolerance: the
// least expensive candidate setting that keeps every feature of a pilot within it. With
// numerics.scatter_tolerance: integrates the first sixteen healthy gearboxes with the steps of the
// integrator's own rule, and with fewer steps and more mass scaling. If both are given, they are
// the only candidate. The choice depends on the study only, not on timing, lanes, threads or
// instruction set. Throws SceneError if no candidate keeps the tolerance, or if a key that would be
// chosen is given. `pairs`: the gearboxes of numerics.paired_gearboxes are computed with the pilot.
ResolvedNumerics resolve_numerics(const Planner& planner, const Numerics& numerics,
                                  bool pairs = false);

// Plan of a study with resolved numerics. Throws SceneError.
Scene resolved_plan(const Study& study);

// Choices made with a scene: numerics for the tolerance; the same with the pairs of a run
// (resolve_numerics()); nothing, because the study of a results file has what its run chose.
enum class Choosing { numerics, numerics_with_pairs, nothing };

// Makes the scene of a study that has been read.

struct StudyScene {
    std::unique_ptr<const Scene> scene;    // null: see `problems`
    std::optional<NumericsChoice> choice;  // of the numerics; empty without a tolerance
    Problems problems;
    Problems notices = {};           // StudyReading::notices
    std::optional<Planner> planner;  // of the study with the chosen numerics

    explicit operator bool() const { return scene != nullptr; }
};

// Sets the kernels' instruction set, chooses the numerics and makes the scene. Messages about
// problems use `name` for the study.
StudyScene make_scene(const std::string& name, StudyReading reading,
                      Choosing choosing = Choosing::numerics);

}  // namespace gearpod::mc
