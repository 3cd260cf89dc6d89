// Checks the output of describe about members, fault sizes, omitted damping, rigid bodies and tooth
// contact.
#include "mc/report/description/describe.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_describe_gearbox {

using namespace test;

const std::string kDescribe =
    "describe " + std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/small.toml ";

// 13/11/35 teeth of 4 mm, 200 N m on the sun, carrier at 60 rpm. Expected: 60 (1 + 35/13) and 60 (1
// - 35/11) rpm (Willis), 200 times 35/13 and 48/13 (balance of torques), three pins at 48 mm.
TEST_CASE("describe shows torque and speed of every member") {
    const auto description = require_success(kDescribe);
    check_mentions(description,
                   {"221.538 rpm, 200 N m (input)",
                    "-130.909 rpm, -190.909 rpm relative to the carrier, 5.128 kN on each pin",
                    "stationary, 538.462 N m (fixed)", "60 rpm, 738.462 N m (output)"});
    CHECK(!description.mentions("\n  damping "));
}

TEST_CASE("The description of a study fits 80 columns") {
    // Slow gearboxes turn faster here: their mesh periods then have fewer steps.
    const std::string faster = " --set operation.carrier_speed_rpm=60";
    for (const std::string& words : {study("planet-life.toml") + faster, study("gusts.toml"),
                                     study("planet-crack.toml") + faster}) {
        const auto description = require_success("describe " + words +
                                                 " --set ensemble.instances=8 --set "
                                                 "ensemble.threshold_instances=20");
        // The resolved study before this text is TOML, whose inline tables cannot be broken.
        const std::size_t begin = description.output.find("\nfalse alarms\n");
        REQUIRE(begin != std::string::npos);
        std::istringstream lines(description.output.substr(begin));
        for (std::string line; std::getline(lines, line);) {
            INFO(line);
            CHECK(line.size() <= 80);
        }
    }
}

TEST_CASE("describe shows the graded steps of a study and the error of their pilot") {
    const auto description = require_success("describe " + study("published/tian-fig-4-9.toml") +
                                             " --set numerics.grid='\"graded\"'");
    check_mentions(description, {"signal error ", " after a transition, "});
}

TEST_CASE("describe states which damping is omitted") {
    const auto description = require_success(kDescribe +
                                             "--set gearbox.support_damping_N_s_m=0 --set "
                                             "gearbox.sun.bearing_damping_N_s_m=0 --set "
                                             "gearbox.ring.bearing_damping_N_s_m=0");
    CHECK(description.mentions("0 for bearings of sun and ring, support of the ring"));
    // Random damping counts as damping.
    const auto drawn =
        require_success(kDescribe +
                        "--set gearbox.support_damping_N_s_m=0 --set "
                        "'random.gearbox.support_damping_N_s_m={distribution=\"uniform\","
                        "low=1e3,high=2e3}'");
    CHECK(!drawn.mentions("\n  damping "));
}

// Fault sizes in the file's unit and as shares of the largest. Source: Liang (2016), Fig. 3.14; a
// crack at 45 degrees exits the planet's tooth after 8.60 mm, of which 4.3 mm are half (with a
// module of 3.2 mm; 3.175 here). Rigid gear bodies, unlike elastic ones, have a line that compares
// the meshes with ISO 6336-1.
TEST_CASE("describe shows sizes of the fault, and what rigid bodies and lasting contact mean") {
    const auto description =
        require_success("describe " + study("planet-crack-ideal.toml") +
                        " --set ensemble.instances=7 --set ensemble.threshold_instances=1");
    check_mentions(description, {"0.5, 1, 1.5, 2, 3, 4.28 mm; 5.83, 11.7, 17.5, 23.3, 35, 49.9 %",
                                 "sun-planet 2.29, ring-planet 2.26 times the mean of ISO 6336-1"});
    CHECK(!description.mentions("out of contact"));
    CHECK(!description.mentions("time step error"));
    const auto elastic =
        require_success("describe " + study("bell-206b.toml") +
                        " --set ensemble.instances=5 --set ensemble.threshold_instances=1");
    CHECK(!elastic.mentions("rigid gear bodies"));
}

