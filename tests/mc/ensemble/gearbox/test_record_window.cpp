// Checks records of given length against whole spans, a record cut here from simulated samples, and
// the probability of their tooth positions.
#include <fmt/format.h>

#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "tests/mc/ensemble/gearbox/computed.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::mc::test_record_window {

using namespace test;

const std::string kPlain = "features.use=[\"sensor_rms\",\"window_ratio\",\"te_rms\"]";
const std::string kCompared =
    "features.use=[\"sensor_rms\",\"own_sensor_rms\",\"change_sensor_rms\",\"te_rms\"]";

TEST_CASE("A record of all turns has the features of the whole span, wherever it begins") {
    const std::string quiet = "sensor.noise_levels=[0]";
    const Computed whole(ideal_crack_study({kPlain, quiet}));
    // Liang's gearbox has 31 planet and 81 ring teeth: 31 carrier turns.
    const Computed record(ideal_crack_study({kPlain, quiet, "sensor.record_turns=31"}));
    CHECK(record.window().turns == 81);
    for (const std::size_t feature : {0, 1, 2}) {
        CHECK(record.value(feature) == Approx(whole.value(feature)).epsilon(1e-9));
    }
}

TEST_CASE("The features of a short record are those of its samples") {
    const Computed record(
        ideal_crack_study({kPlain, "sensor.noise_levels=[0]", "sensor.record_turns=4"}));
    const RecordWindow window = record.window();
    CHECK(window.turns == 4 * 81 / 31);
    const auto samples = static_cast<std::size_t>(record.scene().record().samples);
    const LaneSignals signals = record.signals();
    const auto own = std::span(signals.sensor)
                         .subspan(static_cast<std::size_t>(window.first_mesh) * samples,
                                  static_cast<std::size_t>(window.turns * 31) * samples);
    CHECK(record.value(0) == Approx(rms(own)).epsilon(1e-12));
    // Mean over the record's turns of every sample of a turn, without its mean.
    const auto te_samples = static_cast<std::size_t>(record.scene().record().te_samples);
    std::vector<double> turn(31 * te_samples);
    for (std::size_t i = 0; i < turn.size() * static_cast<std::size_t>(window.turns); ++i) {
        turn[i % turn.size()] +=
            signals.te[static_cast<std::size_t>(window.first_mesh) * te_samples + i] / window.turns;
    }
    const std::vector<double> mean(turn.size(), mean_of(turn));
    CHECK(record.value(2) == Approx(rms_of(difference(turn, mean))).epsilon(1e-9));
}

TEST_CASE("Noise of a short record has its own number of samples") {
    const Computed record(
        ideal_crack_study({kCompared, "sensor.noise_levels=[100]", "sensor.record_turns=4"}));
    const double noise = 100.0 * record.noise_m_s2();
    const double samples = 10.0 * 31.0 * record.scene().record().samples;
    CHECK(record.value(0) == Approx(noise).epsilon(4.0 / std::sqrt(2.0 * samples)));
    CHECK(record.value(2) ==
          Approx(std::sqrt(2.0) * noise).epsilon(4.0 / std::sqrt(2.0 * samples)));
}

TEST_CASE(
    "Without noise and at the same torque the change is zero, although records begin anywhere") {
    const GearboxId healthy{Group::threshold, 4};
    const Computed own(
        ideal_crack_study({kCompared, "sensor.noise_levels=[0]", "sensor.record_turns=4"}),
        {healthy});
    CHECK(own.value(2) == 0.0);
    // The baseline record begins at another tooth, where the path weights other turns.
    CHECK(own.value(1) != 1.0);
    CHECK(own.value(1) == Approx(1.0).epsilon(0.1));
}

