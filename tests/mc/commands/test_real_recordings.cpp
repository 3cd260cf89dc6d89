// Checks recordings as written by data loggers, made from simulated ones: the right features, or a
// reason. tests/recordings has units, times and formats.
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_real_recordings {

using namespace test;

const std::string kSmall = kSmallStudy + " --set fault.reduction=0.5";
const std::vector<std::string> kFeatures{
    "sensor_rms",   "window_ratio", "crest_factor",     "fm4",
    "energy_ratio", "frms",         "sun_window_ratio", "ring_window_ratio"};

Outcome features(const std::string& path, const std::string& options = "") {
    return program("features " + path + " --study " + kSmall + " " + options);
}

nlohmann::json features_of(const std::string& path, const std::string& options = "") {
    return json_of(features(path, options + " --json -"))["features"];
}

// A healthy gearbox over the longest span with the study's noise.
struct Simulated {
    Folder folder;
    std::vector<double> time, sensor;
    nlohmann::json plain;  // its features

    explicit Simulated(const std::string& options = "") {
        const std::string path = folder.file("s.h5");
        require_success("simulate " + kSmall + options + " --instance 2 --meshes 455 --out " +
                        path);
        CsvColumns columns = read_columns(path, "signals", {"time", "sensor_noise_1"});
        time = std::move(columns[0]);
        sensor = std::move(columns[1]);
        plain = features_of(write("time,sensor", {time, sensor}), options);
    }
    std::string write(const std::string& header, const CsvColumns& columns, int digits = 17) const {
        return write_csv(folder.file("r.csv"), header, columns, digits);
    }
    void check_same(const nlohmann::json& found, double share = 1e-9) const {
        check_alike(found, plain, share, kFeatures);
    }
};

const Simulated& simulated() {
    static const Simulated once;
    return once;
}

TEST_CASE("A unit that takes precedence over the file is noted") {
    const Simulated& s = simulated();
    const std::string path = s.write("time,sensor [V]", {s.time, s.sensor});
    const std::string note = "the file states V; taken as m/s^2 (--sensor-unit)";
    CHECK(features(path, "--sensor-unit m/s^2").mentions("note: column sensor: " + note));
    const auto found = json_of(features(path, "--sensor-unit m/s^2 --json -"));
    s.check_same(found["features"]);
    REQUIRE(found["notes"].size() == 1);
    CHECK(found["notes"][0] == "column sensor: " + note);
    check_mentions(features(path + " " + path, "--sensor-unit m/s^2 --csv -"),
                   {"and 1 more: column sensor: " + note});
}

TEST_CASE("A stated sampling rate that is not used is reported") {
    const Simulated& s = simulated();
    const std::string path = s.folder.file("r.h5");
    {
        const auto file = mc::create_file(path);
        const auto run = mc::create_group(file.get(), "run");
        mc::write_numbers(run.get(), "sensor", {s.sensor.size(), 1}, s.sensor);
        mc::write_numbers(run.get(), "time", {s.time.size()}, s.time);
        mc::write_number(file.get(), ".", "fs", 99.0);
    }
    s.check_same(features_of(path));
    check_mentions(features(path),
                   {"note: column sensor is run/sensor",
                    "the file states a sampling rate of 99 Hz; taken as 280 Hz (column time)"});
    s.check_same(features_of(path, "--sampling-Hz 280"));
    CHECK(features(path, "--sampling-Hz 280").mentions("taken as 280 Hz (--sampling-Hz)"));
    CHECK(features(path, "--sensor run/acc").mentions("its columns are run/sensor ("));
}

TEST_CASE("Clipped samples are reported") {
    const Simulated& s = simulated();
    auto sensor = s.sensor;
    const double largest = *std::max_element(s.sensor.begin(), s.sensor.end());
    for (double& value : sensor) {
        value = std::clamp(value, -0.3 * largest, 0.3 * largest);
    }
    check_refused(features(s.write("time,sensor", {s.time, sensor})), {"column sensor: clipped: "});
}

TEST_CASE("Lost samples without a gap in the times are detected, or reported as undetectable") {
    const Simulated& s = simulated();
    CHECK(json_of(features(s.write("sensor", {s.sensor}),
                           "--sampling-Hz 280 --json -"))["losses_noticed"] == true);
    for (const long lost : {1L, 3L, 5L}) {
        auto sensor = s.sensor;
        sensor.erase(sensor.begin() + 1800, sensor.begin() + 1800 + lost);
        const Outcome outcome =
            check_refused(features(s.write("sensor", {sensor}), "--sampling-Hz 280"),
                          {"which the times do not show"});
        // Expected in turn 7 of 35 mesh periods, or one turn earlier or later.
        CHECK(outcome.mentions("after mesh period 1"));
        CHECK(features(s.write("sensor", {sensor}), "--sampling-Hz 280 --speed stated").code == 0);
    }
    // Four turns of the carrier are too few.
    const std::vector<double> part(s.sensor.begin(), s.sensor.begin() + 4L * 35 * 8);
    check_mentions(require_success(features(s.write("sensor", {part}), "--sampling-Hz 280")),
                   {"lost samples cannot be detected"});
}

TEST_CASE("A speed error of 2 % is detected, and the speed can be taken from the mesh lines") {
    const Simulated& s = simulated();
    for (const double wrong : {0.98, 1.02}) {
        const std::string path = s.write("time,sensor", {times(s.time, 1.0 / wrong), s.sensor});
        check_refused(features(path), {"times the stated speed"});
        CHECK(features(path, "--speed stated").code == 0);
    }
    // Three mesh harmonics do not distinguish a mesh line from its neighbours.
    CHECK(features(s.write("time,sensor", {times(s.time, 1.0 / 1.02), s.sensor}), "--speed found")
              .mentions("too few to determine the speed"));
    const std::string finer = " --set sensor.sampling_Hz=560 --set sensor.low_pass_Hz=240";
    const Simulated fine(finer);
    for (const double wrong : {0.98, 1.02}) {
        const auto found =
            features_of(fine.write("time,sensor", {times(fine.time, 1.0 / wrong), fine.sensor}),
                        finer + " --speed found");
        // Content near half the sampling rate is lost in resampling (resampling.hpp).
        check_alike(found, fine.plain, 0.05, {"window_ratio"});
    }
}

TEST_CASE("A tachometer's pulses give the mesh phase, and a missing pulse is reported") {
    const Simulated& s = simulated();
    // One carrier turn lasts 35 mesh periods of 8 samples. Five pulses per turn, 56 samples apart,
    // start before the first sample.
    std::vector<double> pulses, missing;
    for (std::size_t i = 0; i < s.time.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) - 0.5) / 56.0;
        pulses.push_back(std::sin(angle) > 0.0 ? 5.0 : 0.0);
        missing.push_back(i > 1000 && i < 1060 ? 0.0 : pulses.back());
    }
    const std::string options = "--tachometer tacho --pulses-per-turn 5";
    const auto counted =
        features_of(s.write("time,sensor,tacho", {s.time, s.sensor, pulses}), options);
    check_alike(counted, s.plain, 1e-2, {"sensor_rms"});
    check_alike(counted, s.plain, 2e-2, {"window_ratio"});
    check_refused(features(s.write("time,sensor,tacho", {s.time, s.sensor, missing}), options),
                  {"one is missing or superfluous"});
    CHECK(features(s.write("time,sensor", {s.time, s.sensor}), "--tachometer tacho")
              .mentions("no column tacho"));
}

