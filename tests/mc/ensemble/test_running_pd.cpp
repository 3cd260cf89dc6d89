// Checks ensemble.until against the closed form of the Wilson interval where every gearbox is
// detected.
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/running_pd.hpp"
#include "mc/plan/sampling.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_running_pd {

const std::vector<std::string> kUntil{
    "ensemble.instances=700", "ensemble.threshold_instances=40", "sensor.noise_levels=[0, 1]",
    R"(ensemble.until={half_width=0.1, feature="window_ratio", size=4.28})"};

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

TEST_CASE("The run may stop at the gearbox that the Wilson interval requires, in any order") {
    const Study study = test::shipped_study("planet-crack-ideal.toml", kUntil);
    const EnsemblePlan ensemble(study);
    const BatchPlan plan(48, 700);
    // All of n are detected: half the interval is z^2 / (2 (n + z^2)), so n >= z^2 (1 / (2 w) - 1).
    const double z2 = 1.959963984540054 * 1.959963984540054;
    const auto needed = static_cast<std::size_t>(std::ceil(z2 * (1.0 / 0.2 - 1.0)));
    REQUIRE(needed == 16);
    // Seven interleaved sizes, the largest last: its n-th gearbox is test gearbox 7 n - 1.
    const std::size_t batches = 3 + (7 * needed - 1) / kBatchRows + 1;

    std::vector<std::size_t> order(plan.batches());
    for (std::size_t batch = 0; batch < order.size(); ++batch) {
        order[batch] = batch;
    }
    std::mt19937 engine(1);
    for (int trial = 0; trial < 5; ++trial) {
        MemoryRows store(plan.batches());
        RunningPd watch(ensemble, plan, "");
        for (const std::size_t batch : order) {
            store.write(batch, rows_of(study, ensemble, plan.batch(batch)));
            watch.advance(store);
        }
        REQUIRE(watch.done());
        CHECK(watch.batches() == batches);
        CHECK(watch.text().starts_with("Pd(window_ratio, 4.28 mm, noise x 1) = 1 ["));
        std::shuffle(order.begin(), order.end(), engine);
    }
}

TEST_CASE(
    "The number of gearboxes until the requested interval is predicted from the rate so far") {
    const Study study = test::shipped_study("planet-crack-ideal.toml", kUntil);
    const EnsemblePlan ensemble(study);
    const BatchPlan plan(48, 700);
    MemoryRows store(plan.batches());
    RunningPd watch(ensemble, plan, "");
    CHECK_FALSE(watch.rows_left().has_value());
    CHECK(watch.text().empty());
    // The threshold group and 64 test gearboxes: nine of the largest size, 16 required.
    for (std::size_t batch = 0; batch < 7; ++batch) {
        store.write(batch, rows_of(study, ensemble, plan.batch(batch)));
    }
    watch.advance(store);
    CHECK_FALSE(watch.done());
    REQUIRE(watch.rows_left().has_value());
    CHECK(*watch.rows_left() == 64 * 16 / 9 - 64);
}

}  // namespace gearpod::mc::test_running_pd
