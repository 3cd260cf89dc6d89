// Results of `accuracy`: time of every solver setting and its error relative to a converged
// reference, and the setting that numerics.tolerance would choose.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "machine/fields.hpp"
#include "mc/numerics/measured_effects.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/plan/planner.hpp"
#include "mc/plan/scene.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Effect of a solver setting on detection rates: the same ensemble computed with two settings.
struct DetectionChange {
    long gearboxes = 0;   // test gearboxes
    double alarms = 0.0;  // fraction of alarm decisions (gearbox, feature, noise level) that differ
    double pd = 0.0;      // largest change of a detection rate
    double pd_half_width = 0.0;  // of that rate's interval, in the reference
    double a90 = -1.0;           // largest relative change of an a90 that both reach; -1: none
    double a90_interval = 0.0;   // of that a90: (upper bound - a90) / a90; infinite if not reached
};
GEARPOD_FIELDS(DetectionChange, gearboxes, alarms_changed, pd_change, pd_half_width, a90_change_,
               a90_interval)

// Stability map of a study: steps per mesh period at which each integrator is stable, over the
// stiffness of the meshes.

struct StabilityCurve {
    std::string integrator;
    std::vector<double> steps;  // fewest stable ones, by factor
};
GEARPOD_FIELDS(StabilityCurve, integrator, steps)

struct StabilityMap {
    std::vector<double> factors;         // on the largest stiffness of every gear pair
    std::vector<StabilityCurve> curves;  // of explicit integrators
    std::vector<std::string> implicit;   // integrators that are stable everywhere
    std::string own;                     // the study's integrator
    double own_steps = 0.0;
};

// Gearbox of which a map is made: the nominal one, with the largest stiffness of every gear pair.
struct StabilityCase {
    dynamics::GearboxLayout layout;
    dynamics::GearboxInputs nominal;
    std::vector<double> stiffest_pairs;
};
// Bearings and masses stay; mesh damping follows the study's law. `own`: integrator and steps of
// the study.
StabilityMap stability_map(const StabilityCase& gearbox, const PlannedSteps& own);

// Solver settings that `accuracy` measures first, before their errors are known.

struct ListedSetting {
    SolverSetting setting;
    std::string refusal;  // why it is not measured
};

// Settings to measure: the study's own first; then all uniform steps and graded grids with the
// tightest convergence tolerance; last the study's own with every mesh period integrated.
std::vector<ListedSetting> listed_settings(const Planner& planner);

// Largest numerical error, as a share of a feature's scatter between gearboxes, that hardly changes
// this scatter: by the factor sqrt(1 + 0.2^2) = 1.02.
inline constexpr double kShareOfScatter = 0.2;

// Message for a setting that was not tried for lack of time.
inline constexpr const char* kNotTried = "not measured, because the time was used up (--seconds)";

struct SettingResult {
    SolverSetting setting;
    std::string refusal;  // why it was not measured; all other members are then empty
    int steps = 0;        // of the phase grid, per mesh period
    double meshes = 0.0;  // mesh periods integrated by a tile
    double failed = 0.0;  // pilot gearboxes that failed
    // Processor time per gearbox of one thread in full tiles, s: minimum of the repeats.
    double integration_s = 0.0, total_s = 0.0;
    double mesh_s = 0.0;  // integration_s per integrated mesh period
    PilotError error;
    bool frontier = false;  // true: no setting is both faster and more accurate
    std::optional<DetectionChange> detection;
};

// lockstep::kUsualExplicit at its stability limit, whether it can be used or not.
struct ExplicitLimit {
    double steps = 0.0;   // per mesh period
    double step_s = 0.0;  // per gearbox and step, measured
    double meshes = 0.0;  // mesh periods per tile, with the study's own convergence tolerance
    bool refused = false;
    double mesh_s() const { return steps * step_s; }
    double integration_s() const { return mesh_s() * meshes; }
};

// Setting that a tolerance chooses, compared with the fastest measured one that keeps the
// tolerance.
struct ChoiceCheck {
    double tolerance = 0.0;
    std::string refusal;
    int chosen = -1, best = -1;  // indices in AccuracyReport::settings
    double over_best = 0.0;      // time of the chosen over that of the best, minus 1
};

// Result of another program's method, read from a table.
struct PeerResult {
    std::string name, command;
    double integration_s = 0.0, mesh_s = 0.0;              // per gearbox, per mesh period
    double sensor = 0.0, te = 0.0;                         // as in PilotError
    std::vector<std::pair<std::string, double>> features;  // relative
};
GEARPOD_FIELDS(PeerResult, name, command, gearbox_s, mesh_s, sensor, te, features_)

struct AccuracyReport {
    std::vector<std::string> features;
    std::vector<double> noise_levels;
    // Standard deviation of the features between healthy gearboxes, in their units: [feature *
    // noise levels + level]. Empty without a pilot ensemble.
    std::vector<double> scatter;
    int gearboxes = 0, signal_meshes = 0, span_meshes = 0;
    double mesh_frequency_Hz = 0.0;
    Reference reference;
    ExplicitLimit explicit_limit;
    std::vector<SettingResult> settings;  // the study's own first
    std::vector<ChoiceCheck> choices;
    std::vector<MeasuredEffect> effects;
    StabilityMap stability;
    std::vector<PeerResult> peers;
    std::vector<std::string> left_out;  // omitted for lack of time

    int levels() const { return static_cast<int>(noise_levels.size()); }
    // Error of feature `f` as a share of its scatter, the largest over the noise levels; NaN if
    // the scatter is unknown or zero.
    double share_of_scatter(const PilotError& error, int f) const;
    double largest_share_of_scatter(const PilotError& error) const;
    // True if the change exceeds kShareOfScatter of a feature's scatter; where the scatter is
    // unknown, kChangeOfFeature of a feature.
    bool matters(const PilotError& change) const;
    // Fastest measured setting whose errors are at most `share` of every feature's scatter; -1:
    // none.
    int fastest_within(double share) const;
};

struct AccuracyRequest {
    int repeats = 3;
    std::vector<double> tolerances{1e-2, 1e-3, 1e-4};
    // Number of gearboxes of the pilot ensemble, both groups; 0: none. By default 480, or as many
    // as the time allows.
    std::optional<long> gearboxes;
    double seconds = 300.0;  // processor time after which no part is started; 0: no limit
    std::function<void(const std::string&)> progress = [](const std::string&) {};
};

// `planner`: made of a plan. Throws SceneError.
AccuracyReport measure_accuracy(const Planner& planner, const AccuracyRequest& request);

// Time and error of the study's own setting, and the fastest one whose errors are small compared
// with the features' scatter. Sentences, separated by spaces.
std::string accuracy_headline(const AccuracyReport& report);
// One screen: that sentence, the settings on the frontier, and which effects change a feature.
std::string accuracy_text(const AccuracyReport& report);
std::string accuracy_json(const AccuracyReport& report, const EnsemblePlan& plan);

// Reads a table of other programs' results (CSV: name, command, integration_s, mesh_s, sensor, te,
// then features by name; march_s is the former name of integration_s). Throws std::runtime_error
// with file, line and problem.
std::vector<PeerResult> read_peers(const std::string& path);

}  // namespace gearpod::mc
