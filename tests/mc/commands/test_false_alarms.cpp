// Checks studies too small for their false-alarm rate: a warning before the run and at the top of
// its report.
#include "tests/mc/program_json.hpp"

namespace gearpod::test_false_alarms {

using namespace test;

const std::string kSmall = study("planet-crack-ideal.toml") +
                           " --set ensemble.threshold_instances=30"
                           " --set ensemble.instances=28 --set sensor.noise_levels=[0,1]"
                           " --set 'features.use=[\"window_ratio\"]'";

TEST_CASE(
    "A sample without a threshold is reported before the run, and no fault counts as missed") {
    const Folder folder;
    const std::string rare = kSmall + " --set detection.false_alarm_rate=0.001";
    check_mentions(program("describe " + rare),
                   {"Too few healthy gearboxes for a false-alarm rate of 0.001: 30",
                    "At least 999 are needed"});
    const std::string results = folder.file("r.h5");
    check_mentions(require_success("run " + rare + " --quiet --out " + results),
                   {"Too few healthy gearboxes"});  // also where only problems are printed
    const Outcome report = program("report " + results + " --full");
    CHECK(report.output.starts_with("Too few healthy gearboxes for a false-alarm rate of 0.001"));
    CHECK(report.mentions("no threshold, so detection is unknown"));
    CHECK(!report.mentions("No tested"));
    CHECK(!report.mentions("not reached"));
    require_success("report " + results + " --html " + folder.file("r.html"));
    const std::string page = bytes_of(folder.file("r.html"));
    CHECK(contains(page, "Too few healthy gearboxes"));
    CHECK_FALSE(contains(page, "No tested"));
    check_mentions(program("compare " + results + " " + results),
                   {"no threshold, so detection is unknown"});
    const auto json = json_of("compare " + results + " " + results + " --json -");
    CHECK(json["files"][1]["shortage"].get<std::string>().starts_with("Too few healthy"));
}

TEST_CASE("A sweep begins with what its healthy samples cannot determine, also on its page") {
    const Folder folder;
    const std::string sweep = "sweep " + kSmall +
                              " --set detection.false_alarm_rate=0.001 --quiet --out " +
                              folder.file("s") + " --vary sensor.noise_m_s2=[1,2]";
    require_success(sweep);
    // Finished points are not computed again; the warning appears again, once.
    const Outcome again = require_success(sweep + " --full --html " + folder.file("s.html"));
    const std::size_t warning_position = again.output.find("Too few healthy gearboxes");
    CHECK(warning_position < again.output.find("smallest fault found"));
    CHECK_FALSE(contains(again.output.substr(warning_position + 1), "Too few healthy gearboxes"));
    const std::string page = bytes_of(folder.file("s.html"));
    CHECK(contains(page, "Too few healthy gearboxes"));
    CHECK(contains(page, "no threshold in 2 of 2 studies"));
    CHECK_FALSE(contains(page, "none in any"));
}

TEST_CASE("A sample that does not determine its rate is reported, one that does is not") {
    check_mentions(program("describe " + kSmall),
                   {"Few healthy gearboxes for a false-alarm rate of 0.05: 30 determine it"});
    const Outcome enough =
        program("describe " + kSmall + " --set ensemble.threshold_instances=100");
    CHECK(!enough.mentions("ew healthy"));
    CHECK(enough.mentions("with 100 healthy gearboxes the true rate is between"));
}

TEST_CASE("Uncertainty left by a calibration is a separate band in text, data and page") {
    const auto [folder, results] = TemporaryFile("r.h5");
    const std::string uncertain =
        study("planet-crack-ideal.toml") +
        " --set ensemble.threshold_instances=60 --set ensemble.instances=300"
        " --set sensor.noise_levels=[1] --set 'features.use=[\"window_ratio\"]'"
        " --set 'random.sensor.noise_m_s2={distribution=\"lognormal\",median=1.5,cv=0.3}'"
        " --set 'detection.uncertain_inputs=[\"sensor.noise_m_s2\"]'";
    require_success("run " + uncertain + " --quiet --out " + results);
    const Outcome report = program("report " + results);
    INFO(report.output);
    CHECK(report.mentions("Unknown for this machine: sensor noise."));
    const auto level =
        json_of("report " + results + " --json -")["reliability"]["features"][0]["levels"][0];
    const auto band = level["uncertain"];
    CHECK(band["inputs"][0] == "noise_m_s2");
    REQUIRE(band["a90_low"]["where"] == "reached");
    // Higher background noise hides larger cracks.
    CHECK(band["a90_low"]["size"].get<double>() < 0.9 * band["a90_high"]["size"].get<double>());
    CHECK(band["band"]["lower"].size() == level["hit_miss"]["band"]["size"].size());
    require_success("report " + results + " --html " + folder.file("r.html"));
    const std::string page = bytes_of(folder.file("r.html"));
    CHECK(contains(page, "Unknown for this machine"));
    check_refused("describe " + study("planet-crack-ideal.toml") +
                      " --set 'detection.uncertain_inputs=[\"sensor.gain\"]'",
                  {"\"sensor.gain\" is not a random input of the gearboxes"});
}

}  // namespace gearpod::test_false_alarms