TEST_CASE("An encoder's angle gives the mesh phase: coarse, reset each turn or decreasing") {
    const Simulated& s = simulated();
    constexpr double kTurn = 35.0 * 8.0;  // in samples
    std::vector<double> fine, wrapped, counts, back;
    for (std::size_t i = 0; i < s.time.size(); ++i) {
        const double turns = static_cast<double>(i) / kTurn;
        fine.push_back(turns);
        wrapped.push_back(360.0 * (0.75 + turns - std::floor(0.75 + turns)));
        counts.push_back(-std::floor(turns * 140.0) / 140.0);  // backwards, two samples per count
        back.push_back(i == 700 ? turns - 0.1 : turns);
    }
    const auto by = [&](const std::string& name, const std::vector<double>& angle) {
        return s.write("time,sensor," + name, {s.time, s.sensor, angle});
    };
    const auto check = [&](const std::string& path, double within) {
        check_alike(features_of(path, "--encoder angle"), s.plain, within,
                    {"sensor_rms", "window_ratio"});
    };
    check(by("angle [turns]", fine), 1e-6);
    check(by("angle [deg]", wrapped), 1e-6);
    check(by("angle [turns]", counts), 2e-2);
    check_refused(features(by("angle [turns]", back), "--encoder angle"),
                  {"turns back by 0.6", "from sample 700 to the next"});
    CHECK(features(by("angle [parsec]", fine), "--encoder angle").mentions("unknown unit"));
    CHECK(features(by("other", fine), "--encoder angle").mentions("no column angle"));
}

