// How the gearboxes of a study are solved: the strategy with its settings, the steps, the criterion
// of convergence, and estimates of what a tile integrates and keeps.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/integrator.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "lockstep/tile/tile.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"

namespace gearpod::mc {

// Integrator and numbers of steps per mesh period of a study.
struct Stepping {
    lockstep::Integrator integrator = lockstep::kUsualExplicit;
    int steps = 1;
    // Smallest number of steps per mesh period. With fewer, the integrator is unstable for some
    // gearbox of the pilot sample or the sensor's low-pass is inaccurate.
    int least = 1;
    // Number of mesh periods in which a disturbance of the nominal gearbox decays by 1/e; infinite
    // without damping.
    double decay_meshes = 0.0;
    // Longest step, in mesh periods, at which the integrator is stable with a margin and the
    // sensor's low-pass still accurate.
    double longest_step = 1.0;
    // Number of steps per mesh period with which lockstep::kUsualExplicit is stable, used or not.
    double explicit_steps = 0.0;
};
// Result of calibrating the steps on a pilot sample.
struct Calibration {
    double signal_error = 0.0;
    lockstep::Grading grading;
};

// Integration plan of a study's gearboxes: integrator, steps and samples, and the stiffness at
// their nodes. It does not depend on the convergence tolerance, so scenes that differ only in that
// share one plan.
struct ScenePlan {
    lockstep::IntegrationPlan integration;
    Stepping stepping;
    // Calibration of the steps on a pilot sample; empty if there was none.
    std::optional<Calibration> calibration;
    int te_samples = 0;  // number of encoder samples per mesh period
};

// Throws SceneError.
ScenePlan make_plan(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox);

// The periodic orbit of a mesh period is integrated, and the passages of the faulty tooth.
struct PeriodicOrbit {};
// Every mesh period of the span is integrated.
struct EveryMeshPeriod {
    bool records_only = false;  // of the windows of the records, because that saves at least half
};
// The effects of each gear's tooth errors are integrated, and superposed while the teeth keep
// contact. Other gearboxes are integrated in full.
struct Superposed {
    bool faulty = false;  // also those with a fault
};
// The static equilibrium is solved at the samples of one mesh period, or of every one.
struct StaticEquilibrium {
    bool periodic = false;
};
// Every mesh period is integrated together with the stages that elastic shafts couple.
struct CoupledStages {
    int run_in_meshes = 0;
};
using SolutionStrategy =
    std::variant<PeriodicOrbit, EveryMeshPeriod, Superposed, StaticEquilibrium, CoupledStages>;

struct SolveSettings {
    explicit SolveSettings(const Study& study);

    Numerics numerics;  // as the study gives them
    bool quasi_static;
    bool repeats;                  // all mesh periods of a healthy gearbox are equal
    double convergence_tolerance;  // or the smallest that the precision can resolve
    // Number of distinct sets of inputs to the time integration. Empty if all gearboxes differ:
    // such an input has a continuous distribution, or every tooth or planet has errors of its own.
    std::optional<std::size_t> distinct_integrations;
};

struct SolvePlan {
    SolvePlan(const SolveSettings& settings, const GearboxPlan& gearbox, const RecordPlan& record,
              std::shared_ptr<const ScenePlan> steps);

    const lockstep::IntegrationPlan& integration() const { return steps->integration; }
    const Stepping& stepping() const { return steps->stepping; }
    // Upper limit of the run-in, in mesh periods. Fluctuations always begin this long before the
    // first recorded mesh period, so that they do not depend on the actual run-in.
    int longest_run_in() const { return convergence.max_meshes / 2; }

    SolveSettings settings;
    std::shared_ptr<const ScenePlan> steps;
    // Largest number of mesh periods within which a gearbox must converge, and relative change at
    // which an orbit counts as converged.
    lockstep::Convergence convergence;
    // Mesh periods that are integrated before the first recorded one. In this time, the transient
    // from the onset of tooth errors or variable excitation decays to the convergence tolerance.
    int run_in_meshes = 0;
    SolutionStrategy strategy;
    // True if sensor signals are recorded during integration and the motion is not kept: every mesh
    // period is integrated and no other tile can use the result.
    bool records_during_integration = false;
    // True if solutions are cached for tiles of the same gearboxes.
    bool reuses_results = false;
    // True if a fault only takes the perturbation of the healthy solution: every mesh period of the
    // span is integrated under a constant excitation and without coupled stages.
    bool perturbation_only = false;

    // Estimates from the nominal damping; most gearboxes need about as many mesh periods.

    // Mesh periods that a tile of test records records one by one.
    int test_record_meshes = 0;
    // Mesh periods that a tile integrates or solves, with and without a fault; and those of its
    // run-in and span that a fault changes, with the decay after its passages.
    double integrated_meshes = 0.0, healthy_meshes = 0.0, passage_meshes = 0.0;
    // Memory in bytes for the record of a mesh period, and for all records of a tile.
    double mesh_record_bytes = 0.0, record_bytes = 0.0;
};

// Part of the signal that is integrated for records of given length, "; only the records, ...";
// empty for others, and if mesh periods repeat.
std::string integrated_records_text(const RecordPlan& record, const SolvePlan& solve);

}  // namespace gearpod::mc
