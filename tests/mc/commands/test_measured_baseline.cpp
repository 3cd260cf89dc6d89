// Checks features --baseline: a recording compared with an earlier one of the same gearbox.
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_measured_baseline {

using namespace test;

// Planets and ring have tooth errors: the signal repeats after 385 mesh periods of eight samples.
const std::string kStudy =
    kSmallStudy +
    " --set gearbox.planet.quality=7 --set "
    "gearbox.ring.quality=7 --set sensor.noise_levels=[0] --set features.baseline_torque_scatter=0 "
    "--set 'features.use=[\"window_ratio\",\"window_z\",\"own_window_ratio\",\"own_sensor_rms\","
    "\"change_window_ratio\",\"change_window_z\",\"change_sensor_rms\"]' ";
constexpr std::size_t kSpan = 385 * 8;
const std::string kFaulty = "--set fault.reduction=0.3 ";

// Recording without noise over one span.
std::vector<double> recorded(const Folder& folder, const std::string& options) {
    const std::string path = folder.file("s.h5");
    require_success("simulate " + kStudy + options + "--instance 2 --meshes 385 --out " + path);
    auto values = read_columns(path, "signals", {"sensor"})[0];
    values.resize(kSpan);
    return values;
}

std::string written(const Folder& folder, const std::string& name,
                    const std::vector<double>& sensor) {
    return write_csv(folder.file(name), "sensor", {sensor});
}

Outcome features(const std::string& path, const std::string& options) {
    return program("features " + path + " --samples-per-mesh 8 --study " + kStudy + options);
}

nlohmann::json features_json(const std::string& path, const std::string& options) {
    return json_of(features(path, options + " --json -"));
}

TEST_CASE("A measured baseline gives the result of the simulated one, for any start") {
    const Folder folder;
    const std::string healthy = written(folder, "healthy.csv", recorded(folder, ""));
    const std::string faulty = written(folder, "faulty.csv", recorded(folder, kFaulty));
    require_success("run " + kStudy + kFaulty + "--quiet --out " + folder.file("r.h5"));
    const mc::Results run = mc::read_results(folder.file("r.h5"));
    const auto of_run = [&](const std::string& name) {
        const auto found = std::find_if(run.features.begin(), run.features.end(),
                                        [&](const auto& one) { return one.name == name; });
        return found->values[2];
    };
    const auto json = features_json(faulty, "--baseline " + healthy);
    CHECK(json["baseline"]["correlation"].get<double>() > 0.5);
    for (const char* name : {"window_ratio", "own_window_ratio", "own_sensor_rms"}) {
        INFO(name);
        // The run keeps the mean of its signal; that of a recording is removed.
        CHECK(json["features"][name].get<double>() == Approx(of_run(name)).epsilon(1e-4));
    }
    // The fault itself changes the best shift by some thousandths of a sample.
    CHECK(json["features"]["change_sensor_rms"].get<double>() ==
          Approx(of_run("change_sensor_rms")).epsilon(1e-3));
    CHECK(json["features"]["change_window_ratio"].get<double>() > 50.0);

    auto turned = recorded(folder, "");
    std::rotate(turned.begin(), turned.begin() + 123, turned.end());
    const auto again = features_json(faulty, "--baseline " + written(folder, "turned.csv", turned));
    CHECK(again["baseline"]["turned_on_meshes"].get<double>() ==
          Approx((static_cast<double>(kSpan) - 123.0) / 8).margin(1e-3));
    check_alike(again["features"], json["features"], 1e-4,
                {"change_window_ratio", "change_sensor_rms", "own_window_ratio"});
}

// Definitions in numpy on stored signals: tests/features/reference/README.md.
TEST_CASE("Features of the change equal the numpy result for the same signals") {
    const auto result =
        json_of("features " + kReferenceFolder + "faulty.h5 --study " + kSmallStudy +
                " --baseline " + kReferenceFolder + "healthy-1.h5 --json -")["features"];
    const auto expected = json_of_file(kReferenceFolder + "expected-change.json");
    CHECK(expected.size() == 8);
    for (const auto& [name, numpy] : expected.items()) {
        INFO(name);
        REQUIRE(result.contains(name));
        CHECK(std::abs(result[name].get<double>() / numpy.get<double>() - 1.0) < 1e-12);
    }
}

TEST_CASE("A file that is no baseline of a recording is reported") {
    const Folder folder;
    const auto healthy = recorded(folder, "");
    const std::string path = written(folder, "healthy.csv", healthy);
    auto other = healthy;
    for (std::size_t i = 0; i < other.size(); ++i) {
        other[i] = 1e-3 * std::sin(1.3 * static_cast<double>(i) * static_cast<double>(i));
    }
    const auto json = features_json(path, "--baseline " + written(folder, "other.csv", other));
    CHECK_FALSE(json["features"].contains("change_window_ratio"));
    CHECK_THAT(json["unavailable"]["change_window_ratio"].get<std::string>(),
               Catch::Contains("other.csv") && Catch::Contains("does not resemble this baseline"));
    CHECK(json["features"].contains("window_ratio"));

    check_refused(features(path, "--baseline " + folder.file("none.csv")), {"none.csv"});
    CHECK(features(path, "--baseline " + path + " --json " + path).code == 2);

    // A part of the span has no circular shift: it must begin where the baseline does.
    const std::vector<double> part(healthy.begin() + 88, healthy.begin() + 88 + 33 * 8);
    const auto elsewhere = features_json(written(folder, "part.csv", part), "--baseline " + path);
    CHECK(contains(elsewhere["unavailable"]["change_sensor_rms"].get<std::string>(),
                   "start position"));
}

TEST_CASE("Many recordings are compared with one baseline") {
    const Folder folder;
    const std::string healthy = written(folder, "a.csv", recorded(folder, ""));
    const std::string faulty = written(folder, "b.csv", recorded(folder, kFaulty));
    check_mentions(
        require_success(features(healthy + " " + faulty, "--quiet --csv - --baseline " + healthy)),
        {"own_window_ratio", "change_window_z"});
    CHECK(features(healthy + " " + faulty, "--quiet --csv -").mentions("window_ratio"));
    CHECK_FALSE(features(healthy + " " + faulty, "--quiet --csv -").mentions("change_"));
}

}  // namespace gearpod::test_measured_baseline