TEST_CASE(
    "Records begin at every mesh period with the same probability, whatever was drawn before") {
    const Scene scene(ideal_crack_study({kPlain, "sensor.record_turns=4"}));
    constexpr int kRecords = 8000, kBins = 8;
    std::vector<int> count(kBins);
    std::set<int> distinct;
    for (std::uint64_t i = 0; i < kRecords; ++i) {
        const RecordWindow window = record_window(scene.record(), {Group::test, i}, 10);
        REQUIRE(window.first_mesh >= 0);
        REQUIRE(window.first_mesh <= scene.record().span.meshes());
        distinct.insert(window.first_mesh);
        ++count[static_cast<std::size_t>(window.first_mesh) * kBins /
                static_cast<std::size_t>(scene.record().span.meshes() + 1)];
    }
    double chi_squared = 0.0;
    for (const int one : count) {
        chi_squared += std::pow(one - kRecords / kBins, 2) / (1.0 * kRecords / kBins);
    }
    CHECK(chi_squared < 24.3);  // 7 degrees of freedom, p = 0.001
    CHECK(distinct.size() > 2000);
    // Each record of a gearbox has its own start.
    const auto first = [&](GearboxId id) {
        return record_window(scene.record(), id, 10).first_mesh;
    };
    CHECK(first({Group::test, 1}) != first({Group::test, 1, Record::baseline}));
    CHECK(first({Group::threshold, 1}) != first({Group::threshold, 1, Record::test, 1}));
}

// Gearboxes whose teeth have errors: every mesh period has to be integrated.
Study real_teeth(const std::vector<std::string>& overrides) {
    return test::shipped_study(
        "planet-crack.toml",
        test::joined({kCompared, "sensor.noise_levels=[0.001]", "sensor.record_turns=1.2",
                      "features.baseline_records=2", "features.baseline_torque_scatter=0.02",
                      "numerics.precision=\"double\"", "numerics.settle_tolerance=1e-6",
                      "random.fault.depth_mm={distribution=\"constant\",value=3}"},
                     overrides));
}

// Features of the records of a gearbox, and the mesh periods that are integrated for them. `whole`:
// all of the signal is integrated.
struct Records {
    std::vector<std::vector<double>> values;  // [repeat]
    int meshes = 0;
};
Records records_of(const Study& study, const GearboxId& id, std::size_t repeats, bool whole) {
    const Scene scene(study);
    TilePlan plan = scene.tile();
    REQUIRE(std::get<EveryMeshPeriod>(plan.solve->strategy).records_only);
    if (whole) {
        auto solve = std::make_shared<SolvePlan>(*plan.solve);
        solve->strategy = EveryMeshPeriod{};
        plan.solve = solve;
    }
    const HealthyReference healthy;
    RealizationFeatures features(plan, &healthy);
    const GearboxTile tile = run_gearboxes(plan, std::span(&id, 1), 1, {.repeats = repeats});
    REQUIRE(tile.status[0] == Status::ok);
    const LaneSignals signals = lane_signals(plan, tile, LaneId{0}, plan.record.signal_meshes);
    Records records{{}, tile.meshes};
    Realization record = tile.realizations[0];
    for (record.id.repeat = 0; record.id.repeat < repeats; ++record.id.repeat) {
        records.values.push_back(features.compute(signals, record));
    }
    return records;
}

TEST_CASE("Records that are integrated alone are those of the whole signal") {
    // One record, several of a healthy gearbox with their baselines, and one at random speed.
    const auto [id, repeats, key, share] = GENERATE(
        std::tuple{GearboxId{Group::test, 16}, 1, "ensemble.threshold_records=1", 0.25},
        std::tuple{GearboxId{Group::threshold, 3}, 3, "ensemble.threshold_records=3", 0.9},
        std::tuple{GearboxId{Group::test, 5}, 1,
                   "random.operation.carrier_speed_rpm={distribution=\"uniform\",low=8,high=9}",
                   0.25});
    INFO(key);
    const auto count = static_cast<std::size_t>(repeats);
    const Records alone = records_of(real_teeth({key}), id, count, false),
                  whole = records_of(real_teeth({key}), id, count, true);
    for (std::size_t repeat = 0; repeat < count; ++repeat) {
        for (const std::size_t feature : {0, 1, 2, 3}) {
            INFO(repeat << " " << feature);
            CHECK(alone.values[repeat][feature] ==
                  Approx(whole.values[repeat][feature]).epsilon(1e-4));
        }
    }
    CHECK((count == 1 || alone.values[0] != alone.values[1]));
    CHECK(alone.meshes < share * whole.meshes);
}

