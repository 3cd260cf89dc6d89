// Checks recordings as written by data loggers, made from simulated ones: the right features, or a
// reason.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mc/files/hdf5_data.hpp"
#include "tests/mc/program.hpp"

namespace test_real_recordings {

using namespace gearpod;
using namespace gearpod::test;

namespace {

const std::string kSmall = std::string(GEARPOD_SOURCE_DIR) +
                           "/tests/features/reference/small.toml --set fault.reduction=0.5";

// A healthy gearbox over the longest span with the study's noise.
struct Simulated {
    Folder folder;
    std::vector<double> time, sensor;

    explicit Simulated(const std::string& options = "") {
        const std::string path = folder.file("s.h5");
        REQUIRE(program("simulate " + kSmall + options + " --instance 2 --meshes 455 --out " + path)
                    .code == 0);
        const mc::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                                  path);
        const mc::Hdf5Handle group = mc::open_group(file.get(), "signals");
        time = mc::read_numbers(group.get(), "time", 1000000).values;
        sensor = mc::read_numbers(group.get(), "sensor_noise_1", 1000000).values;
    }
    std::string write(const std::string& header, const std::vector<std::vector<double>>& columns,
                      int digits = 17) const {
        const std::string path = folder.file("r.csv");
        std::ofstream stream(path);
        stream.precision(digits);
        stream << header << "\n";
        for (std::size_t i = 0; i < columns[0].size(); ++i) {
            for (std::size_t c = 0; c < columns.size(); ++c) {
                stream << (c == 0 ? "" : ",") << columns[c][i];
            }
            stream << "\n";
        }
        return path;
    }
};

Outcome features(const std::string& path, const std::string& options = "") {
    return program("features " + path + " --study " + kSmall + " " + options);
}

nlohmann::json features_of(const std::string& path, const std::string& options = "") {
    const Outcome outcome = features(path, options + " --json -");
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(outcome.output)["features"];
}

void check_alike(const nlohmann::json& found, const nlohmann::json& expected, double share) {
    for (const char* name : {"sensor_rms", "window_ratio", "crest_factor", "fm4", "energy_ratio",
                             "frms", "sun_window_ratio", "ring_window_ratio"}) {
        INFO(name);
        REQUIRE(found.contains(name));
        CHECK(found[name].get<double>() == Approx(expected[name].get<double>()).epsilon(share));
    }
}

std::vector<double> times(std::vector<double> values, double factor) {
    for (double& value : values) {
        value *= factor;
    }
    return values;
}

TEST_CASE("Units are converted, and unknown ones refused with those that are known") {
    const Simulated s;
    const auto plain = features_of(s.write("time [s],sensor [m/s^2]", {s.time, s.sensor}));
    check_alike(features_of(s.write("time [ms],sensor [g]",
                                    {times(s.time, 1e3), times(s.sensor, 1.0 / 9.80665)})),
                plain, 1e-9);
    check_alike(features_of(s.write("time,sensor (mm/s²)", {s.time, times(s.sensor, 1e3)})), plain,
                1e-9);
    check_alike(features_of(s.write("time,sensor", {s.time, times(s.sensor, 1.0 / 9.80665)}),
                            "--sensor-unit g"),
                plain, 1e-9);
    const Outcome outcome = features(s.write("time,sensor [parsec]", {s.time, s.sensor}));
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("unknown unit parsec; known units are m/s^2, mm/s^2, cm/s^2, um/s^2"));
}

