#include "mc/ensemble/miss_rate.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "mc/ensemble/ensemble.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

// MissRecords of several gearboxes, in the form that ImportanceSample takes.
struct MissRecords {
    std::vector<double> values, weights;
    std::vector<std::size_t> gearbox;
    long gearboxes = 0, failed = 0;

    void add(const BatchRows& rows, const RowShape& shape, std::size_t records) {
        for (std::size_t row = 0; row < rows.count(); ++row) {
            const double* values_of = rows.values.data() + row * shape.values();
            if (row % records == 0) {
                ++gearboxes;
                failed += rows.status[row] == static_cast<int>(Status::ok) ? 0 : 1;
            }
            values.push_back(values_of[shape.value_of(0, 0)]);
            weights.push_back(values_of[shape.noise_weight()]);
            gearbox.push_back(static_cast<std::size_t>(gearboxes));
        }
    }
};

}  // namespace

Study of_feature(const Study& study, const std::string& feature, double noise_level) {
    Study own = study;
    own.features.use = {feature};
    own.sensor.noise_levels = {noise_level};
    own.ensemble.until = {};
    return own;
}

Study with_fault(const Study& study, double size) {
    Study own = study;
    const std::string key = fault_size_key(study).path();
    std::erase_if(own.random, [&](const RandomInput& input) { return input.key == key; });
    std::erase_if(own.correlations,
                  [&](const Correlation& pair) { return pair.first == key || pair.second == key; });
    set_fault_size(own, size);
    own.detection.size_edges_m.clear();
    own.detection.size_edges.clear();
    return own;
}

Study study_for_miss_rate(const Study& study, const MissRateRequest& request) {
    Study own = with_fault(of_feature(study, request.feature, request.noise_level), request.size);
    own.ensemble.instances = request.gearboxes;
    own.ensemble.threshold_records = request.records;
    own.ensemble.importance_sampling = true;
    return own;
}

std::string failure_reason(const EnsembleOutcome& outcome) {
    return outcome.failure.empty() && !outcome.interruption.empty()
               ? "stopped by " + outcome.interruption
               : outcome.failure;
}

double equivalent_sample_size(double rate, double variance) {
    return rate < 1.0 ? (1.0 - rate) / (rate * variance) : analysis::kNan;
}

MissRateResult estimate_miss_rate(const Scene& scene, const MissRateRequest& request,
                                  const Ranks& ranks, Progress& progress,
                                  const Interruption* interruption) {
    const auto records = static_cast<std::size_t>(request.records);
    const BatchPlan plan(0, request.gearboxes);
    MemoryRows store(ranks.leads() ? plan.batches() : 0);
    const EnsembleOutcome outcome = run_batches(
        scene.study(), plan,
        {.ranks = ranks, .store = store, .progress = progress, .interruption = interruption},
        [&]() -> BatchComputers {
            const auto task = std::make_shared<BatchTask>(scene);
            task->graded_noise = NoiseSampling::towards_misses;
            return [task, records]() -> BatchComputer {
                const auto worker = std::make_shared<BatchWorker>(*task);
                return [task, worker, records](Batch batch, Seconds& seconds) {
                    batch.records = records;
                    return worker->compute(batch, seconds);
                };
            };
        });
    MissRateResult result;
    if (!ranks.leads()) {
        return result;
    }
    if (const std::string why = failure_reason(outcome); !why.empty()) {
        throw std::runtime_error(why);
    }
    const RowShape shape = row_shape(scene.study());
    MissRecords all;
    for (std::size_t batch = 0; batch < plan.batches(); ++batch) {
        all.add(store.read(batch), shape, records);
    }
    const analysis::ImportanceSample sample(
        all.values, all.weights, all.gearbox,
        analysis::opposite(features::find_feature(request.feature)->alarm));
    result.misses = sample.at(request.threshold, scene.study().detection.confidence);
    result.gearboxes = all.gearboxes;
    result.failed = all.failed;
    result.records = static_cast<long>(all.values.size());
    result.counted = result.misses
                         ? equivalent_sample_size(result.misses->expected, result.misses->variance)
                         : analysis::kNan;
    return result;
}

}  // namespace gearpod::mc
