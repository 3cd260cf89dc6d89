// Checks planets that differ: given and random deviations, and the repetition of their meshes.
#include "mc/plan/sampling.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_planets {

Study study_with(const std::vector<std::string>& overrides) {
    return test::valid_study(read_study_text(tests::kExampleStudy, "study.toml", overrides));
}

TEST_CASE("Planets differ by given and by random deviations, independently in each gearbox") {
    const Study given = study_with(
        {"gearbox.pin_tangential_um=[10, 0, 0, 0]", "gearbox.pin_radial_um=[0, 5, 0, 0]"});
    const Planets listed = nominal_inputs(given).planets;
    // Planet 1 lies on the x axis and moves towards y, planet 2 on the y axis.
    CHECK(listed[0].pin_x_m == Approx(0.0).margin(1e-20));
    CHECK(listed[0].pin_y_m == Approx(10e-6));
    CHECK(listed[1].pin_x_m == Approx(0.0).margin(1e-20));
    CHECK(listed[1].pin_y_m == Approx(5e-6));

    const std::vector<std::string> scatter{"gearbox.pin_tangential_rms_um=8",
                                           "gearbox.pin_radial_rms_um=3"};
    const Sampler sampler(DrawPlan{study_with(scatter)});
    double tangential = 0.0, radial = 0.0;
    constexpr int kGearboxes = 2000;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        const Planets planets = sampler.draw({Group::test, i}).inputs.planets;
        for (int n = 0; n < 4; ++n) {
            const double psi = 0.5 * std::numbers::pi * n;
            const auto& p = planets[static_cast<std::size_t>(n)];
            const double along = p.pin_y_m * std::cos(psi) - p.pin_x_m * std::sin(psi);
            const double out = p.pin_x_m * std::cos(psi) + p.pin_y_m * std::sin(psi);
            tangential += along * along / (4 * kGearboxes);
            radial += out * out / (4 * kGearboxes);
        }
        CHECK(planets[4].pin_x_m == 0.0);  // there is no fifth planet
    }
    CHECK(std::sqrt(tangential) == Approx(8e-6).epsilon(0.04));
    CHECK(std::sqrt(radial) == Approx(3e-6).epsilon(0.04));
    // A random scatter scales the deviations of its gearbox.
    auto twice = scatter;
    twice[0] = "gearbox.pin_tangential_rms_um=16";
    twice[1] = "gearbox.pin_radial_rms_um=6";
    const Planets once = sampler.draw({Group::test, 7}).inputs.planets;
    const Planets twice_as_far =
        Sampler(DrawPlan{study_with(twice)}).draw({Group::test, 7}).inputs.planets;
    CHECK(twice_as_far[2].pin_x_m == Approx(2.0 * once[2].pin_x_m));
}

TEST_CASE("Different planets repeat every mesh: reused records equal integration of all meshes") {
    const auto features = [](std::vector<std::string> overrides) {
        overrides.insert(overrides.end(),
                         {"operation.carrier_speed_rpm=60", "sensor.sampling_Hz=20000",
                          "sensor.encoder_sampling_Hz=20000", "sensor.noise_levels=[0]"});
        Study study = test::shipped_study("planet-crack-ideal.toml", overrides);
        study.ensemble.threshold_instances = 1;
        study.ensemble.instances = 7;
        const Results results = test::run(study);
        std::vector<double> values;
        for (const auto& feature : results.features) {
            values.insert(values.end(), feature.values.begin(), feature.values.end());
        }
        return values;
    };
    const std::vector<std::string> unlike{"gearbox.pin_tangential_rms_um=20",
                                          "gearbox.pin_radial_rms_um=20"};
    auto all = unlike;
    all.push_back("numerics.horizon=full");
    const auto reused = features(unlike), full_horizon = features(all), alike = features({});
    REQUIRE(reused.size() == full_horizon.size());
    double moved = 0.0;
    for (std::size_t i = 0; i < reused.size(); ++i) {
        INFO(i);
        CHECK(reused[i] == Approx(full_horizon[i]).epsilon(1e-6).margin(1e-6));
        moved = std::max(moved, std::abs(reused[i] / alike[i] - 1.0));
    }
    CHECK(moved > 0.02);
}

}  // namespace gearpod::mc::test_planets
