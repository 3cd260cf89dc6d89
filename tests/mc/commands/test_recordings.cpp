// Checks gearpod features of many recordings, and the report on them.
#include <sys/stat.h>

#include "mc/results/results_file.hpp"
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_recordings {

using namespace test;

const std::string kSmall = kSmallStudy + " --set detection.false_alarm_rate=0.1";
constexpr int kTeeth = 11, kPerMesh = 8;

// One turn of the planet; all teeth are equal except one that is `worse` times as loud.
std::vector<double> turn(double worse, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise;
    std::vector<double> samples;
    for (int tooth = 0; tooth < kTeeth; ++tooth) {
        for (int i = 0; i < kPerMesh; ++i) {
            samples.push_back(noise(engine) * (tooth == 4 ? worse : 1.0));
        }
    }
    return samples;
}

nlohmann::json single(const std::string& path) {
    return json_of("features " + path + " --study " + kSmall + " --samples-per-mesh 8 --json -");
}

TEST_CASE("One turn of the planet gives the features of its teeth, as many turns do") {
    const Folder folder;
    std::vector<double> once = turn(3.0, 1), many;
    for (int i = 0; i < 35; ++i) {
        many.insert(many.end(), once.begin(), once.end());
    }
    write_csv(folder.file("once.csv"), "sensor [m/s^2]", {once});
    write_csv(folder.file("many.csv"), "sensor [m/s^2]", {many});
    const auto one = single(folder.file("once.csv")), all = single(folder.file("many.csv"));
    CHECK(one["planet_turns"] == 1);
    CHECK(all["planet_turns"] == 35);
    check_alike(one["features"], all["features"], 1e-9,
                {"sensor_rms", "window_ratio", "window_z", "crest_factor", "fm4", "m6a", "m8a",
                 "energy_ratio", "sideband_index", "sideband_level", "window_kurtosis",
                 "window_crest", "window_m8a"});
    CHECK(one["unavailable"].contains("frms"));  // requires carrier turns
    CHECK(one["unavailable"].contains("sun_window_ratio"));
}

struct Recorded {
    Folder folder;
    std::string manifest, results = folder.file("f.h5");
    Outcome measured;  // outcome of the command that writes the results

    Recorded() {
        std::string table = "file,gearbox,time [day],label,size [mm],oil temperature [K]\n";
        for (int i = 0; i < 60; ++i) {
            const double size = i < 30 ? 0.0 : 0.05 * (i - 29);
            const std::string name = "r" + std::to_string(i) + ".csv";
            write_csv(folder.file(name), "sensor [m/s^2]",
                      {turn(1.0 + 1.2 * size, 10U + static_cast<unsigned>(i))});
            table += name + ",A," + std::to_string(i / 10) + "," + (i < 30 ? "healthy" : "faulty") +
                     "," + std::to_string(size) + "," + std::to_string(300 + i) + "\n";
        }
        write_csv(folder.file("unknown.csv"), "sensor [m/s^2]", {turn(9.0, 99)});
        table += "unknown.csv,B,7,,,300\n";
        table += "missing.csv,A,7,,,300\n";
        write_bytes(folder.file("broken.csv"), "sensor\n1\nx\n");
        table += "broken.csv,A,7,,,300\n";
        manifest = folder.file("manifest.csv");
        write_bytes(manifest, table);
        measured = features("--out " + results + " --csv " + folder.file("f.csv"));
    }
    Outcome features(const std::string& options, const std::string& before = "") const {
        return shell(before + " " + std::string(GEARPOD_PROGRAM) + " features --manifest " +
                     manifest + " --study " + kSmall + " --samples-per-mesh 8 " + options);
    }
};

const Recorded& recorded_once() {
    static const Recorded once;
    return once;
}

TEST_CASE("A bad recording is reported and does not stop the others; the exit code is 3") {
    const Recorded& recorded = recorded_once();
    CHECK(recorded.measured.code == 3);
    check_mentions(recorded.measured,
                   {"61 of 63 have features", "missing.csv: cannot be read (No such file",
                    "broken.csv:3: column sensor: \"x\" is not a number"});
    const auto results = mc::read_results(recorded.results);
    REQUIRE(results.group.size() == 61);
    CHECK(results.group[0] == 0);
    CHECK(results.group[59] == 1);
    CHECK(results.group[60] == mc::kNoGroup);
    CHECK(results.request.size.unit == "m");
    // The table has the same numbers as one recording alone.
    const auto alone = single(recorded.folder.file("r50.csv"));
    for (const auto& feature : results.features) {
        CHECK(feature.values[50] == alone["features"][feature.name].get<double>());
    }
    CHECK(std::ranges::count(bytes_of(recorded.folder.file("f.csv")), '\n') == 64);
}

TEST_CASE("Many recordings have the same results for any number of threads") {
    const Recorded& recorded = recorded_once();
    recorded.features("--out " + recorded.folder.file("1.h5"), "OMP_NUM_THREADS=1");
    recorded.features("--out " + recorded.folder.file("3.h5"), "OMP_NUM_THREADS=3");
    CHECK(bits(recorded.folder.file("1.h5")) == bits(recorded.folder.file("3.h5")));
}

TEST_CASE("The report on recordings has thresholds, and POD where sizes are known") {
    const Recorded& recorded = recorded_once();
    const std::string& results = recorded.results;
    const auto json = json_of("report " + results + " --json -");
    const auto& features = json["reliability"]["features"];
    const auto ratio = std::find_if(features.begin(), features.end(), [](const auto& feature) {
        return feature["name"] == "window_ratio";
    });
    REQUIRE(ratio != features.end());
    const auto& level = (*ratio)["levels"][0];
    CHECK(level["auc"]["healthy"] == 30);
    CHECK(level["auc"]["faulty"] == 30);
    CHECK(level["hit_miss"]["refusal"].is_null());
    CHECK(level["hit_miss"]["a90"]["estimate"]["size"].get<double>() < 1.5e-3);
}

TEST_CASE("The report monitors a gearbox's recordings in sequence") {
    const Recorded& recorded = recorded_once();
    const std::string& results = recorded.results;
    const auto monitoring = json_of("report " + results + " --json -")["monitoring"];
    CHECK(monitoring["baseline_records"] == 20);
    CHECK(monitoring["refusal"] == "");
    std::set<std::string> detectors;
    bool found = false;
    for (const auto& one : monitoring["watched"]) {
        // Ten healthy recordings after the baseline: at a rate of 0.1 the largest sets the
        // threshold.
        CHECK(one["healthy"]["alarms"].get<int>() <= 1);
        CHECK(one["healthy"]["recordings"] == (one["detector"] == "2 of 3" ? 9 : 10));
        REQUIRE(one["gearboxes"].size() == 1);  // the other has one recording only
        CHECK(one["gearboxes"][0]["recordings"] == 30);
        if (one["feature"] == "window_ratio") {
            detectors.insert(one["detector"].get<std::string>());
            const auto& first = one["gearboxes"][0]["first"];
            REQUIRE(!first.is_null());
            found = true;
            CHECK(first["row"].get<int>() >= 30);
            CHECK(first["time"].get<double>() >= 3.0);
        }
    }
    CHECK(found);
    CHECK(detectors ==
          std::set<std::string>{"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 100"});
    check_mentions(program("report " + results + " --full"), {"Monitoring over time", "fused"});

    const std::string others = recorded.folder.file("others.h5");
    recorded.features("--set monitoring.baseline_records=25 --out " + others);
    CHECK(program("report " + others + " --full")
              .mentions("5 healthy recordings after the first 25"));
    recorded.features("--set monitoring.torque_regression=true --force --out " + others);
    CHECK(program("report " + others + " --full").mentions("no column torque"));
    check_refused(
        recorded.features("--set 'monitoring.detectors=[\"cusum\",\"single\",\"single\"]' --csv -"),
        {"\"cusum\" is not a detector", "names \"single\" twice"});
}

TEST_CASE("Recordings without gearbox names are monitored as those of one machine") {
    const Folder folder;
    std::string table = "file,gearbox,time,label\n";
    for (int i = 0; i < 30; ++i) {
        const bool te_alone = i >= 20 && i % 2 == 1;
        const std::string name = "r" + std::to_string(i) + ".csv";
        write_csv(folder.file(name), te_alone ? "te [rad]" : "sensor [m/s^2]",
                  {turn(i < 20 ? 1.0 : 50.0, static_cast<unsigned>(i))});
        table += name + (i < 20 ? ",,1,healthy\n" : ",,2,faulty\n");
    }
    write_bytes(folder.file("m.csv"), table);
    const std::string results = folder.file("f.h5");
    program("features --manifest " + folder.file("m.csv") + " --study " + kSmall +
            " --samples-per-mesh 8 --set monitoring.baseline_records=5 --out " + results);
    const auto json = json_of("report " + results + " --json -");
    // Recordings without gearbox names are monitored as one machine, and this is reported.
    CHECK(contains(json["monitoring"]["note"].get<std::string>(), "of one machine"));
    check_mentions(program("report " + results + " --full"),
                   {"are assumed to be of one machine", "5 of 5"});
}

TEST_CASE(
    "On the terminal, recordings are called recordings and have a size only where it is known") {
    const Recorded& recorded = recorded_once();
    const std::string& results = recorded.results;
    const Outcome sized = require_success("report " + results + " --full");
    check_mentions(sized, {"healthy: alarms/recordings", "size mm", "a90/95"});
    CHECK(!sized.mentions(" boxes"));
    CHECK(!sized.mentions("Noise x"));
    CHECK(sized.mentions("Recordings of too few gearboxes for a false-alarm rate of 0.1"));

    std::string table = "file,label\n";
    for (int i = 0; i < 60; ++i) {
        table += recorded.folder.file("r" + std::to_string(i) + ".csv") +
                 (i < 30 ? ",healthy\n" : ",faulty\n");
    }
    write_bytes(recorded.folder.file("labels.csv"), table);
    const std::string by_label = recorded.folder.file("labels.h5");
    require_success("features --manifest " + recorded.folder.file("labels.csv") + " --study " +
                    kSmall + " --samples-per-mesh 8 --quiet --out " + by_label);
    const Outcome labelled = require_success("report " + by_label + " --full");
    check_mentions(labelled, {"label", "Area under the ROC, healthy against faulty"});
    for (const char* word : {"boxes", "size", "a90", "Noise x"}) {
        INFO(word);
        CHECK(!labelled.mentions(word));
    }
}

TEST_CASE("A row of an HDF5 file is a record, with the dataset's scale") {
    const Folder folder;
    const std::vector<double> first = turn(1.0, 1), second = turn(3.0, 2);
    std::vector<double> both = first;
    both.insert(both.end(), second.begin(), second.end());
    for (double& value : both) {
        value /= 4.0;
    }
    {
        const auto file = mc::create_file(folder.file("rows.h5"));
        mc::write_numbers(file.get(), "sensor", {2, first.size()}, both);
        mc::write_number(file.get(), "sensor", "scale", 4.0);
    }
    write_csv(folder.file("second.csv"), "sensor [m/s^2]", {second});
    write_bytes(folder.file("m.csv"), "file,row\nrows.h5,1\nsecond.csv,\nrows.h5,2\n");
    const Outcome outcome = program("features --manifest " + folder.file("m.csv") + " --study " +
                                    kSmall + " --samples-per-mesh 8 --csv -");
    INFO(outcome.output);
    CHECK(outcome.code == 3);
    CHECK(outcome.mentions("sensor has 2 rows, but row 2 is requested"));
    std::istringstream lines(outcome.output);
    std::string header, row, alone;
    std::getline(lines, header);
    while (header.rfind("file,", 0) != 0) {
        std::getline(lines, header);
    }
    std::getline(lines, row);
    std::getline(lines, alone);
    CHECK(row.substr(row.find(",,") + 2) == alone.substr(alone.find(",,,") + 3));
}

TEST_CASE("Invalid manifest entries are reported with their line, all at once") {
    const Folder folder;
    const std::string manifest = folder.file("m.csv");
    const auto refused = [&](const std::string& text) {
        write_bytes(manifest, text);
        return check_refused("features --manifest " + manifest + " --study " + kSmall + " --csv " +
                             folder.file("t.csv"));
    };
    check_mentions(
        refused("file,row,label,size,torque\na.csv,x,,,1\nb.csv,,broken,,1\nc.csv,,healthy,2,1\n"
                "d.csv,,,-1,one\n"),
        {"m.csv:2: row: \"x\" is not a row number",
         "m.csv:3: label: \"broken\" is neither healthy nor faulty",
         "m.csv:4: label: healthy contradicts the size", "m.csv:5: size: is negative",
         "m.csv:5: torque: \"one\" is not a finite number"});
    CHECK(refused("name\na\n").mentions("has no column file"));
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    for (const char* name : {"pipe", "/dev/zero"}) {
        CHECK(refused(std::string("file\n") + name + "\n")
                  .mentions("m.csv:2: file: is not a regular file"));
    }
    CHECK(refused("file,load,load\na.csv,1,2\n").mentions("is the name of two columns"));
    write_bytes(manifest, ",file,label,load [N]\n0,a.csv,healthy,\"1,5\"\n1,=b.csv,NA,2\n");
    program("features --manifest " + manifest + " --study " + kSmall + " --csv " +
            folder.file("t.csv"));
    const std::string table = bytes_of(folder.file("t.csv"));
    CHECK_THAT(table, Catch::StartsWith("file,row,gearbox,label,load [N],"));
    CHECK_THAT(table, Catch::Contains("a.csv,,,healthy,1.5,"));
    CHECK(refused("file\n").mentions("lists no recording"));
}

}  // namespace gearpod::test_recordings
