// Checks gearpod features: the features of a measured signal.
#include "features/feature.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "tests/mc/compared_program.hpp"
#include "tests/mc/recording_bytes.hpp"
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_features_command {

using namespace test;

nlohmann::json features_of(const std::string& signal, const std::string& options) {
    return json_of("features " + signal + " --study " + options + " --json -");
}

// Definitions in numpy on stored signals: tests/features/reference/README.md.
TEST_CASE("Every feature equals the numpy result for the same signals") {
    const auto result =
        features_of(kReferenceFolder + "faulty.h5", kSmallStudy + " --healthy " + kReferenceFolder +
                                                        "healthy-1.h5 --healthy " +
                                                        kReferenceFolder + "healthy-2.h5");
    const auto expected = json_of_file(kReferenceFolder + "expected.json");
    CHECK(result["unavailable"].empty());
    for (const features::Feature& feature : features::record_features()) {
        const std::string name(feature.name);
        INFO(name);
        REQUIRE(expected.contains(name));
        const double numpy = expected[name];
        CHECK(std::abs(result["features"][name].get<double>() - numpy) <= 1e-9 * std::abs(numpy));
    }
}

TEST_CASE("A simulated signal read from a file has the features of the simulation") {
    const Folder folder;
    const std::string options =
        kSmallStudy + " --set fault.reduction=0.5 --set 'sensor.noise_levels=[0, 1]'";
    require_success("simulate " + options + " --instance 2 --meshes 455 --out " +
                    folder.file("s.h5"));
    const CsvColumns columns = read_columns(folder.file("s.h5"), "signals",
                                            {"time", "mesh_phase", "sensor_noise_1", "te"});
    // One time base at a time: mesh phase, time, and the rate alone.
    write_csv(folder.file("phase.csv"), "mesh_phase;sensor_noise_1;te",
              {columns[1], columns[2], columns[3]}, 17, ";");
    write_csv(folder.file("time.csv"), "time\tsensor_noise_1\tte",
              {columns[0], columns[2], columns[3]}, 17, "\t");
    const double rate = 1.0 / columns[0][1];
    Named variables{{"sensor_noise_1", columns[2]}, {"te", columns[3]}};
    write_bytes(folder.file("column.mat"), mat_bytes(variables, false));
    variables.emplace_back("sampling_Hz", std::vector{rate});
    write_bytes(folder.file("rate.mat"), mat_bytes(variables, true));
    const std::string noisy = " --sensor sensor_noise_1 --noise-level 1";
    std::map<std::string, double> first;
    for (const std::string& file :
         {folder.file("s.h5"), folder.file("phase.csv"), folder.file("time.csv"),
          folder.file("rate.mat"),
          folder.file("column.mat") + " --sampling-Hz " + std::to_string(rate)}) {
        INFO(file);
        const auto result = features_of(file, options + noisy);
        CHECK(result["unavailable"].empty());
        for (const features::Feature& feature : features::record_features()) {
            const std::string name(feature.name);
            INFO(name);
            // The exported transmission error is the noise-free one.
            const std::size_t level = feature.from_sensor ? 1 : 0;
            const double was = read_columns(folder.file("s.h5"), "features", {name})[0][level];
            const double value = result["features"][name].get<double>();
            const double same = first.try_emplace(name, value).first->second;
            CHECK(std::abs(value - same) <= 1e-9 * std::abs(same));
            // The mean of this simulated signal is 7e-4 of its rms. That of a recording is removed.
            CHECK(std::abs(value - was) <= (level == 1 ? 2e-3 : 1e-9) * std::abs(was));
        }
    }
}

TEST_CASE("All features have the same bits for any lanes, threads, ranks and instruction set") {
    const Folder folder;
    const std::string study = " run " + kSmallStudy +
                              " --quiet --set fault.reduction=0.3 --set ensemble.instances=9"
                              " --set ensemble.threshold_instances=4 --out ";
    require_success(study + folder.file("a.h5"));
    const auto reference = bits(folder.file("a.h5"));
    for (const char* change : {"numerics.lanes=4", "numerics.lanes=1", "numerics.threads=1",
                               "numerics.instruction_set=baseline"}) {
        INFO(change);
        require_success(compared_program(study + folder.file("b.h5") + " --set " + change));
        CHECK(bits(folder.file("b.h5")) == reference);
    }
    require_success(shell(mpirun(2) + GEARPOD_PROGRAM + study + folder.file("c.h5")));
    CHECK(bits(folder.file("c.h5")) == reference);
}

TEST_CASE("A recording at changing speed is resampled with its speed column") {
    // Mesh harmonics only, while the speed rises by a fifth. The sampling rate is ten times higher
    // than the band requires, so that interpolation errors are negligible.
    const Folder folder;
    constexpr double kRate_Hz = 2800.0, kMesh_Hz = 35.0;  // at a carrier speed of 60 rpm
    std::vector<double> speed_rpm, sensor;
    const double seconds = 12.5;
    for (int i = 0; i < static_cast<int>(seconds * kRate_Hz); ++i) {
        const double t = i / kRate_Hz;
        speed_rpm.push_back(60.0 * (1.0 + 0.2 * t / seconds));
        const double phase = kMesh_Hz * (t + 0.1 * t * t / seconds);
        sensor.push_back(std::sin(2.0 * std::numbers::pi * phase) +
                         0.5 * std::sin(4.0 * std::numbers::pi * phase));
    }
    const std::string study = kSmallStudy + " --set sensor.sampling_Hz=2800 --sampling-Hz 2800";
    write_csv(folder.file("speed.csv"), "sensor,speed_rpm", {sensor, speed_rpm});
    write_csv(folder.file("blind.csv"), "sensor", {sensor});
    const auto tracked = features_of(folder.file("speed.csv"), study)["features"];
    CHECK(tracked["energy_ratio"].get<double>() < 1e-3);
    CHECK(tracked["sensor_rms"].get<double>() == Approx(std::sqrt(0.5 * 1.25)).epsilon(1e-3));
    CHECK(tracked["window_ratio"].get<double>() == Approx(1.0).epsilon(1e-3));
    CHECK(!tracked.contains("te_rms"));
    CHECK(features_of(folder.file("blind.csv"), study)["features"]["energy_ratio"] > 0.3);
    // On a coarser grid the study's low-pass leaves 0.97 of the mesh line and 0.27 of the next one.
    const std::string coarse = kSmallStudy + " --set sensor.low_pass_Hz=55 --sampling-Hz 2800";
    CHECK(features_of(folder.file("blind.csv"), coarse)["features"]["sensor_rms"].get<double>() ==
          Approx(std::sqrt(0.5 * (0.97 * 0.97 + 0.25 * 0.27 * 0.27))).epsilon(0.02));
}

TEST_CASE("Every problem of a signal is reported in one message, with exit code 2") {
    const Folder folder;
    const auto refused = [&](const std::string& arguments, const std::string& message) {
        check_refused("features " + arguments + " --study " + kSmallStudy, {message});
    };
    const std::vector<double> eight{0, 1, 2, 3, 4, 5, 6, 7};
    std::vector<double> phase(80), time(80), bad(80, 1.0), good(80, 1.0);
    for (std::size_t i = 0; i < 80; ++i) {
        phase[i] = static_cast<double>(i) / 8.0;
        time[i] = static_cast<double>(i) / 280.0;
    }
    bad[17] = bad[40] = NAN;

    refused(folder.file("none.csv"), "No such file");
    write_bytes(folder.file("a.xls"), "RIFF");
    refused(folder.file("a.xls"), "is not a file that gearpod reads");
    for (const char* name : {"a.h5", "a.mat"}) {
        write_bytes(folder.file(name), "not what the name says");
        refused(folder.file(name), "or is damaged");
        write_bytes(folder.file(name), "not\x01what the name says");
        refused(folder.file(name), "or is damaged");
    }
    write_bytes(folder.file("empty.csv"), "# nothing\n\n");
    refused(folder.file("empty.csv"), "is empty");
    write_bytes(folder.file("bare.csv"), "0.5,0.25\n0.5,0.75\n");
    refused(folder.file("bare.csv"), "its columns are 1, 2; choose with --sensor");
    write_bytes(folder.file("blanks.txt"), "0.5 0.25 7\n0.5 0.75 8\n");
    refused(folder.file("blanks.txt"), "its columns are 1, 2, 3; choose with --sensor");
    write_bytes(folder.file("ragged.csv"), "time,sensor\n0,1\n1\n");
    refused(folder.file("ragged.csv"), ":3: 1 values, but the header names 2 columns");
    write_bytes(folder.file("word.csv"), "time,sensor\n0,1\n1,one\n");
    refused(folder.file("word.csv"), ":3: column sensor: \"one\" is not a number");

    write_csv(folder.file("other.csv"), "mesh_phase,accel", {phase, good});
    refused(folder.file("other.csv"),
            "neither a column sensor nor a column te; its columns are mesh_phase, accel");
    refused(folder.file("other.csv") + " --sensor sensr --te angle",
            "no column sensr; its columns are mesh_phase, accel");
    refused(folder.file("other.csv") + " --sensor sensr --te angle", "no column angle");
    // Before a study is prepared, which may take long.
    const Outcome early = program("features " + folder.file("other.csv") +
                                  " --sensor accel --encoder angle --study none.toml");
    CHECK((early.code == 2 && early.mentions("no column angle") && !early.mentions("none.toml")));
    refused(folder.file("other.csv") + " --sensor accel",
            "too short for every feature: 10 mesh periods of sensor signal and 0 of transmission "
            "error; record at least 11");
    write_csv(folder.file("te.csv"), "mesh_phase,te", {phase, good});
    refused(folder.file("te.csv"), "record at least 11");
    write_csv(folder.file("nan.csv"), "mesh_phase,sensor", {phase, bad});
    refused(folder.file("nan.csv"),
            "column sensor: 2 of 80 samples are not finite, the first is sample 18");
    write_csv(folder.file("rate.csv"), "sensor", {good});
    refused(folder.file("rate.csv"), "no sampling rate");
    refused(folder.file("rate.csv") + " --sampling-Hz 5000", "record at least 11");
    refused(folder.file("rate.csv") + " --sampling-Hz 100", "set sensor.low_pass_Hz to at most ");
    time[50] += 1e-3;
    write_csv(folder.file("uneven.csv"), "time,sensor", {time, good});
    refused(folder.file("uneven.csv"), "the samples must be evenly spaced");
    phase[30] = phase[29];
    write_csv(folder.file("back.csv"), "mesh_phase,sensor", {phase, good});
    refused(folder.file("back.csv"), "the mesh phase does not increase from sample 30 to the next");
    write_bytes(folder.file("long.mat"), mat_bytes({{"sensor", good}, {"te", eight}}, true));
    refused(folder.file("long.mat") + " --sampling-Hz 280",
            "column te has 8 samples, but sensor has 80");
}

// More than a turn of the planet, with 60 samples per mesh period.
std::string hostile(const std::string& path, const std::function<double(double)>& te) {
    CsvColumns columns(2);
    for (int i = 0; i < 60 * 30; ++i) {
        columns[0].push_back(i / 60.0);
        columns[1].push_back(te(i / 60.0));
    }
    return write_csv(path, "mesh_phase,te", columns);
}

TEST_CASE("A feature without a value is reported with its reason, and no number is infinite") {
    const auto [folder, file] = TemporaryFile("x.csv");
    for (const double level : {0.0, 1e-5, -3.0, 1e15}) {
        hostile(file, [&](double) { return level; });
        const auto json = features_of(file, kSmallStudy);
        INFO(level << json.dump(2));
        CHECK(json["features"]["te_rms"] == 0.0);
        for (const char* name : {"te_kurtosis", "te_fc", "te_fm0"}) {
            CHECK(json["unavailable"][name] == "the transmission error is constant");
        }
        const Outcome text = program("features " + file + " --study " + kSmallStudy);
        CHECK_FALSE(text.mentions("nan"));
        CHECK_FALSE(text.mentions("inf"));
    }
    for (const double level : {1e19, 1e200, -1e308}) {
        hostile(file, [&](double at) { return level * std::sin(at); });
        check_refused("features " + file + " --study " + kSmallStudy,
                      {"column te: sample", "are not supported"});
    }
    // Two samples per mesh from the encoders resolve none of its harmonics.
    hostile(file, [](double at) { return 1e-5 * std::sin(0.1 * at); });
    const auto slow = features_of(file, kSmallStudy +
                                            " --set sensor.encoder_sampling_Hz=70 --set "
                                            "'features.use=[\"te_rms\"]'");
    INFO(slow.dump(2));
    CHECK(slow["features"].contains("te_rms"));
    CHECK(std::string(slow["unavailable"]["te_fm0"]).find("no mesh harmonic") == 0);
}

TEST_CASE("A recording's speed is accepted only where it is plausible") {
    const TemporaryFile csv("x.csv");
    const auto recorded = [&](const std::function<double(int)>& rpm) {
        CsvColumns columns(3);
        for (int i = 0; i < 3000; ++i) {
            columns[0].push_back(i / 1000.0);
            columns[1].push_back(1e-5 * std::sin(0.3 * i));
            columns[2].push_back(rpm(i));
        }
        write_csv(csv.path, "time,te,speed_rpm", columns);
        return shell(within_memory(1000000) + std::string(GEARPOD_PROGRAM) + " features " + csv.path +
                     " --study " + kSmallStudy);
    };
    require_success(recorded([](int) { return 20.0; }));
    check_mentions(require_success(recorded([](int) { return -20.0; })), {"backward rotation"});
    check_refused(recorded([](int i) { return i < 1000 ? 20.0 : -20.0; }),
                  {"column speed_rpm: changes its sign at sample 1001"});
    for (const double rpm : {1e6, 1e12, 1e18}) {
        check_refused(recorded([&](int) { return rpm; }), {"do not resolve the mesh frequency"});
    }
}

TEST_CASE("Recordings of a few samples are too short, whatever their format") {
    const auto [folder, file] = TemporaryFile("x.csv");
    for (const char* column : {"sensor", "te"}) {
        for (const int samples : {2, 3, 10, 20}) {
            CsvColumns columns(2);
            for (int i = 0; i < samples; ++i) {
                columns[0].push_back(i / 8.0);
                columns[1].push_back(0.5 + i % 2);
            }
            write_csv(file, std::string("mesh_phase,") + column, columns);
            check_refused("features " + file + " --study " + kSmallStudy,
                          {"too short for every feature: "});
        }
    }
}

// Regression: a name of two gigabytes in a MATLAB 4 file.
TEST_CASE("A MAT file that declares gigabytes is reported as damaged, without allocating them") {
    const auto [folder, file] = TemporaryFile("x.mat");
    write_bytes(file, std::string(19, '\0') + "\x7e\xe4");
    const double before = mc::peak_memory_bytes();
    CHECK_THROWS_AS(mc::open_signal_file(file)->names(), mc::SignalError);
    CHECK(mc::peak_memory_bytes() - before < 500e6);
    check_refused("features " + file + " --study " + kSmallStudy, {"x.mat: "});
}

TEST_CASE("A table of two hundred thousand columns is refused immediately with a short message") {
    const auto [folder, file] = TemporaryFile("x.csv");
    {
        std::ofstream stream(file);
        for (int c = 0; c < 200000; ++c) {
            stream << (c == 0 ? "" : ",") << "c" << c;
        }
        stream << "\n";
        for (int c = 0; c < 200000; ++c) {
            stream << (c == 0 ? "" : ",") << "1";
        }
        stream << "\n";
    }
    const Outcome outcome = check_refused(shell("timeout 10 " + std::string(GEARPOD_PROGRAM) +
                                                " features " + file + " --study " + kSmallStudy),
                                          {"200000 columns; at most 10000 are supported"});
    CHECK(outcome.output.size() < 1000);
}

TEST_CASE("Control characters in file names and titles do not reach the terminal") {
    const Folder folder;
    const std::string file = folder.file("x.csv"), study = folder.file("s.toml");
    write_bytes(file, "mesh_phase,\x1b[31mred\n0,1\n0.1,2\n");
    const Outcome column = check_refused("features " + file + " --study " + kSmallStudy);
    CHECK_FALSE(column.mentions("\x1b"));
    const Outcome option =
        check_refused("features " + file + " --sensor '\x1b[31mred' --study " + kSmallStudy,
                      {"argument 4 (?[31mred) has control characters"});
    CHECK_FALSE(option.mentions("\x1b"));
    for (const char* line : {"title = \"\\u001b[31mred\"\n", "title = \"\\u009b31mred\"\n",
                             "title = \"two\\nlines\"\n", "\"\\u001b[31mred\" = 1\n"}) {
        write_bytes(study, std::string(line) + bytes_of(kSmallStudy));
        const Outcome outcome = check_refused("describe " + study);
        CHECK_FALSE(outcome.mentions("\x1b"));
        CHECK_FALSE(outcome.mentions("\xc2\x9b"));
    }
}

}  // namespace gearpod::test_features_command
