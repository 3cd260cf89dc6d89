// Checks `describe --ranks`: arithmetic on given measurements, and forecast file sizes against
// files.
#include "mc/lives/campaign.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/report/description/describe.hpp"
#include "mc/results/checkpoint.hpp"
#include "mc/results/results_file.hpp"
#include "tests/mc/lives/campaign_in_memory.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_rank_forecast {

// Equal cost of all gearboxes: a batch of sixteen takes `batch_s`.
RunCost given_cost(int threads, double batch_s) {
    RunCost calibration;
    calibration.threads = threads;
    calibration.lanes = 8;
    for (GroupCost& group : calibration.cost) {
        group.integrated.row.features = group.reused.row.features = batch_s / 16.0;
    }
    return calibration;
}

const Scene& scene() {
    static const Scene shared(test::shipped_study("planet-crack-ideal.toml"));
    return shared;
}

RankForecast forecast_of(const BatchPlan& plan, double batch_s, int threads, int ranks) {
    RunForecast alone;
    alone.setup_s = 2.0;
    alone.detection_s = 3.0;
    return forecast_ranks(given_cost(threads, batch_s), plan, scene().ensemble().shape, alone,
                          ranks);
}

TEST_CASE("Ranks share the batches, and at most as many threads compute as there are batches") {
    const BatchPlan plan(160, 160 * 9);  // a hundred batches
    CHECK(forecast_of(plan, 1.0, 2, 1).gearboxes_s == Approx(50.0));
    CHECK(forecast_of(plan, 1.0, 2, 5).gearboxes_s == Approx(10.0));
    CHECK(forecast_of(plan, 1.0, 2, 5).total_s == Approx(15.0));
    CHECK(forecast_of(plan, 1.0, 2, 5).busy_threads == 10.0);
    const RankForecast many = forecast_of(plan, 1.0, 2, 1000);
    CHECK(many.gearboxes_s == Approx(1.0));
    CHECK(many.busy_threads == 100.0);
}

TEST_CASE("Rank 0 limits the speed where batches arrive faster than it processes them") {
    const BatchPlan plan(16, 16 * 99'999);
    const double batches = 100'000.0;
    const double each_s = leader_time_s(checkpoint_bytes(plan, scene().ensemble().shape) / batches);
    const double batch_s = 0.1;
    const RankForecast some = forecast_of(plan, batch_s, 4, 50);
    CHECK(some.leader_share == Approx(4 * 50 * each_s / batch_s).epsilon(0.01));
    CHECK(some.bounding_ranks == Approx(batch_s / each_s / 4).epsilon(0.01));
    const RankForecast more =
        forecast_of(plan, batch_s, 4, static_cast<int>(2 * some.bounding_ranks));
    CHECK(more.leader_share == 1.0);
    CHECK(more.gearboxes_s == Approx(batches * each_s));
    CHECK(more.batches_per_s == Approx(1.0 / each_s));
}

TEST_CASE("A checkpoint and results have the forecast sizes") {
    const test::Folder folder;
    const BatchPlan plan(40, 1000, {}, 3);
    const RowShape shape{9, 7, 5};
    const std::string path = folder.file("sizes.h5.part");
    {
        const auto checkpoint = Checkpoint::create(path, {"v", "1", "study", shape, ""}, plan);
        for (std::size_t b = 0; b < plan.batches(); ++b) {
            const std::size_t rows = plan.batch(b).rows();
            checkpoint->write(
                b, {std::vector<int>(rows, 0), std::vector<double>(rows * shape.values(), 1.5)});
        }
    }
    // The header, rounded up to a block, is added.
    const auto written = static_cast<double>(std::filesystem::file_size(path));
    CHECK(written - checkpoint_bytes(plan, shape) == Approx(4096.0));
}

// Checks the cost forecast of `describe` for lives.

using namespace test;

TEST_CASE("The forecast of lives counts the records that they will have") {
    const mc::Scene scene(life_study());
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    const mc::LivesForecast forecast = mc::forecast_lives(tiles, 2, 0.0);
    const mc::Campaign campaign = mc::run_campaign(mc::LifeTiles(scene.tile(), scene.life()));
    CHECK(forecast.gearboxes == campaign.costs.gearbox_count);
    CHECK(forecast.records == campaign.costs.record_count);
    CHECK(forecast.gearbox_s > 0.0);
    CHECK(forecast.record_s > 0.0);
    CHECK(forecast.total_s() > 0.0);
    // Eleven rows of three features and five more columns per record, in 40 records.
    CHECK(forecast.file_bytes > 11 * 8 * 40 * 8.0);
    CHECK(forecast.file_bytes < 1.2 * 11 * 8 * 40 * 8.0);
}

TEST_CASE("The forecast for lives grows with their loads, depths and number") {
    const auto of = [](const std::vector<std::string>& more) {
        const mc::Scene scene(life_study(more));
        return mc::forecast_lives(mc::LifeTiles(scene.tile(), scene.life()), 1, 0.0);
    };
    const auto plain = of({}), loads = of({"life.torque_scatter=0.02"}),
               lives = of({"life.healthy_lives=400"});
    CHECK(loads.memory_bytes - loads.file_bytes > plain.memory_bytes - plain.file_bytes);
    CHECK(lives.gearboxes == plain.gearboxes + 396);
    CHECK(lives.records == plain.records + 396 * 40);
    CHECK(lives.file_bytes > 20.0 * plain.file_bytes);
}

}  // namespace gearpod::mc::test_rank_forecast
