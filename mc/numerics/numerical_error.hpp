// The numerical error of a run's results: found on some of its gearboxes by finer steps, and set
// against what the number of gearboxes leaves uncertain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "mc/numerics/rung.hpp"
#include "mc/results/results_file.hpp"
#include "mc/results/row_source.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// The scene with four times the steps (or what the integrator allows), settled to 1e-10. None of a
// quasi-static study.
struct FinerScene {
    Rung rung;
    std::optional<Scene> scene;
};
FinerScene with_finer_steps(const Scene& scene);
// The same, but none unless the study has numerics.tolerance or numerics.verify.
FinerScene finer_scene(const Scene& scene);

// Eight graded gearboxes, spread over the ensemble, marched as the run did and again by
// finer_scene(): what that changes is the error of the run's own steps but for a sixteenth or less,
// at order 2 and above. Nothing where there is no finer scene.
std::optional<NumericalError> find_numerical_error(const Scene& scene);

// One feature at one noise level.
struct NumericalShare {
    std::string feature;
    double noise_level = 0.0;
    double rms = 0.0;     // numerical error, in the feature's unit
    double spread = 0.0;  // standard deviation of the healthy threshold sample
    // Largest share of a size's gearboxes whose verdict the error could turn: within twice the
    // largest error of the threshold, which has an error of its own. Beside it the largest half
    // width of the intervals of the same detection rates. NaN without a threshold.
    double pd = 0.0, pd_half_width = 0.0;
    // That share in terms of a90 (over the POD curve's slope there), and a90's upper bound less
    // a90; in the unit of the sizes. NaN without an a90, infinite where the bound is not reached.
    double a90 = 0.0, a90_interval = 0.0;
    bool numerical_dominates = false;  // of Pd, or where there is none of the feature itself
};
std::vector<NumericalShare> numerical_shares(
    const Results& frame, const RowSource& rows,
    const std::optional<analysis::Reliability>& reliability);

// "" without a verified error.
std::string numerical_text(const Results& frame, const std::vector<NumericalShare>& shares);

}  // namespace gearpod::mc