TEST_CASE("Short records show single teeth of ring and sun as the whole signal does") {
    // 18/21/60 teeth: the ring needs 60 mesh periods, the sun 180, and all teeth have met after
    // 1260.
    const auto [turns, names] =
        GENERATE(std::tuple{3, "\"ring_window_ratio\",\"ring_window_kurtosis\""},
                 std::tuple{9, "\"ring_window_ratio\",\"sun_window_ratio\",\"sun_window_m8a\""});
    const Study study = test::shipped_study(
        "planet-crack.toml",
        {"gearbox.planets=3", "gearbox.sun.teeth=18", "gearbox.planet.teeth=21",
         "gearbox.ring.teeth=60", "gearbox.sun.bore_mm=20", "gearbox.planet.bore_mm=30",
         "gearbox.ring.outer_mm=240", "numerics.precision=\"double\"",
         "numerics.settle_tolerance=1e-11", "sensor.noise_levels=[0.001]",
         fmt::format("sensor.record_turns={}", turns * 21.0 / 60.0 + 0.01),
         fmt::format("features.use=[{},\"own_sensor_rms\"]", names)});
    const GearboxId id{Group::test, 16};
    const Records alone = records_of(study, id, 1, false), whole = records_of(study, id, 1, true);
    for (std::size_t feature = 0; feature < alone.values[0].size(); ++feature) {
        INFO(feature);
        CHECK(alone.values[0][feature] == Approx(whole.values[0][feature]).epsilon(1e-9));
    }
    CHECK(alone.meshes < 0.6 * whole.meshes);
    const FeaturePlan features = make_feature_plan(study, {21, 60, 60});
    CHECK(features.central_turns(Member::ring, 63).turns == 1);
    CHECK(features.central_turns(Member::sun, 63).turns == 0);
    CHECK(features.central_turns(Member::sun, 189).turns == 10);
    CHECK(features.central_turns(Member::sun, 1449).turns == 70);  // no more than those of the span
}

TEST_CASE("Features of single teeth need a common multiple of their gear and the carrier turn") {
    const Study study = test::shipped_study("wind-turbine-helical.toml");  // 21/39/99 teeth
    const FeaturePlan features = make_feature_plan(study, {39, 99, 99});
    const auto least = [&](const char* name) {
        return features.least_meshes(*find_feature(study, name));
    };
    CHECK(least("ring_window_ratio") == 99);
    CHECK(least("sun_window_ratio") == 693);
    CHECK(least("frms") == 198);
    CHECK(least("window_ratio") == 39);
    RecordPlan record;
    record.span = features.span;
    record.mesh_frequency_Hz = 23.1;
    record.length = RecordLength{"sensor", 10.0, {}};
    const std::string ten_seconds = shown_teeth_text(record, features);
    CHECK(contains(ten_seconds, "ring teeth (from 99 mesh periods, 4.29 s); too short for"));
    CHECK(contains(ten_seconds, "sun teeth (from 693 mesh periods, 30 s)"));
}

TEST_CASE("Gearboxes that are computed together have the window of the first one") {
    const Computed alone(real_teeth({}), {{Group::test, 16}});
    // Others have the window of the first one, whatever tile computes them.
    const Computed other(real_teeth({}), {{Group::test, 19}});
    CHECK(other.window().first_mesh == alone.window().first_mesh);
    const auto ids = tabulated(8, [](int lane) {
        return GearboxId{Group::test, std::uint64_t(16 + lane)};
    });
    const GearboxTile tile = run_gearboxes(other.scene().tile(), ids, 8);
    const HealthyReference healthy;
    RealizationFeatures features(other.scene().tile(), &healthy);
    const std::vector<double> values = features.compute(
        lane_signals(other.scene().tile(), tile, LaneId{3}, other.scene().record().signal_meshes),
        tile.realizations[3]);
    for (const std::size_t feature : {0, 1, 2, 3}) {
        CHECK(values[feature] == other.value(feature));
    }
    const Simulation simulation = simulate(other.scene().tile(), {Group::test, 19}, 93);
    CHECK(simulation.features == values);
}

TEST_CASE("Parts of a baseline record include the windows of the test record and of its copies") {
    const Scene scene(real_teeth({"features.baseline_torque_scatter=0"}));
    const Realization one = scene.sampler().draw({Group::threshold, 3, Record::baseline});
    const auto parts = parts_of_records(scene.record(), scene.features(), std::span(&one, 1));
    const auto within = [&](const GearboxId& id) {
        const int first = record_window(scene.record(), id, 3).first_mesh;
        return std::ranges::any_of(parts, [&](const lockstep::SpanPart& part) {
            return part.first <= first && first + 93 <= part.end;
        });
    };
    for (const std::size_t k : {0, 1}) {
        GearboxId id = one.id;
        id.baseline = k;
        CHECK(within(id));
    }
    CHECK(within({Group::threshold, 0}));
    CHECK(parts.size() <= 3);
    // Studies whose records need other parts of the signal integrate all of it.
    CHECK(Scene(real_teeth({"operation.speed_noise=0.01", "operation.speed_noise_band_Hz=3",
                            "numerics.integrator=rk4"}))
              .record()
              .same_window == 1);
}

