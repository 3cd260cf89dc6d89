#include "mc/ensemble/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "machine/cancellation.hpp"
#include "mc/ensemble/batch_exchange.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/results/row_source.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {

Results results_frame(const Study& study) {
    Results results;
    for (const ParameterColumn& column : input_columns(study)) {
        results.parameters.push_back({column.name, column.unit, {}});
    }
    results.noise_levels = study.sensor.noise_levels;
    results.request = detection_request(study);
    for (const features::Feature* feature : used_features(study)) {
        results.features.push_back(
            {std::string(feature->name), std::string(feature->unit), feature->alarm, {}});
    }
    for (const AdditionalSensor& sensor : study.sensor.additional) {
        results.variants.push_back({kSensorVariant + sensor.name,
                                    fmt::format("sensor \"{}\", {:g} degrees from the first one",
                                                sensor.name, sensor.angle_deg),
                                    results.features});
    }
    if (has_other_fault(study)) {
        results.variants.push_back(
            {kOtherFault,
             "healthy gearboxes of the threshold sample with " + other_fault_text(study),
             results.features});
    }
    if (teeth_can_separate(study)) {
        for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
            results.contact_loss.push_back({mesh_name(mesh), {}});
        }
    }
    if (study.numerics.horizon == Horizon::superposed) {
        results.integration.push_back({"superposed", {}});
    }
    return results;
}

namespace {

// Prepares this rank for its batches. Returns the reason if preparation was interrupted, else "".
std::string prepare(const std::function<BatchComputers()>& make, const EnsembleRun& run,
                    BatchComputers& computers) {
    try {
        computers = make();
    } catch (const machine::Cancelled&) {
        const std::string reason = run.interruption == nullptr ? "" : run.interruption->reason({});
        return reason.empty() ? "the time limit" : reason;
    }
    return "";
}

}  // namespace

EnsembleOutcome run_batches(const Study& study, const BatchPlan& plan, const EnsembleRun& run,
                            const std::function<BatchComputers()>& make) {
    BatchComputers computers;
    for (const std::string& reason : run.ranks.gather(prepare(make, run, computers))) {
        if (!reason.empty()) {
            EnsembleOutcome outcome;
            outcome.interruption = reason;
            while (run.ranks.leads() && outcome.batches < plan.batches() &&
                   run.store.has(outcome.batches)) {
                ++outcome.batches;
            }
            return outcome;
        }
    }
    const int threads =
        std::max(1, static_cast<int>(std::min<std::size_t>(
                        static_cast<std::size_t>(thread_count(study, run.ranks.on_this_machine())),
                        plan.batches())));
    WorkerTeam team(computers, plan, threads);
    return run.ranks.leads() ? run_leader(team, plan, run) : run_follower(team, run);
}

EnsembleOutcome run_batches(const Scene& scene, const BatchPlan& plan, const EnsembleRun& run) {
    return run_batches(scene.study(), plan, run, [&scene]() -> BatchComputers {
        const auto task = std::make_shared<const BatchTask>(scene);
        return [task]() -> BatchComputer {
            const auto worker = std::make_shared<BatchWorker>(*task);
            return [task, worker](const Batch& batch, Seconds& seconds) {
                return worker->compute(batch, seconds);
            };
        };
    });
}

Results run_ensemble(const Scene& scene, Progress& progress) {
    const Study& study = scene.study();
    const BatchPlan plan(study.ensemble);
    MemoryRows store(plan.batches());
    const Ranks alone;
    const EnsembleOutcome outcome =
        run_batches(scene, plan, {.ranks = alone, .store = store, .progress = progress});
    if (!outcome.failure.empty()) {
        throw std::runtime_error(outcome.failure);
    }
    Results results = results_frame(study);
    fill_columns(results, StoredRows(store, plan, outcome.batches));
    results.timing = timing_of(outcome);
    return results;
}

std::vector<analysis::FeatureDetection> detect_all(const Results& results) {
    return detect_all(results, ColumnRows(results));
}

std::vector<Timing> timing_of(const EnsembleOutcome& outcome) {
    const Seconds work = outcome.work();
    double waiting = 0.0;
    for (const TeamTimes& team : outcome.teams) {
        waiting += team.waiting;
    }
    std::vector<Timing> all{{"sampling_thread_s", work.sampling},
                            {"stiffness_thread_s", work.stiffness},
                            {"integration_thread_s", work.integration},
                            {"signals_thread_s", work.signals},
                            {"noise_thread_s", work.noise},
                            {"features_thread_s", work.features},
                            {"waiting_thread_s", waiting},
                            {"ensemble_s", outcome.wall_s}};
    if (work.superposed + work.superposition_fallbacks > 0) {
        all.push_back({"superposed_records", static_cast<double>(work.superposed), "1"});
        all.push_back({"superposition_fallback_records",
                       static_cast<double>(work.superposition_fallbacks), "1"});
    }
    return all;
}

}  // namespace gearpod::mc
