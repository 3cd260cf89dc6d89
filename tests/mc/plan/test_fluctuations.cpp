// Checks fluctuating torque and speed, and gravity, from the study file to the signals.
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/study/fluctuations.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_fluctuations {

using namespace tests;
using std::numbers::pi;

GearboxTile run(const Scene& scene, std::vector<GearboxId> ids, int lanes) {
    return run_gearboxes(scene.tile(), ids, lanes, {.records = lockstep::RecordOptions{}});
}

std::vector<std::uint64_t> bits(const machine::AlignedVector& values, int lanes, int lane) {
    std::vector<std::uint64_t> all;
    for (std::size_t i = static_cast<std::size_t>(lane); i < values.size();
         i += static_cast<std::size_t>(lanes)) {
        all.push_back(std::bit_cast<std::uint64_t>(values[i]));
    }
    return all;
}

struct BadStudy {
    const std::string& study;
    std::vector<std::string> overrides;
    const char* key;
    const char* words;
};

const BadStudy kBad[] = {
    {kExampleStudy, {"operation.torque_noise=0.1"}, "operation.torque_noise_band_Hz", "missing"},
    {kExampleStudy,
     {"operation.speed_fluctuation=0.1"},
     "operation.speed_fluctuation_order",
     "missing"},
    {kExampleStudy,
     {"operation.speed_fluctuation=0.5", "operation.speed_fluctuation_order=1"},
     "operation.speed_fluctuation",
     "must be"},
    {kExampleStudy, {"operation.speed_noise=0.01"}, "operation.speed_noise_band_Hz", "missing"},
    {kExampleStudy,
     {"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=3",
      "numerics.horizon=periodic"},
     "numerics.horizon",
     "is \"periodic\", but the torque fluctuates"},
    {kExampleStudy,
     {"gearbox.pitch_error_um=1", "operation.torque_noise=0.1", "operation.torque_noise_band_Hz=3",
      "numerics.horizon=superposed"},
     "numerics.horizon",
     "is \"superposed\", but torque, speed or weight varies"},
    {kExampleStudy,
     {"numerics.horizon=superposed"},
     "numerics.horizon",
     "is \"superposed\", but the teeth have no individual errors"},
    {kExampleStudy,
     {"effects.gravity=true", "numerics.horizon=periodic"},
     "numerics.horizon",
     "gravity rotates relative to the carrier"},
    {kExampleStudy,
     {"effects.gravity=true", "effects.motion=torsional"},
     "effects.gravity",
     "would have no effect"},
    {kExampleStudy,
     {"effects.gravity_direction_deg=0"},
     "effects.gravity_direction_deg",
     "was removed; remove it: gravity acts along -y"},
    {kExampleStudy,
     {"operation.torque_fluctuation_order=1"},
     "operation.torque_fluctuation_order",
     "was removed; give torque_noise"},
    {kQuasiStaticStudy,
     {"operation.speed_noise=0.01"},
     "operation.speed_noise",
     "a quasi-static gearbox is not integrated in time"},
};

struct BadScene {
    std::vector<std::string> overrides;
    const char* key;
    const char* words;
};

const BadScene kBadScenes[] = {
    {{"effects.gravity=true", "numerics.integrator=newmark"},
     "numerics.integrator",
     "gravity is supported by rk4, sdirk3 and central-difference, not by newmark"},
    {{"effects.gravity=true", "numerics.precision=single"},
     "numerics.precision",
     "gravity needs double precision"},
    {{"operation.speed_fluctuation=0.1", "operation.speed_fluctuation_order=1",
      "numerics.integrator=sdirk3"},
     "numerics.integrator",
     "a fluctuating speed is supported by rk4"},
    {{"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=100000"},
     "numerics.steps_per_mesh",
     "too few for the fastest fluctuation"},
};

TEST_CASE("Invalid fluctuations and a weight without effect are refused with key and remedy") {
    for (const BadStudy& bad : kBad) {
        const StudyReading reading = read_study_text(bad.study, "example", bad.overrides);
        CAPTURE(bad.key, bad.words);
        REQUIRE(reading.problems.size() >= 1);
        bool found = false;
        for (const Problem& problem : reading.problems) {
            found = found ||
                    (problem.key == bad.key &&
                     (problem.what + "; " + problem.remedy).find(bad.words) != std::string::npos);
        }
        CHECK(found);
    }
    CHECK_THROWS_WITH(
        Scene(test::study_of_text(kQuasiStaticStudy, {"operation.torque_noise=0.1",
                                                      "operation.torque_noise_band_Hz=1e7"})),
        Catch::Contains("too few for the fastest fluctuation"));
    for (const BadScene& bad : kBadScenes) {
        test::check_scene_refused(
            test::study_of_text(kExampleStudy, test::joined(kFast, bad.overrides)), bad.key,
            {bad.words});
    }
}

TEST_CASE("Every mesh is integrated where none repeats, and only there") {
    const auto horizon = [](const std::vector<std::string>& overrides) {
        return test::study_of_text(kExampleStudy, overrides).numerics.horizon;
    };
    CHECK(horizon({"effects.gravity=true"}) == Horizon::full);
    CHECK(horizon({"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=3"}) ==
          Horizon::full);
    // An amplitude of 0 is no fluctuation.
    CHECK(horizon({"operation.torque_noise=0", "operation.torque_noise_band_Hz=3"}) ==
          Horizon::periodic);
    // The weight is as constant as the torque where the carrier is fixed.
    std::string standing = kExampleStudy;
    const std::string speed = "carrier_speed_rpm = 8.87";
    standing.replace(standing.find(speed), speed.size(), "fixed = \"carrier\"\nsun_speed_rpm = 50");
    CHECK(test::study_of_text(standing, {"effects.gravity=true"}).numerics.horizon ==
          Horizon::periodic);
}

TEST_CASE("Without inertia the transmission error follows the torque from mesh to mesh") {
    const auto te_of = [](const std::string& noise) {
        const Scene scene(test::study_of_text(
            kQuasiStaticStudy,
            {"numerics.horizon=full", noise, "operation.torque_noise_band_Hz=0.1"}));
        const GearboxTile tile = run(scene, {{Group::test, 0}}, 1);
        REQUIRE(tile.integration.content.size() ==
                static_cast<std::size_t>(scene.record().signal_meshes));
        std::vector<double> te;
        for (const std::size_t mesh : {0U, 1U, 30U, 500U}) {
            const auto& part =
                tile.integration.records[static_cast<std::size_t>(tile.integration.content[mesh])]
                    .te;
            te.insert(te.end(), part.begin(), part.end());
        }
        return te;
    };
    const auto steady = te_of("operation.torque_noise=0"),
               some = te_of("operation.torque_noise=0.1"),
               twice = te_of("operation.torque_noise=0.2");
    double worst = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < steady.size(); ++i) {
        const double x = some[i] / steady[i] - 1.0;
        largest = std::max(largest, std::abs(x));
        worst = std::max(worst, std::abs(twice[i] / steady[i] - 1.0 - 2.0 * x));
    }
    CHECK(largest > 1e-3);
    CHECK(largest < 0.5);
    CHECK(worst < 1e-9);
}

