// Checks the output of describe about members, fault sizes, omitted damping, rigid bodies and tooth
// contact.
#include "tests/mc/program.hpp"

namespace gearpod::test_describe_gearbox {

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

}  // namespace gearpod::test_describe_gearbox
