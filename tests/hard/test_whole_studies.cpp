// Checks hard cases from a user's view: whole studies, their status counts, messages and exit
// codes.
#include "tests/hard/floating_point_traps.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_whole_studies {

using mc::Status;
using test::Folder;
using test::Outcome;
using test::program;

using Overrides = std::vector<std::string>;

// Liang's train at high speed, so that a mesh period is short, and few gearboxes.
Overrides fast_train(const Overrides& more = {}) {
    return test::joined({"operation.carrier_speed_rpm=60", "sensor.sampling_Hz=20000",
                         "sensor.encoder_sampling_Hz=20000", "ensemble.instances=7",
                         "ensemble.threshold_instances=9", "numerics.threads=1"},
                        more);
}

mc::Results results(const Overrides& overrides) {
    return test::run(test::shipped_study("planet-crack-ideal.toml", overrides));
}

Outcome run_program(const std::string& study, const Folder& folder, const Overrides& overrides) {
    return program("run " + study + test::set_options(overrides) + " --force --out " +
                   folder.file("r.h5"));
}

void check_all_worked(const mc::Results& r) {
    for (const int status : r.status) {
        CHECK(status == static_cast<int>(Status::ok));
    }
    for (const auto& feature : r.features) {
        INFO(feature.name);
        for (const double value : feature.values) {
            CHECK(std::isfinite(value));
        }
    }
}

double value_of(const mc::Results& r, const std::string& feature, std::size_t row,
                std::size_t level) {
    return r.features[test::feature_index(r, feature)].values[row * r.noise_levels.size() + level];
}

TEST_CASE("Tails of distributions: bearings a hundred times as stiff, no torque, no noise") {
    const mc::Results plain = results(fast_train());
    check_all_worked(plain);
    const mc::Results stiff = results(fast_train(
        {"gearbox.planet.bearing_stiffness_N_m=1e10", "gearbox.sun.bearing_stiffness_N_m=1e10",
         "gearbox.ring.bearing_stiffness_N_m=1e10", "gearbox.carrier.bearing_stiffness_N_m=1e10"}));
    check_all_worked(stiff);
    const mc::Results undamped_mesh = results(fast_train({"gearbox.mesh_damping_ratio=0"}));
    check_all_worked(undamped_mesh);
    // The system is linear: twice the torque gives twice the transmission error, exactly without
    // noise.
    const mc::Results one = results(fast_train({"operation.torque_N_m=429"}));
    const mc::Results two = results(fast_train({"operation.torque_N_m=858"}));
    const mc::Results none = results(fast_train({"operation.torque_N_m=0"}));
    check_all_worked(two);
    for (std::size_t row = 0; row < one.status.size(); ++row) {
        const double te = value_of(one, "te_rms", row, 0);
        CHECK(te > 1e-6);
        CHECK(value_of(two, "te_rms", row, 0) == Approx(2.0 * te).epsilon(1e-8));
        CHECK(value_of(none, "te_rms", row, 0) < 1e-8 * te);
    }
    // All noise levels are equal without noise.
    const mc::Results quiet =
        results(fast_train({"sensor.noise_m_s2=0", "sensor.encoder_noise_arcsec=0"}));
    check_all_worked(quiet);
    const std::size_t levels = quiet.noise_levels.size();
    for (const auto& feature : quiet.features) {
        for (std::size_t i = 0; i < feature.values.size(); ++i) {
            CHECK(feature.values[i] == feature.values[i - i % levels]);
        }
    }
}

TEST_CASE("Without any damping no gearbox converges, and none hangs or counts as converged") {
    const Folder folder;
    const Outcome outcome = run_program(
        test::study("planet-crack-ideal.toml"), folder,
        fast_train({"gearbox.mesh_damping_ratio=0", "gearbox.planet.bearing_damping_N_s_m=0",
                    "gearbox.sun.bearing_damping_N_s_m=0", "gearbox.ring.bearing_damping_N_s_m=0",
                    "gearbox.carrier.bearing_damping_N_s_m=0", "gearbox.support_damping_N_s_m=0",
                    "numerics.max_meshes=50"}));
    INFO(outcome.output);
    CHECK(outcome.code == 3);
    CHECK(outcome.mentions("16 of 16 gearboxes failed"));
    const mc::Results r = mc::read_results(folder.file("r.h5"));
    for (const auto& feature : r.features) {
        for (const double value : feature.values) {
            CHECK(std::isnan(value));
        }
    }
}

