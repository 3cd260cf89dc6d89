// Checks length and loads of records against whole spans, many short records, and integration.
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/lives/campaign.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_records {

using namespace test;

// A study without noise, with features that short records have.
mc::Study quiet_study(std::vector<std::string> more) {
    for (const char* one : {"features.use=[\"sensor_rms\",\"window_ratio\"]", "sensor.noise_m_s2=0",
                            "sensor.encoder_noise_arcsec=0"}) {
        more.emplace_back(one);
    }
    return life_study(std::move(more));
}

mc::GearboxLife healthy_life(const mc::Scene& scene) {
    const mc::GearboxId id{mc::Group::test, 0};
    mc::LifeCosts costs;
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    return tiles.run(std::vector{tiles.draw(id)}, false, costs).front();
}

TEST_CASE("A recording of all turns, or of twice as many, equals the whole span") {
    const mc::Scene plain(quiet_study({"life.records=8"}));
    const auto whole = healthy_life(plain);
    // Teeth 31 (planet) and 81 (ring): 31 carrier turns.
    for (const char* turns : {"sensor.record_turns=31", "sensor.record_turns=62"}) {
        const mc::Scene scene(quiet_study({"life.records=8", turns}));
        const auto life = healthy_life(scene);
        for (std::size_t f = 0; f < 2; ++f) {
            CHECK(life.values[f][0] == Approx(whole.values[f][0]).epsilon(1e-9));
        }
    }
    CHECK(contains(plain.life().record, "each of the 31 teeth with all 81 mating teeth"));
}

TEST_CASE("Short recordings cover a part of the turns, and many of them all") {
    const mc::Scene plain(quiet_study({"life.records=8"}));
    const auto whole = healthy_life(plain);
    const auto spread = [&](const std::vector<std::string>& more) {
        const mc::Scene scene(quiet_study(more));
        const auto life = healthy_life(scene);
        const double first = whole.values[0][0];
        return rms_of(mapped(life.values[0], [&](double value) { return value / first - 1.0; }));
    };
    // A duration of 1.2 carrier turns is three planet turns. The path gives each of them a
    // different weight.
    const double few = spread({"life.records=20", "sensor.record_turns=1.2"});
    const double some =
        spread({"life.records=20", "sensor.record_turns=1.2", "life.recordings=16"});
    CHECK(few > 1e-4);
    CHECK(some < 0.6 * few);  // a quarter, within the scatter of 20 records
    const mc::Scene scene(quiet_study({"life.records=8", "sensor.record_turns=4"}));
    CHECK(scene.life().record.find("10 turns of 31 mesh periods") == 0);
    CHECK(contains(scene.life().record, "each of the 31 teeth with 10 of its 81 mating teeth"));
    // Same duration in seconds, at 8.87 rpm.
    const double seconds = 4.0 * 60.0 / 8.87 + 1e-6;
    const mc::Scene timed(
        quiet_study({"life.records=8", "life.record_s=" + std::to_string(seconds)}));
    CHECK(timed.life().record == scene.life().record);
}

TEST_CASE("Noise of a record decreases with the root of its duration") {
    const auto deviation = [](const std::vector<std::string>& more) {
        auto all = more;
        all.emplace_back("features.use=[\"window_z\",\"sensor_rms\"]");
        all.emplace_back("sensor.noise_m_s2=20");
        all.emplace_back("life.records=60");
        const mc::Scene scene(life_study(all));
        const auto values = healthy_life(scene).values[1];
        const std::vector<double> mean(values.size(), mean_of(values));
        return std::sqrt(sum_of_squares(difference(values, mean)) / 59.0);
    };
    const double one = deviation({});
    CHECK(deviation({"life.recordings=16"}) == Approx(0.25 * one).epsilon(0.35));
}

TEST_CASE("A record at another speed is close to an integration at that speed") {
    const mc::Scene scene(quiet_study({"life.speed_scatter=0.001", "life.torque_scatter=0.05"}));
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    const mc::GearboxId id{mc::Group::test, 1};
    mc::LifeCosts costs;
    mc::InterpolationErrors errors;
    const auto life =
        tiles.run(std::vector{tiles.draw(id)}, false, costs, std::span(&errors, 1)).front();
    CHECK(errors.load > 0.0);
    CHECK(errors.load < 0.05);
    const mc::HealthyReference none;
    mc::RealizationFeatures features(scene.tile(), &none);
    double apart = 0.0;
    for (std::size_t r = 0; r < 4; ++r) {
        const mc::LifeRecord& record = life.history.records[r];
        CHECK(record.speed != 1.0);
        apart = std::max(apart, std::abs(record.speed - 1.0));
        mc::Realization gearbox = scene.sampler().draw(id);
        mc::InstanceInputs& inputs = gearbox.inputs;
        inputs.fault_size = 0.0;
        inputs.torque_N_m *= record.torque;
        inputs.speed_rad_s *= record.speed;
        const auto tile = mc::run_realizations(scene.tile(), {gearbox}, 1);
        const auto integrated =
            features.compute(mc::lane_signals(scene.tile(), tile, LaneId{0}, 0), gearbox);
        for (std::size_t f = 0; f < integrated.size(); ++f) {
            CHECK(life.values[f][r] == Approx(integrated[f]).epsilon(5.0 * errors.load));
        }
    }
    CHECK(apart < 0.03);
}

TEST_CASE("More integrated torques and speeds reduce the interpolation error") {
    const auto error = [](int integrated) {
        const std::string count = std::to_string(integrated);
        const mc::Scene scene(
            quiet_study({"life.speed_scatter=0.001", "life.torque_scatter=0.05",
                         "life.integrated_torques=" + count, "life.integrated_speeds=" + count}));
        const mc::LifeTiles tiles(scene.tile(), scene.life());
        CHECK(tiles.load_count() == static_cast<std::size_t>(integrated * integrated));
        const mc::GearboxId id{mc::Group::test, 1};
        mc::LifeCosts costs;
        mc::InterpolationErrors errors;
        tiles.run(std::vector{tiles.draw(id)}, false, costs, std::span(&errors, 1));
        return errors.load;
    };
    const double three = error(3), five = error(5);
    CHECK(three > 0.0);
    CHECK(five < three / 2.0);
}

TEST_CASE("A crack follows the given curve at its gearbox's rate") {
    const std::vector<std::string> curve{"life.curve_h=[0,50,100]", "life.curve_depth_mm=[1,2,4]",
                                         "life.curve_pace=2"};
    std::vector<std::string> all;
    for (const std::string& one : kLife) {
        if (!one.starts_with("life.first_depth") && !one.starts_with("life.paris")) {
            all.push_back(one);
        }
    }
    all.insert(all.end(), curve.begin(), curve.end());
    const mc::Scene scene(shipped_study("planet-crack-ideal.toml", all));
    const mc::Realization gearbox = scene.sampler().draw({mc::Group::test, 0});
    const auto history = mc::CrackLife(scene.life()).history(gearbox, true);
    // Twice the rate: 25 h to 2 mm, 50 h to 4 mm, after six records of 5 h each.
    REQUIRE(history.end_hours);
    CHECK(*history.end_hours == Approx(30.0 + 50.0));
    REQUIRE(history.records.size() == 16);
    CHECK(history.records[5].depth_m == 0.0);
    CHECK(history.records[6].depth_m == Approx(1e-3));
    CHECK(history.records[11].depth_m == Approx(2e-3));
    CHECK(history.records[13].depth_m == Approx(2.8e-3));
}

TEST_CASE("Invalid records and curves are refused with the key") {
    const auto refused = [&](const std::string& more) {
        return check_refused("lives " + study("planet-crack-ideal.toml") + life_arguments() +
                             " --set 'features.use=[\"sensor_rms\"]' --quiet " + more);
    };
    CHECK(refused("--set sensor.record_turns=1").mentions("windows repeat every 31"));
    CHECK(refused("--set 'features.use=[\"te_rms\"]' --set life.record_s=60")
              .mentions("recordings have another length"));
    CHECK(refused("--set 'life.curve_h=[0,1]' --set 'life.curve_depth_mm=[1,4]'")
              .mentions("life.first_depth_mm"));
    CHECK(refused("--set 'life.curve_depth_mm=[1,4]'").mentions("only with life.curve_h"));
    CHECK(refused("--set life.integrated_speeds=3").mentions("all records have the same speed"));
    CHECK(refused("--set life.integrated_torques=2 --set life.torque_scatter=0.1")
              .mentions("life.integrated_torques: must be between 3 and 17"));
    CHECK(refused("--set monitoring.baseline_records=2").mentions("use at least 3, or 0"));
    CHECK(refused("--set monitoring.baseline_records=3 --set monitoring.torque_regression=true")
              .mentions("about a line in the torque"));
    CHECK(refused("--set monitoring.false_alarms_per_1000_h=200")
              .mentions("one alarm or more in every record"));
}

TEST_CASE("describe states which inputs vary per gearbox and which per record") {
    check_mentions(require_success("describe " + study("planet-life.toml")),
                   {"random per gearbox", "torque per record",
                    "3 values occur, equally often, and each is integrated", "speed per record"});
    // Random depth from [random] applies to `run`: in a life the crack grows.
    const Outcome drawn = require_success(
        "describe " + study("planet-life.toml") +
        " --set 'random.fault.depth_mm={distribution=\"uniform\",low=1,high=3}' --set "
        "'detection.size_edges_mm=[1,2,3]'");
    CHECK(drawn.mentions("fault.depth_mm in [random] is ignored"));
    CHECK(!drawn.mentions(", fault.depth_mm,"));
}

}  // namespace gearpod::test_records