TEST_CASE("The length of records changes no other random input, and no results without it") {
    const Study whole = ideal_crack_study({kPlain}),
                cut = ideal_crack_study({kPlain, "sensor.record_turns=4"});
    for (std::uint64_t i = 0; i < 5; ++i) {
        const GearboxId id{Group::test, i};
        CHECK(Sampler(DrawPlan{whole}).draw(id).random_values ==
              Sampler(DrawPlan{cut}).draw(id).random_values);
    }
    CHECK_FALSE(contains(resolved_text(whole), "record_"));
    CHECK(contains(resolved_text(cut), "record_turns = 4"));
}

TEST_CASE("A faster gearbox records more turns in the same time") {
    const Study study = ideal_crack_study({kPlain, "sensor.record_s=20"});
    const Scene scene(study);
    InstanceInputs inputs = nominal_inputs(study);
    const int nominal = scene.record().turns(inputs);
    // Mesh frequency: 81 teeth times 8.87 rpm of the carrier.
    CHECK(nominal == static_cast<int>(20.0 * 81.0 * 8.87 / 60.0 / 31.0));
    inputs.speed_rad_s *= 2.0;
    CHECK(scene.record().turns(inputs) == static_cast<int>(20.0 * 81.0 * 2.0 * 8.87 / 60.0 / 31.0));
    inputs.speed_rad_s *= 0.01;
    CHECK(scene.record().turns(inputs) == 3);
}

TEST_CASE("Integrated and periodic gearboxes have the same short records") {
    const std::vector<std::string> keys{kPlain, "sensor.noise_levels=[0]",
                                        "sensor.record_turns=1.2"};
    const Computed periodic(ideal_crack_study(keys)),
        integrated(ideal_crack_study(test::joined(keys, {"numerics.horizon=\"full\""})));
    for (const std::size_t feature : {0, 1, 2}) {
        CHECK(integrated.value(feature) == Approx(periodic.value(feature)).epsilon(1e-5));
    }
}

TEST_CASE("simulate shows the samples of the record, from its first mesh period") {
    const Study study =
        ideal_crack_study({kPlain, "sensor.noise_levels=[0]", "sensor.record_turns=4"});
    const Computed record(study);
    const Scene scene(study);
    const long meshes = 10 * 31;
    const Simulation simulation = simulate(scene.tile(), {Group::test, 4}, meshes);
    const auto column = [&](const std::string& name) {
        return std::ranges::find(simulation.columns, name, &SignalColumn::name)->values;
    };
    CHECK(column("mesh_phase").front() == record.window().first_mesh);
    CHECK(column("time").front() == 0.0);
    CHECK(simulation.features[0] == record.value(0));
    CHECK(rms(column("sensor")) == Approx(record.value(0)).epsilon(1e-12));
}

TEST_CASE("Lengths of records that make no sense are refused, and reports state them") {
    const auto refused = [](const std::string& more) {
        return test::program("describe " + test::study("planet-crack-ideal.toml") + more);
    };
    CHECK(refused(" --set sensor.record_turns=1").mentions("windows repeat every 31"));
    CHECK(refused(" --set sensor.record_s=60 --set sensor.record_turns=9")
              .mentions("conflicts with record_s"));
    CHECK(
        refused(" --set sensor.record_turns=4 --set 'features.use=[\"sun_window_ratio\"]'").code ==
        2);
    const RecordFacts facts = record_facts(ideal_crack_study({"sensor.record_turns=4"}));
    CHECK(contains(facts.conditions, "begins at a random tooth position"));
    CHECK(contains(facts.conditions, "10 of the 81 ring teeth that it can meet (12 %)"));
    CHECK(contains(facts.longer, "these have 10 turns of the planet in 25.9 s"));
    CHECK(contains(facts.longer, "without sensor.record_turns 81 turns in 210 s"));
    const RecordFacts whole = record_facts(ideal_crack_study({}));
    CHECK(contains(whole.conditions, "81 of the 81 ring teeth"));
    CHECK(whole.longer.empty());
}

}  // namespace gearpod::mc::test_record_window