TEST_CASE("A crack through the whole tooth still gives results") {
    // A crack of 8.571 mm at 45 degrees exits Liang's planet tooth.
    const mc::Results r = results(fast_train({"fault.depth_mm=8.571"}));
    check_all_worked(r);
    CHECK(value_of(r, "window_ratio", 9, 0) > 1.5);
}

TEST_CASE("A missing tooth: time integration succeeds, equilibrium does not exist") {
    const Folder folder;
    std::string text = tests::replaced(tests::kFixedShaftStudy, "kind = \"chip\"",
                                       "kind = \"broken\"\nbroken = 1");
    text = tests::replaced(text, "chip_mm = 8\nchip_height_mm = 2\n", "");
    REQUIRE_FALSE(text.empty());
    test::write_bytes(folder.file("broken.toml"), text);
    require_success(run_program(folder.file("broken.toml"), folder, {}));
    check_all_worked(mc::read_results(folder.file("r.h5")));

    for (const char* key : {"sampling_Hz = 50000\n", "low_pass_Hz = 10000\n"}) {
        text = tests::replaced(text, key, "");
    }
    text = tests::replaced(text, "[effects]\n", "[effects]\nmotion = \"quasi-static\"\n");
    REQUIRE_FALSE(text.empty());
    test::write_bytes(folder.file("broken.toml"), text);
    const Outcome still = run_program(folder.file("broken.toml"), folder, {});
    INFO(still.output);
    CHECK(still.code == 3);
    CHECK(still.mentions("has no equilibrium"));
    // Healthy gearboxes of the threshold sample have an equilibrium.
    const mc::Results r = mc::read_results(folder.file("r.h5"));
    CHECK(r.status == std::vector<int>{0, 0, 6, 6, 6});
}

TEST_CASE("A gearbox above a critical speed is reported as such") {
    const Folder folder;
    Overrides overrides = fast_train({"operation.carrier_speed_rpm=5000"});
    for (const char* body : {"planet", "sun", "ring", "carrier"}) {
        overrides.push_back(std::string("gearbox.") + body + "_bearing_stiffness_N_m=1e6");
    }
    overrides.insert(overrides.end(),
                     {"sensor.sampling_Hz=100000", "sensor.encoder_sampling_Hz=100000"});
    const Outcome outcome = run_program(test::study("planet-crack-ideal.toml"), folder, overrides);
    INFO(outcome.output);
    CHECK(outcome.code == 3);
    CHECK(outcome.mentions("16 of 16 gearboxes failed"));
    CHECK(outcome.mentions("16 of them: each is unstable: above a critical speed"));
    const Outcome one = program("simulate " + test::study("planet-crack-ideal.toml") +
                                test::set_options(overrides) + " --instance 12");
    INFO(one.output);
    CHECK(one.code == 3);
    CHECK(one.mentions("critical speed of the carrier"));
}

TEST_CASE(
    "A gearbox in parametric resonance is reported as such, and next to the resonance it works") {
    // Speeds and damping of test_parametric_resonance.cpp, with multipliers 1.06 and 0.94. The
    // growing motion is far above the sensor's band, and 43 steps per mesh would damp it.
    for (const double speedup : {200.0, 220.0}) {
        const Folder folder;
        const Outcome outcome = run_program(
            test::study("planet-crack-ideal.toml"), folder,
            fast_train({"operation.carrier_speed_rpm=" + std::to_string(speedup * 8.87),
                        "effects.motion=torsional", "numerics.steps_per_mesh=600",
                        "gearbox.mesh_damping_ratio=0.002", "gearbox.support_damping_N_s_m=5e3",
                        "fault.depth_mm=0", "sensor.sampling_Hz=60000",
                        "sensor.encoder_sampling_Hz=60000"}));
        INFO(outcome.output);
        CHECK(outcome.code == (speedup < 210.0 ? 3 : 0));
        CHECK(outcome.mentions("unstable by parametric resonance") == (speedup < 210.0));
    }
}