TEST_CASE("The options for the unit take precedence over the file, with a note") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
    const std::string volts = s.write("time,sensor [V]", {s.time, times(s.sensor, 0.1 / 9.80665)});
    const Outcome refused = features(volts);
    CHECK(refused.code == 2);
    CHECK(refused.mentions("column sensor: unit V is that of a voltage"));
    CHECK(refused.mentions("give --sensor-sensitivity"));
    check_alike(features_of(volts, "--sensor-sensitivity '100 mV/g'"), plain, 1e-9);
    const Outcome wrong = features(volts, "--sensor-sensitivity 100");
    CHECK(wrong.code == 2);
    CHECK(wrong.mentions("--sensor-sensitivity 100: is not a voltage per acceleration"));
    const std::string path = s.write("time,sensor [V]", {s.time, s.sensor});
    const std::string note = "the file states V; taken as m/s^2 (--sensor-unit)";
    CHECK(features(path, "--sensor-unit m/s^2").mentions("note: column sensor: " + note));
    const Outcome json = features(path, "--sensor-unit m/s^2 --json -");
    REQUIRE(json.code == 0);
    const auto found = nlohmann::json::parse(json.output);
    check_alike(found["features"], plain, 1e-9);
    REQUIRE(found["notes"].size() == 1);
    CHECK(found["notes"][0] == "column sensor: " + note);
    const Outcome many = features(path + " " + path, "--sensor-unit m/s^2 --csv -");
    CHECK(many.mentions("and 1 more: column sensor: " + note));
    // Latin-1, as recorders under Windows write it.
    check_alike(features_of(s.write("time,sensor [m/s\xB2]", {s.time, s.sensor})), plain, 1e-9);
}

TEST_CASE("A stated sampling rate that is not used is reported") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
    const std::string path = s.folder.file("r.h5");
    {
        const auto file = mc::create_file(path);
        const auto run = mc::create_group(file.get(), "run");
        mc::write_numbers(run.get(), "sensor", {s.sensor.size(), 1}, s.sensor);
        mc::write_numbers(run.get(), "time", {s.time.size()}, s.time);
        mc::write_number(file.get(), ".", "fs", 99.0);
    }
    check_alike(features_of(path), plain, 1e-9);
    const Outcome by_time = features(path);
    CHECK(by_time.mentions("note: column sensor is run/sensor"));
    CHECK(by_time.mentions(
        "the file states a sampling rate of 99 Hz; taken as 280 Hz (column time)"));
    check_alike(features_of(path, "--sampling-Hz 280"), plain, 1e-9);
    CHECK(features(path, "--sampling-Hz 280").mentions("taken as 280 Hz (--sampling-Hz)"));
    CHECK(features(path, "--sensor run/acc").mentions("its columns are run/sensor ("));
}

TEST_CASE("Decimal commas are accepted if the fields are not separated by commas") {
    const Simulated s;
    const std::string path = s.write("time,sensor", {s.time, s.sensor});
    const auto plain = features_of(path);
    std::string text = bytes_of(path);
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '.', ',');
    write_bytes(path, "\xEF\xBB\xBF" + text);
    check_alike(features_of(path), plain, 1e-9);
}

TEST_CASE("Rounded times are recognized as a constant rate") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
    std::vector<double> rounded = s.time;
    for (double& value : rounded) {
        value = std::round(value * 1e3) / 1e3;  // a quarter of a sample interval
    }
    const auto found = features_of(s.write("time,sensor", {rounded, s.sensor}));
    for (const char* name : {"sensor_rms", "window_ratio", "crest_factor", "fm4", "energy_ratio"}) {
        INFO(name);
        CHECK(found[name].get<double>() == Approx(plain[name].get<double>()).epsilon(2e-3));
    }
}

TEST_CASE("Gaps in time, decreasing times and clipped samples are reported") {
    const Simulated s;
    auto time = s.time, sensor = s.sensor;
    time.erase(time.begin() + 100, time.begin() + 103);
    sensor.erase(sensor.begin() + 100, sensor.begin() + 103);
    Outcome outcome = features(s.write("time,sensor", {time, sensor}));
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("between sample 100 and the next"));
    CHECK(outcome.mentions("3 sample(s) are missing"));
    time = s.time;
    std::swap(time[50], time[51]);
    outcome = features(s.write("time,sensor", {time, s.sensor}));
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("evenly spaced"));
    const double largest = *std::max_element(s.sensor.begin(), s.sensor.end());
    sensor = s.sensor;
    for (double& value : sensor) {
        value = std::clamp(value, -0.3 * largest, 0.3 * largest);
    }
    outcome = features(s.write("time,sensor", {s.time, sensor}));
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("column sensor: clipped: "));
}

