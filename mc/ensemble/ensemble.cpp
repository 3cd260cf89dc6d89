#include "mc/ensemble/ensemble.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "analysis/detection/feature_alarm.hpp"
#include "machine/stop.hpp"
#include "mc/ensemble/batch_exchange.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/results/row_source.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {

Results results_frame(const Study& study) {
    Results results;
    for (const ParameterColumn& column : Sampler(study).columns()) {
        results.parameters.push_back({column.name, column.unit, {}});
    }
    results.noise_levels = study.sensor.noise_levels;
    results.request = detection_request(study);
    for (const features::Feature* feature : used_features(study)) {
        results.features.push_back({std::string(feature->name),
                                    std::string(feature->unit),
                                    analysis::alarm_of(*feature),
                                    {}});
    }
    return results;
}

namespace {

// Why this rank has left off what all need before the first batch, or "".
std::string prepare(const Scene& scene, const EnsembleRun& run, std::optional<BatchTask>& task) {
    try {
        task.emplace(scene);
    } catch (const machine::Stopped&) {
        const std::string reason = run.interruption == nullptr ? "" : run.interruption->reason({});
        return reason.empty() ? "the time limit" : reason;
    }
    return "";
}

}  // namespace

EnsembleOutcome run_batches(const Scene& scene, const BatchPlan& plan, const EnsembleRun& run) {
    std::optional<BatchTask> task;
    for (const std::string& reason : run.ranks.gather(prepare(scene, run, task))) {
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
    const int threads = std::max(
        1, static_cast<int>(std::min<std::size_t>(
               static_cast<std::size_t>(thread_count(scene.study(), run.ranks.on_this_machine())),
               plan.batches())));
    BatchCrew crew(*task, plan, threads);
    return run.ranks.leads() ? lead(crew, plan, run) : follow(crew, run);
}

Results run_ensemble(const Scene& scene, Progress& progress) {
    const Study& study = scene.study();
    const BatchPlan plan(study.ensemble.threshold_instances, study.ensemble.instances);
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
    Seconds work;
    double waiting = 0.0;
    for (const CrewTimes& crew : outcome.crews) {
        work += crew.work;
        waiting += crew.waiting;
    }
    return {{"sampling_thread_s", work.sampling}, {"stiffness_thread_s", work.stiffness},
            {"march_thread_s", work.march},       {"signals_thread_s", work.signals},
            {"noise_thread_s", work.noise},       {"features_thread_s", work.features},
            {"waiting_thread_s", waiting},        {"ensemble_s", outcome.wall_s}};
}

}  // namespace gearpod::mc
