// Checks the measuring range of sensors: samples with their noise are clipped, in exports and in
// all features.
#include <fmt/format.h>

#include "mc/study/study.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_sensor_range {

using namespace test;

constexpr double kRange = 0.15;  // passed by some of the samples
const std::string kNoise = " --set sensor.noise_m_s2=0.03 ";
const std::string kClipped = kNoise + fmt::format("--set sensor.range_m_s2={} ", kRange);

TEST_CASE("Exported samples are clipped after the noise was added") {
    const Folder folder;
    const std::string sensor =
        "--set 'sensor.additional=[{name=\"side\", angle_deg=90, range_m_s2=0.1}]'";
    const auto free = signals_of_small(folder, kNoise + sensor);
    const auto clipped = signals_of_small(folder, kClipped + sensor);
    const auto check = [&](const std::string& column, double range) {
        INFO(column);
        const std::vector<double>&before = free.at(column), &after = clipped.at(column);
        std::size_t beyond = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            REQUIRE(after[i] == std::clamp(before[i], -range, range));
            beyond += after[i] != before[i] ? 1 : 0;
        }
        return beyond;
    };
    for (const char* column : {"sensor", "sensor_noise_1"}) {
        const std::size_t beyond = check(column, kRange);
        CHECK(beyond > 30);
        CHECK(beyond < 1800);
    }
    // The second sensor has the same range in both.
    CHECK(check("sensor_side_noise_1", 0.1) == 0);
    CHECK(std::ranges::max(clipped.at("sensor_side_noise_1")) == 0.1);
}

// `features` refuses recordings with many clipped samples, hence the larger range.
TEST_CASE("Features of a run are those of its clipped samples") {
    const std::string noise = kNoise + " --set sensor.noise_density_m_s2_per_sqrt_Hz=0.001 ",
                      options = noise + "--set sensor.range_m_s2=0.18 ";
    const Folder folder;
    const mc::Results free = run_small(folder, "free.h5", noise),
                      results = run_small(folder, "run.h5", options);
    const auto measured = features_of_export(folder, "sensor_noise_1", options);
    for (const char* name :
         {"sensor_rms", "window_ratio", "window_kurtosis", "fm4", "crest_factor"}) {
        INFO(name);
        const double value = values(results.features, name)[25];
        CHECK(value == Approx(printed_value(measured, name)).epsilon(kMean));
        CHECK(std::abs(value / values(free.features, name)[25] - 1.0) > 1e-4);
    }
}

TEST_CASE("A range lowers the rms, and one that no sample reaches changes no feature") {
    const Folder folder;
    const mc::Results free = run_small(folder, "free.h5", kNoise),
                      wide = run_small(folder, "wide.h5", kNoise + "--set sensor.range_m_s2=100"),
                      clipped = run_small(folder, "clipped.h5", kClipped);
    for (std::size_t f = 0; f < free.features.size(); ++f) {
        INFO(free.features[f].name);
        test::check_close(wide.features[f].values, free.features[f].values, 1e-8, 1e-10);
    }
    const auto &before = values(free.features, "sensor_rms"),
               &after = values(clipped.features, "sensor_rms");
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i] < 0.99 * before[i]);
        CHECK(after[i] < kRange);
    }
}

TEST_CASE("A range of one sensor leaves the features of the others unchanged") {
    const Folder folder;
    const std::string other = "{name=\"other\", angle_deg=90}",
                      own = ", {name=\"own\", angle_deg=90, range_m_s2=0.1}";
    const auto run = [&](const std::string& name, const std::string& sensors) {
        return run_small(folder, name, kNoise + "--set 'sensor.additional=[" + sensors + "]'");
    };
    const mc::Results plain = run("plain.h5", other), results = run("own.h5", other + own);
    check_same_features(results, plain);
    const auto &free = values(results.variants[0].features, "sensor_rms"),
               &clipped = values(results.variants[1].features, "sensor_rms");
    for (std::size_t i = 0; i < free.size(); ++i) {
        CHECK(clipped[i] < free[i]);
    }
}

TEST_CASE("What needs samples that are not clipped refuses a range") {
    const Folder folder;
    const auto refused = [](const std::string& command, const char* text) {
        check_refused(command, {text});
    };
    const std::string change = " --set 'features.use=[\"sensor_rms\", \"change_window_ratio\"]'";
    refused("describe " + kSmall + kClipped + change,
            "sensor.range_m_s2: a range clips the samples, but \"change_window_ratio\"");
    refused("describe " + kSmall + change +
                " --set 'sensor.additional=[{name=\"a\", angle_deg=1, range_m_s2=1}]'",
            "sensor.additional: a range clips the samples, but \"change_window_ratio\"");
    refused("describe " + kSmall + kClipped +
                "--set ensemble.threshold_tilt=true --set ensemble.threshold_records=8",
            "needs Gaussian noise");
    refused("describe " + kSmall + " --set sensor.range_m_s2=0", "sensor.range_m_s2");
    refused("lives " + study("planet-crack-ideal.toml") +
                " --set life.interval_h=10 --set life.first_depth_mm=1 --set life.last_depth_mm=3"
                " --set life.paris_factor=1e-9 --set life.paris_exponent=3"
                " --set sensor.range_m_s2=1 --out " +
                folder.file("l.h5"),
            "sensor.range_m_s2: records are superpositions of parts, which are not clipped");
    refused("calibrate " + kSmall + kClipped + "--features " +
                study("published/liang-rig-healthy.csv") + " --out " + folder.file("c.toml"),
            "sensor.range_m_s2: calibration does not clip the samples");
    run_small(folder, "r.h5", kClipped);
    refused("misses " + folder.file("r.h5") + " --feature window_ratio --size 0.4",
            "its study clips the samples");
    CHECK(program("describe " + kSmall + kClipped)
              .mentions("samples are clipped at 0.15 m/s^2 of either sign"));
}

}  // namespace gearpod::test_sensor_range
