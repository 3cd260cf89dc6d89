#include "mc/plan/solve_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/superposed_motion.hpp"
#include "mc/plan/coupled_shafts.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

double resolved_tolerance(const Numerics& numerics) {
    constexpr double kFinestInSingle = 1e-5;
    return numerics.precision == Precision::single_precision
               ? std::max(numerics.convergence_tolerance, kFinestInSingle)
               : numerics.convergence_tolerance;
}

std::optional<std::size_t> distinct_integrations(const Study& study) {
    if (has_tooth_errors(study) || has_random_planets(study) || has_random_fluctuations(study)) {
        return std::nullopt;
    }
    std::size_t count = 1;
    for (const RandomInput& input : study.random) {
        if (input.kind == InputKind::sensor) {
            continue;
        }
        std::vector<double> values = input.distribution.levels();
        if (values.empty()) {
            return std::nullopt;
        }
        if (input.kind == InputKind::fault_size) {
            values.push_back(0.0);  // the healthy gearboxes of the threshold sample
        }
        std::ranges::sort(values);
        count *=
            static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
    }
    return count;
}

// Largest number of mesh periods within which a gearbox must converge: twice that in which the
// nominal gearbox's slowest mode decays to the tolerance, within bounds.
int max_meshes(const SolveSettings& settings, double decay_meshes) {
    constexpr double kFewest = 200.0, kMost = 1e6;
    if (settings.quasi_static) {
        return 1;
    }
    const double decay = -2.0 * decay_meshes * std::log(settings.convergence_tolerance);
    return settings.numerics.max_meshes > 0
               ? settings.numerics.max_meshes
               : static_cast<int>(std::clamp(decay, kFewest, kMost));
}

// Mesh periods in which the slowest mode of the sensor's low-pass filter decays to 1/e.
double filter_decay_meshes(const SolvePlan& plan, const GearboxPlan& gearbox) {
    const double rate = 0.5 * lockstep::kFilterDamping[1] * plan.integration().low_pass_rad_s;
    return gearbox.mesh_frequency_Hz / rate;
}

int run_in(const SolvePlan& plan, const GearboxPlan& gearbox) {
    constexpr double kFewest = 10.0;
    if (plan.settings.repeats || plan.settings.quasi_static) {
        return 0;
    }
    // Twice the decay time of the nominal gearbox and its sensor, because other gearboxes decay
    // more slowly.
    const double decays = -2.0 * std::log(plan.convergence.tolerance);
    const double meshes =
        decays * std::max(plan.stepping().decay_meshes, filter_decay_meshes(plan, gearbox));
    return static_cast<int>(
        std::min(std::ceil(std::max(kFewest, meshes)), static_cast<double>(plan.longest_run_in())));
}

// Mesh periods that the nominal gearbox needs to converge to its periodic orbit.
double approach_meshes(const SolvePlan& plan) {
    return plan.settings.quasi_static ? 0.0
                                      : std::min(1.0 + plan.stepping().decay_meshes *
                                                           -std::log(plan.convergence.tolerance),
                                                 static_cast<double>(plan.convergence.max_meshes));
}

// Mesh periods of the fault pattern that a fault changes: its passages and the decay after them.
double passage_meshes_of_pattern(const GearboxPlan& gearbox, double approach_meshes) {
    const lockstep::FaultPattern& pattern = gearbox.fault().pattern();
    if (pattern.passages.empty()) {
        return 0.0;
    }
    const auto& curve = gearbox.pairs().curve(pattern.passages[0].pair);
    const double passage = std::ceil(curve.contact_ratio()) + approach_meshes;
    return std::min(passage * static_cast<double>(pattern.passages.size()),
                    static_cast<double>(pattern.length));
}

// Periods of the motions that are superposed.
std::vector<int> part_periods(const GearboxPlan& gearbox) {
    std::vector<int> teeth;
    for (const int count : gearbox.teeth.values) {
        if (count > 0) {
            teeth.push_back(count);
        }
    }
    return lockstep::part_periods(std::move(teeth));
}

}  // namespace

SolveSettings::SolveSettings(const Study& study)
    : numerics(study.numerics),
      quasi_static(study.effects.quasi_static()),
      repeats(reason_not_periodic(study).empty()),
      convergence_tolerance(resolved_tolerance(study.numerics)),
      distinct_integrations(mc::distinct_integrations(study)) {}

SolvePlan::SolvePlan(const SolveSettings& given, const GearboxPlan& gearbox,
                     const RecordPlan& record, std::shared_ptr<const ScenePlan> scene_plan)
    : settings(given),
      steps(std::move(scene_plan)),
      convergence{settings.convergence_tolerance, max_meshes(settings, stepping().decay_meshes)} {
    const bool periodic = settings.numerics.horizon == Horizon::periodic;
    const bool coupled = std::ranges::any_of(
        gearbox.stages, [](const StagePlan& stage) { return stage.shaft.has_value(); });
    run_in_meshes = run_in(*this, gearbox);
    records_during_integration =
        !periodic && !settings.quasi_static && !settings.distinct_integrations;
    reuses_results = settings.distinct_integrations && !coupled;
    perturbation_only = !periodic && !settings.quasi_static && !gearbox.excitation && !coupled &&
                        record.recorded_meshes == record.span.meshes();

    const double approach = approach_meshes(*this);
    const double pattern_meshes = passage_meshes_of_pattern(gearbox, approach);
    const double span_meshes = run_in_meshes + record.recorded_meshes;
    passage_meshes =
        std::min(pattern_meshes * span_meshes / gearbox.fault().pattern().length, span_meshes);
    bool records_only = false;
    test_record_meshes = record.recorded_meshes;
    if (record.same_window > 1 && !periodic) {
        const int meshes = record.turns(gearbox.nominal) * record.span.planet_teeth;
        records_only = 2 * (run_in_meshes + meshes) <= record.signal_meshes;
        if (records_only) {
            test_record_meshes = std::min(meshes, test_record_meshes);
        }
    }
    const double full_meshes = approach + run_in_meshes + test_record_meshes;
    const lockstep::MeshRecord mesh =
        lockstep::make_record(integration(), settings.numerics.lanes, false);
    mesh_record_bytes = 8.0 * static_cast<double>(mesh.acceleration.size() + mesh.te.size());
    if (periodic) {
        strategy = PeriodicOrbit{};
        healthy_meshes = approach;
        integrated_meshes = approach + pattern_meshes;
        record_bytes = mesh_record_bytes * (1.0 + pattern_meshes);
    } else {
        strategy = EveryMeshPeriod{records_only};
        healthy_meshes = integrated_meshes = full_meshes;
        record_bytes = mesh_record_bytes * (1.0 + record.recorded_meshes);
    }
    if (settings.quasi_static) {
        strategy = StaticEquilibrium{periodic};
    } else if (coupled) {
        strategy = CoupledStages{
            static_cast<int>(coupled_run_in(gearbox, convergence.tolerance, run_in_meshes))};
    } else if (settings.numerics.horizon == Horizon::superposed) {
        const std::vector<int> periods = part_periods(gearbox);
        const double parts = approach + lockstep::part_meshes(periods, run_in_meshes);
        if (parts < full_meshes) {
            const bool faulty = parts + passage_meshes < full_meshes;
            strategy = Superposed{faulty};
            healthy_meshes = parts;
            integrated_meshes = faulty ? parts + passage_meshes : full_meshes;
            record_bytes = mesh_record_bytes *
                           (1.0 + record.recorded_meshes + lockstep::part_meshes(periods, 0));
        }
    }
}

}  // namespace gearpod::mc
