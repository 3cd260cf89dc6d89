// Checks that the running estimate of a detection rate does not depend on the order of batches.
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/running_pd.hpp"
#include "mc/plan/sampling.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_running_pd {

const std::vector<std::string> kSmall{"ensemble.instances=700", "ensemble.threshold_instances=40",
                                      "sensor.noise_levels=[0, 1]"};

// Healthy gearboxes have 1, test gearboxes 2 in every feature.
BatchRows rows_of(const Study& study, const EnsemblePlan& ensemble, const Batch& batch) {
    const Sampler sampler(DrawPlan{study});
    const RowShape& shape = ensemble.shape;
    BatchRows rows;
    for (std::size_t i = 0; i < batch.rows(); ++i) {
        const Realization drawn = sampler.draw({batch.group, batch.first_index + i});
        ensemble.append_inputs(drawn.random_values, 1.0, rows.values);
        rows.values.push_back(drawn.inputs.fault_size);
        rows.values.resize(rows.values.size() + shape.features * shape.levels,
                           batch.group == Group::threshold ? 1.0 : 2.0);
        rows.status.push_back(0);
    }
    return rows;
}

TEST_CASE("The detection rate is that of the batches read, in any order") {
    const Study study = test::shipped_study("planet-crack-ideal.toml", kSmall);
    const EnsemblePlan ensemble(study);
    const BatchPlan plan(48, 700);
    std::vector<std::size_t> order(plan.batches());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 engine(1);
    for (int trial = 0; trial < 5; ++trial) {
        MemoryRows store(plan.batches());
        RunningPd watch(ensemble, plan, "window_ratio");
        CHECK(watch.text().empty());
        for (const std::size_t batch : order) {
            store.write(batch, rows_of(study, ensemble, plan.batch(batch)));
            watch.advance(store);
        }
        // Seven interleaved sizes: all 100 of the largest one are detected.
        CHECK(watch.text() == "Pd(window_ratio, 4.28 mm, noise x 1) = 1 [0.963, 1]");
        std::shuffle(order.begin(), order.end(), engine);
    }
}

}  // namespace gearpod::mc::test_running_pd
