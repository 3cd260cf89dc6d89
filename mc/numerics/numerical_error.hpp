// Numerical error of a run's results: estimated with finer steps on some of its gearboxes, and
// compared with the statistical uncertainty.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "machine/fields.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/plan/planner.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Standard deviation of a sample; NaN for fewer than two values.
double standard_deviation(const std::vector<double>& values);

// Setting with four times the steps of these numerics (or as many as the integrator allows),
// converged to 1e-10; with mass scaling instead without it, with the steps of the integrator's own
// rule. Empty for a quasi-static study.
std::optional<SolverSetting> finer_setting(const Planner& planner, const Numerics& numerics);

// Rows of gearboxes that were computed with fine steps.
struct FineRows {
    Numerics numerics;
    std::vector<GearboxId> ids;
    BatchRows rows;
};

// Gearboxes of numerics.paired_gearboxes: faulty ones of the test group spread over its sizes, then
// as many healthy ones, the first of the threshold group. Where gearboxes share the positions of
// their records, faulty ones are neighbours, so that one tile integrates them: alone, each would
// cost as much as a whole tile.
std::vector<GearboxId> paired_gearboxes(const TilePlan& tile, const EnsemblePlan& ensemble,
                                        int pairs);

// The rows of these gearboxes, still without values, and the values of the features of computed
// rows (rows x features x noise levels).
AssumptionRows changed_rows(const RowOrder& order, std::span<const GearboxId> ids);
std::vector<double> feature_values(const RowShape& shape, const BatchRows& rows);

// Integrates eight test gearboxes, spread over the ensemble (neighbours where gearboxes share the
// positions of their records), as the run did and again with
// finer_setting(); with numerics.paired_gearboxes that many, and as many healthy ones. For
// methods of order 2 and above, the difference is the error of the run's own steps to within a
// sixteenth. Empty unless the study has a tolerance, numerics.verify or numerics.paired_gearboxes
// (SolverFacts::verified). `run`: all rows of the run; `fine`: rows with fine steps. What they hold
// is not computed again.
std::optional<NumericalError> find_numerical_error(const Planner& planner,
                                                   const RowSource* run = nullptr,
                                                   const FineRows* fine = nullptr);

// Numerical and statistical uncertainty of one feature at one noise level.
struct NumericalContribution {
    std::string feature;
    double noise_level = 0.0;
    double rms = 0.0;     // numerical error, in the feature's unit
    double spread = 0.0;  // standard deviation of the healthy threshold sample
    // pd: largest fraction of a size's gearboxes whose alarm the error could change, over all
    // sizes. Those lie within twice the largest error of the threshold, which has an error itself.
    // pd_half_width: largest half width of the intervals of the same detection rates. NaN without a
    // threshold.
    double pd = 0.0, pd_half_width = 0.0;
    bool numerical_dominates = false;  // for Pd, or without a threshold for the feature itself
};
GEARPOD_FIELDS(NumericalContribution, feature, noise_level, rms, healthy_spread, pd, pd_half_width,
               dominates_)
std::vector<NumericalContribution> numerical_contributions(const Results& frame,
                                                           const RowSource& rows);

// Discretization error of the signals of gearboxes whose teeth lose contact. Loss of contact
// happens at times that lie between grid nodes, which reduces an integrator's order. A tolerance
// for the steps between contact transitions does not bound this error.

// Integrates eight test gearboxes over a few mesh periods as a run does, and again with finer
// steps in double precision. Empty if teeth cannot separate, if the study is quasi-static, or if no
// gearbox of the pilot succeeds. Also empty if the pilot costs more than `most_meshes` mesh periods
// of a tile with the steps of the run.
std::optional<StepError> find_step_error(const Planner& planner, double most_meshes);
// The same for a run of this many gearboxes; it may cost a fiftieth of their work.
std::optional<StepError> find_step_error_of_run(const Planner& planner, std::size_t gearboxes);

// "3.5e-03 of the sensor signal, ... (rms; 8 gearboxes, 16 mesh periods, 240 against 960 steps)".
std::string step_error_text(const StepError& error);

}  // namespace gearpod::mc