TEST_CASE("Lost samples without a gap in the times are detected, or reported as undetectable") {
    const Simulated s;
    const auto plain = features(s.write("sensor", {s.sensor}), "--sampling-Hz 280 --json -");
    INFO(plain.output);
    REQUIRE(plain.code == 0);
    CHECK(nlohmann::json::parse(plain.output)["losses_noticed"] == true);
    for (const long lost : {1L, 3L, 5L}) {
        auto sensor = s.sensor;
        sensor.erase(sensor.begin() + 1800, sensor.begin() + 1800 + lost);
        const Outcome outcome = features(s.write("sensor", {sensor}), "--sampling-Hz 280");
        INFO(outcome.output);
        CHECK(outcome.code == 2);
        CHECK(outcome.mentions("which the times do not show"));
        // Expected in turn 7 of 35 mesh periods, or one turn earlier or later.
        CHECK(outcome.mentions("after mesh period 1"));
        CHECK(features(s.write("sensor", {sensor}), "--sampling-Hz 280 --speed stated").code == 0);
    }
    // Four turns of the carrier are too few.
    const std::vector<double> part(s.sensor.begin(), s.sensor.begin() + 4L * 35 * 8);
    const Outcome few = features(s.write("sensor", {part}), "--sampling-Hz 280");
    INFO(few.output);
    CHECK(few.code == 0);
    CHECK(few.mentions("lost samples cannot be detected"));
}

TEST_CASE("A speed error of 2 % is detected, and the speed can be taken from the mesh lines") {
    const Simulated s;
    for (const double wrong : {0.98, 1.02}) {
        const std::string path = s.write("time,sensor", {times(s.time, 1.0 / wrong), s.sensor});
        const Outcome outcome = features(path);
        INFO(outcome.output);
        CHECK(outcome.code == 2);
        CHECK(outcome.mentions("times the stated speed"));
        CHECK(features(path, "--speed stated").code == 0);
    }
    // Three mesh harmonics do not distinguish a mesh line from its neighbours.
    CHECK(features(s.write("time,sensor", {times(s.time, 1.0 / 1.02), s.sensor}), "--speed found")
              .mentions("too few to determine the speed"));
    const std::string finer = " --set sensor.sampling_Hz=560 --set sensor.low_pass_Hz=240";
    const Simulated fine(finer);
    const auto expected = features_of(fine.write("time,sensor", {fine.time, fine.sensor}), finer);
    for (const double wrong : {0.98, 1.02}) {
        const auto found =
            features_of(fine.write("time,sensor", {times(fine.time, 1.0 / wrong), fine.sensor}),
                        finer + " --speed found");
        // Content near half the sampling rate is lost in resampling (resampling.hpp).
        CHECK(found["window_ratio"].get<double>() ==
              Approx(expected["window_ratio"].get<double>()).epsilon(0.05));
    }
}

TEST_CASE("A tachometer's pulses give the mesh phase, and a missing pulse is reported") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
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
    CHECK(counted["sensor_rms"].get<double>() ==
          Approx(plain["sensor_rms"].get<double>()).epsilon(1e-2));
    CHECK(counted["window_ratio"].get<double>() ==
          Approx(plain["window_ratio"].get<double>()).epsilon(2e-2));
    const Outcome outcome =
        features(s.write("time,sensor,tacho", {s.time, s.sensor, missing}), options);
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("one is missing or superfluous"));
    CHECK(features(s.write("time,sensor", {s.time, s.sensor}), "--tachometer tacho")
              .mentions("no column tacho"));
}

TEST_CASE("An encoder's angle gives the mesh phase: coarse, reset each turn or decreasing") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
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
        const auto tracked = features_of(path, "--encoder angle");
        for (const char* feature : {"sensor_rms", "window_ratio"}) {
            INFO(path << " " << feature);
            CHECK(tracked[feature].get<double>() ==
                  Approx(plain[feature].get<double>()).epsilon(within));
        }
    };
    check(by("angle [turns]", fine), 1e-6);
    check(by("angle [deg]", wrapped), 1e-6);
    check(by("angle [turns]", counts), 2e-2);
    const Outcome outcome = features(by("angle [turns]", back), "--encoder angle");
    CHECK(outcome.code == 2);
    CHECK(outcome.mentions("turns back by 0.6"));
    CHECK(outcome.mentions("from sample 700 to the next"));
    CHECK(features(by("angle [parsec]", fine), "--encoder angle").mentions("unknown unit"));
    CHECK(features(by("other", fine), "--encoder angle").mentions("no column angle"));
}

