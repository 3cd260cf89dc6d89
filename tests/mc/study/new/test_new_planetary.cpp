// Checks gearpod new planetary: a study from a datasheet.
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_new_planetary {

using namespace gearpod::test;

mc::PlanetaryDatasheet wind_turbine() {
    mc::PlanetaryDatasheet data;
    data.sun = 21;
    data.planet = 39;
    data.ring = 99;
    data.module_mm = 12;
    data.input = "carrier";
    data.torque_N_m = 800e3;
    data.speed_rpm = 18;
    return data;
}

std::string all_of(const mc::Problems& problems) {
    return format(problems);
}

TEST_CASE("A study from a datasheet has its gears, their load and bodies of steel") {
    const mc::NewStudy made = new_planetary(wind_turbine(), "new planetary");
    INFO(format(made.problems));
    REQUIRE(made.problems.empty());
    const auto reading = mc::read_study_text(made.text, "s.toml");
    REQUIRE(reading.study);
    const mc::Study& study = *reading.study;
    CHECK(mc::teeth_of(study, mc::Member::ring) == 99);
    CHECK(study.operation.torque_N_m == 800e3);
    CHECK(*study.operation.carrier_speed_rad_s == Approx(18.0 * M_PI / 30.0));
    // A planet of 39 teeth of 12 mm: steel between 468 mm and its bore, 151 mm wide (4 pi 12).
    const mc::MemberValues& planet = study.gearbox.bodies[mc::Member::planet];
    CHECK(*study.gearbox.face_width_m == Approx(0.151));
    const double outer = 0.234, inner = 0.5 * *planet.held_diameter_m;
    CHECK(*planet.mass_kg ==
          Approx(7850.0 * M_PI * (outer * outer - inner * inner) * 0.151).epsilon(1e-3));
    CHECK(inner == Approx(0.219 - 1.2 * 0.027).epsilon(1e-3));
    // Every rule of thumb has its source or is marked as chosen.
    for (const char* word : {"Shigley", "AGMA 2001", "Kraemer", "Kasuba", "ISO 286", "chosen"}) {
        INFO(word);
        CHECK(contains(made.text, word));
    }
}

TEST_CASE("Power replaces torque or speed") {
    mc::PlanetaryDatasheet data = wind_turbine();
    data.torque_N_m.reset();
    data.power_kW = 1508;
    const auto made = new_planetary(data, "new planetary");
    REQUIRE(made.problems.empty());
    const auto study = mc::read_study_text(made.text, "s.toml").study;
    REQUIRE(study);
    CHECK(study->operation.torque_N_m == Approx(1508e3 / (18.0 * M_PI / 30.0)).epsilon(1e-3));

    data.torque_N_m = 1.0;
    CHECK(all_of(new_planetary(data, "c").problems).find("3 of the three are given") !=
          std::string::npos);
    data.torque_N_m.reset();
    data.power_kW = -2;
    CHECK(all_of(new_planetary(data, "c").problems).find("--power") != std::string::npos);
}

// Mesh frequencies: 567 Hz for the stage of a Bell 206B, 656 Hz for SpectraQuest's rig of 28/36/100
// teeth.
TEST_CASE("Gears with mesh frequencies above 512 Hz have studies") {
    for (const double speed_rpm : {343.8, 3000.0, 60000.0}) {
        mc::PlanetaryDatasheet data;
        data.sun = 27;
        data.planet = 35;
        data.ring = 99;
        data.planets = 4;
        data.module_mm = 3.175;
        data.sun_shift = 0.3;
        data.centre_distance_mm = 100.0125;
        data.input = "carrier";
        data.power_kW = 250;
        data.speed_rpm = speed_rpm;
        const mc::NewStudy made = new_planetary(data, "new planetary");
        INFO(speed_rpm << ": " << format(made.problems));
        REQUIRE(made.problems.empty());
        const auto study = mc::read_study_text(made.text, "s.toml").study;
        REQUIRE(study);
        CHECK(study->sensor.low_pass_Hz == 10000.0);
        CHECK(study->sensor.encoder_sampling_Hz == study->sensor.sampling_Hz);
        CHECK(study->sensor.sampling_Hz >= std::max(60000.0, 12 * 99 * speed_rpm / 60));
    }
}

// Tips of unshifted ring teeth reach below the planet's base circle.
TEST_CASE("Tip circles recommended by a message are available as options") {
    mc::PlanetaryDatasheet data;
    data.sun = 40;
    data.planet = 16;
    data.module_mm = 2;
    data.power_kW = 1;
    data.speed_rpm = 500;
    const std::string refused = all_of(new_planetary(data, "new planetary").problems);
    INFO(refused);
    CHECK(contains(refused, "tip circles given"));
    CHECK(contains(refused, "--ring-tip"));
    data.ring_tip_mm = 141;
    const mc::NewStudy made = new_planetary(data, "new planetary");
    INFO(format(made.problems));
    REQUIRE(made.problems.empty());
    const auto study = mc::read_study_text(made.text, "s.toml").study;
    REQUIRE(study);
    CHECK(1e3 * *study->gearbox.bodies[mc::Member::ring].tip_diameter_m == Approx(141));
    // Options of shifts and addenda are passed in the same way.
    data.addendum = 0.9;
    data.sun_shift = 0.1;
    data.ring_shift = -0.1;
    const std::string text = new_planetary(data, "new planetary").text;
    for (const char* key : {"addendum_coefficient = 0.9", "shift = 0.1", "shift = -0.1"}) {
        CHECK(contains(text, key));
    }
}

// Contradicting shifts are one problem, reported with the matching value.
TEST_CASE("Shifts that leave backlash are refused with the matching value") {
    mc::PlanetaryDatasheet data = wind_turbine();
    data.sun_shift = data.planet_shift = 0.1;
    data.ring_shift = -0.4;
    const std::string refused = all_of(new_planetary(data, "new planetary").problems);
    INFO(refused);
    CHECK(refused.find("new planetary: --ring-shift: leaves") == 0);
    CHECK(std::count(refused.begin(), refused.end(), '\n') == 1);
}

TEST_CASE("Impossible geometry is refused with the relevant numbers, all at once") {
    const auto refused = [](const auto& change) {
        mc::PlanetaryDatasheet data = wind_turbine();
        change(data);
        const auto made = new_planetary(data, "new planetary");
        CHECK(made.text.empty());
        return all_of(made.problems);
    };
    const auto ring = refused([](auto& data) { data.ring = 98; });
    CHECK(contains(ring, "--ring"));
    CHECK(contains(ring, "99"));  // the number that is possible
    const auto crowded = refused([](auto& data) { data.planets = 7; });
    INFO(crowded);
    CHECK(contains(crowded, "new planetary: --"));
    CHECK(contains(crowded, "(at most 4 planets)"));
    CHECK(std::count(crowded.begin(), crowded.end(), '\n') == 1);
    const auto undercut = refused([](auto& data) {
        data.sun = 9;
        data.ring = 87;
    });
    CHECK(contains(undercut, "--sun"));
    const auto two = refused([](auto& data) {
        data.ring = 98;
        data.speed_rpm.reset();
    });
    CHECK(std::count(two.begin(), two.end(), '\n') == 2);
    const auto module = refused([](auto& data) { data.module_mm = -3; });
    CHECK(module == "new planetary: --module: must be > 0, but is -3\n");
    const auto huge = refused([](auto& data) { data.planet = 2000000000; });
    CHECK(contains(huge, "--planet: must be between"));
    const auto heavy = refused([](auto& data) { data.torque_N_m = 1e300; });
    CHECK(contains(heavy, "--torque"));
    const auto nothing = refused([](auto& data) {
        data.torque_N_m.reset();
        data.power_kW = 1e-320;
    });
    CHECK(contains(nothing, "--torque"));
}

TEST_CASE("The study written by new is described and run unchanged") {
    const Folder folder;
    const std::string file = folder.file("p.toml");
    const std::string command =
        "new planetary --sun 19 --planet 23 --ring 65 --module 3.2 --torque 429 --speed 400 "
        "--out " +
        file;
    check_mentions(require_success(command), {"gearpod run " + file});
    CHECK(contains(bytes_of(file), "/studies/study.schema.json\n# A planetary gearbox"));
    CHECK(contains(bytes_of(file), "--module 3.2 --torque 429"));
    check_refused(command, {"--force"});
    require_success(command + " --force");

    const auto described = require_success("describe " + file);
    check_mentions(described, {"% of the largest possible size"});
    CHECK(!described.mentions("  damping  "));

    require_success("run " + file +
                    " --quiet --instances 7 --set "
                    "ensemble.threshold_instances=4 --out " +
                    folder.file("p.h5"));
}

TEST_CASE("new refuses inputs that are no gear set and writes nothing") {
    const Folder folder;
    check_refused(
        "new planetary --sun 21 --planet 39 --ring 98 --module 12 --torque 5 "
        "--speed 3 --out " +
            folder.file("p.toml"),
        {"--ring"});
    CHECK(folder.empty());
    check_refused("new bevel --sun 21 --planet 39 --module 12");
}

}  // namespace gearpod::test_new_planetary