TEST_CASE("Simulated samples lie at the times of their phases") {
    // One sun turn takes 15.39 meshes. The speed varies once per mesh period, which then takes T
    // times the mean of 1 / (1 + A sin), 1 / sqrt(1 - A^2).
    const Study study = test::study_of_text(
        kExampleStudy, test::joined(kFast, {"operation.speed_fluctuation=0.2",
                                            "operation.speed_fluctuation_order=15.39",
                                            "features.use=[\"te_rms\"]", "fault.kind=none"}));
    const Scene scene(study);
    const Simulation out = simulate(scene.tile(), {Group::test, 0}, 12);
    const auto samples = static_cast<std::size_t>(scene.record().samples);
    REQUIRE(out.columns[0].name == "time");
    const double period = 1.0 / scene.gearbox().mesh_frequency_Hz;
    for (const std::size_t mesh : {1U, 5U, 11U}) {
        CHECK(out.columns[0].values[mesh * samples] ==
              Approx(static_cast<double>(mesh) * period / std::sqrt(1.0 - 0.04)).epsilon(1e-9));
    }
    // The speed is highest a quarter of the mesh period after its beginning.
    const auto& time = out.columns[0].values;
    CHECK(time[samples / 4 + 1] - time[samples / 4] ==
          Approx(period / static_cast<double>(samples) / 1.2).epsilon(0.02));
}

TEST_CASE("Fluctuations and weight give the same bits in 1, 4 and 8 lanes, with any neighbours") {
    const Study study = test::study_of_text(
        kExampleStudy,
        test::joined(kFast, {"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=20",
                             "operation.speed_noise=0.01", "operation.speed_noise_band_Hz=10",
                             "effects.gravity=true", "features.use=[\"te_rms\"]",
                             "effects.separation=one-sided"}));
    const Scene scene(study);
    std::vector<GearboxId> ids = test::tabulated(8, [&](std::uint64_t i) {
        return GearboxId{Group::test, i};
    });
    const GearboxTile eight = run(scene, ids, 8);
    const GearboxTile four = run(scene, {ids[5], ids[2], ids[7]}, 4);
    const GearboxTile one = run(scene, {ids[2]}, 1);
    CHECK(eight.status[2] == Status::ok);
    CHECK(bits(eight.folded[0], 8, 2) == bits(one.folded[0], 1, 0));
    CHECK(bits(eight.te_turn, 8, 2) == bits(one.te_turn, 1, 0));
    CHECK(bits(four.te_turn, 4, 1) == bits(one.te_turn, 1, 0));
    CHECK(bits(eight.te_turn, 8, 5) == bits(four.te_turn, 4, 0));
    CHECK(bits(eight.te_turn, 8, 5) != bits(eight.te_turn, 8, 2));
}

}  // namespace gearpod::mc::test_fluctuations