TEST_CASE("Without --full, describe prints one screen that ends with the forecast") {
    for (const char* name : {"planet-crack.toml", "planet-crack-ideal.toml", "planet-life.toml",
                             "wind-turbine-train.toml", "published/tian-fig-4-9.toml"}) {
        INFO(name);
        const Outcome described = require_success(
            shell("cd " GEARPOD_SOURCE_DIR " && " GEARPOD_PROGRAM " describe studies/" +
                  std::string(name) + measuring_for(1)));
        std::istringstream lines(described.output);
        std::size_t count = 0;
        for (std::string line; std::getline(lines, line); ++count) {
            CHECK(line.size() <= 80);
        }
        CHECK(count <= 40);
        check_mentions(described, {"\n  teeth ", "\n  effects simulated: ", " --full\n"});
        CHECK((described.mentions("\n  estimated time ") ||
               described.mentions("\n  time integration ")));
    }
}

// Checks that describe names the effects that a scene does not need.

TEST_CASE("describe names effects that change nothing and those that a study lacks") {
    const auto description =
        require_success("describe " + study("published/tian-fig-4-9.toml") + " --seconds 30");
    CHECK(description.mentions("what the effects change"));
    // Constant forces on a stage whose stiffness varies in the mesh alone; the features are those
    // of the vibration.
    check_mentions(description,
                   {"omitted, not needed: ", "no feature changes by more than 1 %",
                    "extended contact", "omitted; would change", "shear of the teeth"});
    // With a tolerance above all changes no effect is needed.
    check_mentions(program("describe " + study("published/tian-fig-4-9.toml") +
                           " --seconds 30 --set numerics.tolerance=0.9"),
                   {"no feature changes by more than 90 %", "simulated, not needed: "});
}

TEST_CASE("describe measures effects on short records where every mesh period is integrated") {
    check_mentions(
        require_success("describe " + study("published/yang-pitch-errors.toml") + measuring_for(3) +
                        " --set ensemble.instances=8 --set ensemble.threshold_instances=20"),
        {"s: 3 turns of ", "tooth errors"});
}

// Checks the study that `describe` prints: short lines with the same meaning.

using namespace tests;

TEST_CASE("A wrapped study has short lines and the same meaning") {
    const Study reading = gearpod::test::valid_study(read_study_text(
        kExampleStudy, "study.toml",
        {"random.operation.torque_N_m = {distribution='truncated-normal', mean=400, sd=20, "
         "low=369.123456789, high=489.123456789}",
         "features.use=['te_rms', 'te_kurtosis', 'te_fc', 'te_fm0', 'sensor_rms', 'window_ratio', "
         "'window_z']"}));
    const std::string text = resolved_text(reading), wrapped = wrapped_study(text);
    INFO(wrapped);
    CHECK(contains(wrapped, "operation.torque_N_m.sd = 20\n"));
    std::istringstream lines(wrapped);
    for (std::string line; std::getline(lines, line);) {
        CHECK((line.size() <= 80 || line.starts_with("title = ")));
    }
    const Study again = gearpod::test::valid_study(read_study_text(wrapped, "study.toml", {}));
    CHECK(again == reading);
}

TEST_CASE("Short lines and long strings of a study stay as they are") {
    const std::string text = "title = \"" + std::string(90, '{') + "\"\n\n[a]\nb = [1, 2]\n";
    CHECK(wrapped_study(text) == text);
    CHECK(wrapped_study("k = [\"" + std::string(40, ',') + "\", \"\\\\\", \"" +
                        std::string(40, ']') + "\"]\n") == "k = [\n    \"" + std::string(40, ',') +
                                                               "\", \"\\\\\",\n    \"" +
                                                               std::string(40, ']') + "\",\n]\n");
}

}  // namespace gearpod::mc::test_describe_gearbox