TEST_CASE("An encoder or a mesh phase that jumps ahead is refused with the time and the size") {
    const Simulated s;
    constexpr double kTurn = 35.0 * 8.0;  // in samples
    for (const double jump : {0.005, 0.1, 0.49}) {
        std::vector<double> angle, phase;
        for (std::size_t i = 0; i < s.time.size(); ++i) {
            angle.push_back(static_cast<double>(i) / kTurn + (i >= 700 ? jump : 0.0));
            phase.push_back(35.0 * angle.back());
        }
        Outcome outcome = features(s.write("time,sensor,angle [turns]", {s.time, s.sensor, angle}),
                                   "--encoder angle");
        INFO(outcome.output);
        CHECK(outcome.code == 2);
        CHECK(
            outcome.mentions("column angle: jumps ahead by " + std::to_string(jump).substr(0, 3)));
        CHECK(outcome.mentions("turn at sample 701"));
        CHECK(outcome.mentions("(2.5 s)"));
        outcome = features(s.write("mesh_phase,sensor", {phase, s.sensor}));
        CHECK(outcome.code == 2);
        CHECK(outcome.mentions("column mesh_phase: jumps by"));
    }
}

TEST_CASE("Times of single precision and of six digits, and Unix times, are even") {
    const Simulated s;
    const auto plain = features_of(s.write("time,sensor", {s.time, s.sensor}));
    std::vector<double> unix_time = s.time, single = s.time;
    for (std::size_t i = 0; i < s.time.size(); ++i) {
        unix_time[i] += 1.7e9;
        single[i] = static_cast<float>(s.time[i] + 64.0);
    }
    check_alike(features_of(s.write("time,sensor", {unix_time, s.sensor})), plain, 1e-4);
    check_alike(features_of(s.write("time,sensor", {single, s.sensor}, 9)), plain, 1e-4);
    check_alike(features_of(s.write("time,sensor", {s.time, s.sensor}, 6)), plain, 1e-3);
}

TEST_CASE("A recording is compared with a results file in one sentence") {
    const Folder folder;
    const std::string study = kSmall +
                              " --set ensemble.threshold_instances=60 "
                              "--set detection.false_alarm_rate=0.05 "
                              "--set 'features.use=[\"window_ratio\",\"sensor_rms\"]'";
    REQUIRE(program("run " + study + " --quiet --out " + folder.file("p.h5")).code == 0);
    const Simulated s;  // with half of a tooth's stiffness lost
    const std::string path = s.write("time,sensor", {s.time, s.sensor});
    const Outcome outcome = features(path, "--against " + folder.file("p.h5") + " --json -");
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto against = nlohmann::json::parse(outcome.output)["against"];
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
    const Outcome other = program("features " + path + " --study " + kSmall +
                                  " --set gearbox.planets=4 --set gearbox.sun.teeth=15 --set "
                                  "gearbox.ring.teeth=37 --against " +
                                  folder.file("p.h5"));
    CHECK(other.code == 2);
    CHECK(features(path, "--feature window_ratio").mentions("is only used with --against"));
    CHECK(features(path, "--feature fm4 --against " + folder.file("p.h5")).code == 2);
}

TEST_CASE("Ten million rows are processed in bounded time and memory") {
    const Folder folder;
    const std::string path = folder.file("long.csv");
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
    const Outcome outcome =
        shell(test::within_memory(2000000) + "timeout 120 " + std::string(GEARPOD_PROGRAM) +
              " features " + path + " --study " + kSmall + " --sampling-Hz 280 --speed stated");
    INFO(outcome.output);
    CHECK(outcome.code == 0);
    CHECK(outcome.mentions("mesh periods: 1250000 of acceleration"));
}

}  // namespace

}  // namespace test_real_recordings