TEST_CASE("An encoder or a mesh phase that jumps ahead is refused with the time and the size") {
    const Simulated& s = simulated();
    constexpr double kTurn = 35.0 * 8.0;  // in samples
    for (const double jump : {0.005, 0.1, 0.49}) {
        std::vector<double> angle, phase;
        for (std::size_t i = 0; i < s.time.size(); ++i) {
            angle.push_back(static_cast<double>(i) / kTurn + (i >= 700 ? jump : 0.0));
            phase.push_back(35.0 * angle.back());
        }
        check_refused(features(s.write("time,sensor,angle [turns]", {s.time, s.sensor, angle}),
                               "--encoder angle"),
                      {"column angle: jumps ahead by " + std::to_string(jump).substr(0, 3),
                       "turn at sample 701", "(2.5 s)"});
        check_refused(features(s.write("mesh_phase,sensor", {phase, s.sensor})),
                      {"column mesh_phase: jumps by"});
    }
}

TEST_CASE("A recording is compared with a results file in one sentence") {
    const Folder folder;
    const std::string study = kSmall +
                              " --set ensemble.threshold_instances=60 "
                              "--set detection.false_alarm_rate=0.05 "
                              "--set 'features.use=[\"window_ratio\",\"sensor_rms\"]'";
    require_success("run " + study + " --quiet --out " + folder.file("p.h5"));
    const Simulated s;  // with half of a tooth's stiffness lost
    const std::string path = s.write("time,sensor", {s.time, s.sensor});
    const auto against =
        json_of(features(path, "--against " + folder.file("p.h5") + " --json -"))["against"];
    REQUIRE(against["features"].size() == 2);
    for (const auto& one : against["features"]) {
        CHECK(one["healthy"] == 60);
        CHECK(one["alarm"] == (one["value"].get<double>() > one["threshold"].get<double>()));
        CHECK((one["margin"].get<double>() > 0.0) == one["alarm"].get<bool>());
        if (one["alarm"]) {
            CHECK(one["quantile"].get<double>() > 0.9);
        }
    }
    CHECK_THAT(against["sentence"].get<std::string>(), Catch::Contains("simulated healthy"));
    REQUIRE(against["teeth"].size() >= 1);
    CHECK(against["teeth"][0]["teeth"] == 11);
    check_refused("features " + path + " --study " + kSmall +
                  " --set gearbox.planets=4 --set gearbox.sun.teeth=15 --set "
                  "gearbox.ring.teeth=37 --against " +
                  folder.file("p.h5"));
    // A machine of another level is not that of the study, whatever its features say.
    for (const auto& [factor, which] : {std::pair{35.0, "largest"}, std::pair{0.01, "smallest"}}) {
        std::vector<double> other = s.sensor;
        for (double& value : other) {
            value *= factor;
        }
        const std::string scaled = s.write("time,sensor", {s.time, other});
        const auto refused =
            json_of(features(scaled, "--against " + folder.file("p.h5") + " --json -"))["against"];
        CHECK(refused["alarm"].is_null());
        CHECK_THAT(refused["mismatch"].get<std::string>(), Catch::Contains(which));
        CHECK_THAT(
            refused["sentence"].get<std::string>(),
            Catch::Contains("no decision") && Catch::Contains("does not describe this machine"));
        check_mentions(
            features(scaled, "--against " + folder.file("p.h5") + " --feature window_ratio"),
            {"no decision"});
        s.write("time,sensor", {s.time, s.sensor});
    }
    CHECK(features(path, "--feature window_ratio").mentions("is only used with --against"));
    CHECK(features(path, "--feature fm4 --against " + folder.file("p.h5")).code == 2);
}

TEST_CASE("Ten million rows are processed in bounded time and memory") {
    const auto [folder, path] = TemporaryFile("long.csv");
    {
        std::ofstream stream(path);
        stream << "sensor\n";
        std::string block;
        for (int i = 0; i < 1000; ++i) {
            block += std::to_string((i * 7919) % 1000) + "\n";
        }
        for (int i = 0; i < 10000; ++i) {
            stream << block;
        }
    }
    check_mentions(
        require_success(shell(test::within_memory(2000000) + "timeout 120 " +
                              std::string(GEARPOD_PROGRAM) + " features " + path + " --study " +
                              kSmall + " --sampling-Hz 280 --speed stated")),
        {"mesh periods: 1250000 of acceleration"});
}

}  // namespace gearpod::test_real_recordings
