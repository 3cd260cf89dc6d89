// Checks the cost forecast of `describe` for lives.
#include "mc/lives/campaign.hpp"
#include "mc/report/description/describe.hpp"
#include "mc/results/results_file.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/test.hpp"

namespace gearpod::test_lives_forecast {

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

}  // namespace gearpod::test_lives_forecast