TEST_CASE("Gearboxes too light for the step fail with this reason; the others keep their bits") {
    // The pilot that chooses the steps uses the first 32 gearboxes: suns 1 to 5, never the sixth.
    const auto with_sixth = [](const std::string& kg) {
        const std::string text =
            tests::replaced(test::bytes_of(test::study("planet-crack-ideal.toml")), "[random]\n",
                            "[random]\ngearbox.sun_mass_kg = { distribution = \"levels\", values = "
                            "[0.6, 0.65, 0.7, "
                            "0.75, 0.8, " +
                                kg + "] }\n");
        const auto reading = mc::read_study_text(
            text, "study.toml",
            fast_train({"ensemble.instances=42", "ensemble.threshold_instances=6"}));
        INFO(mc::format(reading.problems));
        REQUIRE(reading.study.has_value());
        return test::run(*reading.study);
    };
    const test::ExpectedOverflow overflow;
    const mc::Results healthy = with_sixth("0.85"), light = with_sixth("1e-6");
    REQUIRE(light.status.size() == 48);
    int failed = 0;
    for (std::size_t row = 0; row < 48; ++row) {
        CHECK(healthy.status[row] == 0);
        if (light.status[row] != 0) {
            ++failed;
            CHECK(light.status[row] == static_cast<int>(Status::step_too_long));
            continue;
        }
        for (std::size_t f = 0; f < light.features.size(); ++f) {
            for (std::size_t level = 0; level < light.noise_levels.size(); ++level) {
                const std::size_t at = row * light.noise_levels.size() + level;
                CHECK(light.features[f].values[at] == healthy.features[f].values[at]);
            }
        }
    }
    CHECK(failed == 7);
}

TEST_CASE(
    "Single precision gives the features of double precision at vanishing stiffness, high "
    "stiffness and high speed") {
    struct Hard {
        double allowed;
        Overrides overrides;
    };
    const std::vector<Hard> scenes = {
        {2e-4, {"fault.depth_mm=8.571"}},  // through the whole tooth
        {2e-4,
         {"gearbox.planet.bearing_stiffness_N_m=1e10", "gearbox.sun.bearing_stiffness_N_m=1e10",
          "gearbox.ring.bearing_stiffness_N_m=1e10", "gearbox.carrier.bearing_stiffness_N_m=1e10"}},
        {2e-4, {"gearbox.mesh_damping_ratio=0"}},
        // The planets' centrifugal forces are 650 times the mesh forces.
        {1e-2, {"operation.torque_N_m=1e-3"}},
        {5e-3,
         {"operation.carrier_speed_rpm=5000", "sensor.sampling_Hz=2e6",
          "sensor.encoder_sampling_Hz=2e6", "sensor.low_pass_Hz=2e5"}}};
    for (const Hard& scene : scenes) {
        INFO(scene.overrides.front());
        Overrides overrides = fast_train(scene.overrides);
        const mc::Results doubles = results(overrides);
        overrides.emplace_back("numerics.precision=single");
        const mc::Results singles = results(overrides);
        check_all_worked(doubles);
        check_all_worked(singles);
        for (const char* feature : {"te_rms", "sensor_rms", "window_ratio"}) {
            for (std::size_t row = 0; row < doubles.status.size(); ++row) {
                const double exact = value_of(doubles, feature, row, 0);
                const double rounded = value_of(singles, feature, row, 0);
                CHECK(rounded == Approx(exact).epsilon(scene.allowed));
                // The ratio of healthy gearboxes is 1.
                CHECK((rounded != exact || exact == 1.0));
            }
        }
    }
}

}  // namespace gearpod::test_whole_studies
