// Checks gearpod new planetary: a study from a datasheet.
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/rules.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study/new/gear_sets.hpp"

namespace gearpod::mc::test_new_planetary {

using namespace gearpod::test;

mc::PlanetaryDatasheet wind_turbine() {
    mc::PlanetaryDatasheet data = teeth(21, 39, 99, 3, 12);
    data.input = "carrier";
    data.torque_N_m = 800e3;
    data.speed_rpm = 18;
    return data;
}

// Problems of a datasheet, one per line; none if it gives a study.
std::string problems_of(const mc::PlanetaryDatasheet& data) {
    const mc::NewStudy made = new_planetary(data, "new planetary");
    CHECK(made.text.empty() != made.problems.empty());
    return format(made.problems);
}

// The study that a datasheet gives.
mc::Study study_of(const mc::PlanetaryDatasheet& data) {
    INFO(problems_of(data));
    const auto reading = mc::read_study_text(new_planetary(data, "new planetary").text, "s.toml");
    REQUIRE(reading.study);
    return *reading.study;
}

TEST_CASE("A study from a datasheet has its gears, their load and bodies of steel") {
    const mc::Study study = study_of(wind_turbine());
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
    const std::string text = new_planetary(wind_turbine(), "new planetary").text;
    for (const char* word : {"Shigley", "AGMA 2001", "Kraemer", "Kasuba", "ISO 286", "chosen"}) {
        INFO(word);
        CHECK(contains(text, word));
    }
}

TEST_CASE("Power replaces torque or speed") {
    mc::PlanetaryDatasheet data = wind_turbine();
    data.torque_N_m.reset();
    data.power_kW = 1508;
    CHECK(study_of(data).operation.torque_N_m ==
          Approx(1508e3 / (18.0 * M_PI / 30.0)).epsilon(1e-3));

    data.torque_N_m = 1.0;
    CHECK(contains(problems_of(data), "3 of the three are given"));
    data.torque_N_m.reset();
    data.power_kW = -2;
    CHECK(contains(problems_of(data), "--power"));
}

// Mesh frequencies: 567 Hz for the stage of a Bell 206B, 656 Hz for SpectraQuest's rig of 28/36/100
// teeth.
TEST_CASE("Gears with mesh frequencies above 512 Hz have studies") {
    for (const double speed_rpm : {343.8, 3000.0, 60000.0}) {
        INFO(speed_rpm);
        const auto bell = working(teeth(27, 35, 99, 4, 3.175), 0.3, 100.0125);
        const auto sensor = study_of(with_input(bell, "carrier", 250, speed_rpm)).sensor;
        CHECK(sensor.low_pass_Hz == 10000.0);
        CHECK(sensor.encoder_sampling_Hz == sensor.sampling_Hz);
        CHECK(sensor.sampling_Hz >= std::max(60000.0, 12 * 99 * speed_rpm / 60));
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
    const std::string refused = problems_of(data);
    INFO(refused);
    CHECK(contains(refused, "tip circles given"));
    CHECK(contains(refused, "--ring-tip"));
    data.ring_tip_mm = 141;
    CHECK(1e3 * *study_of(data).gearbox.bodies[mc::Member::ring].tip_diameter_m == Approx(141));
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
    const std::string refused = problems_of(data);
    INFO(refused);
    CHECK(refused.find("new planetary: --ring-shift: leaves") == 0);
    CHECK(std::count(refused.begin(), refused.end(), '\n') == 1);
}

TEST_CASE("Impossible geometry is refused with the relevant numbers, all at once") {
    const auto refused = [](const auto& change) {
        mc::PlanetaryDatasheet data = wind_turbine();
        change(data);
        return problems_of(data);
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
    const auto [folder, file] = TemporaryFile("p.toml");
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

// Checks profile shifts and centre distance of `new planetary` and of study files in every
// combination.

// Set of 62/17/96 teeth whose ring and planet were measured: shifts 0.2 and -0.5 give 557.089 mm
// and a sun's shift of 0.1 (rounded).
constexpr double kSun = 0.09995, kPlanet = 0.2, kRing = -0.5, kDistance_mm = 557.089;

mc::PlanetaryDatasheet measured(int subset) {
    mc::PlanetaryDatasheet data = teeth(62, 17, 96, 3, 14);
    data.power_kW = 100;
    data.speed_rpm = 152.9;
    const auto given = [&](int bit, double value) {
        return subset >> bit & 1 ? std::optional(value) : std::nullopt;
    };
    data.sun_shift = given(0, kSun);
    data.planet_shift = given(1, kPlanet);
    data.ring_shift = given(2, kRing);
    data.centre_distance_mm = given(3, kDistance_mm);
    return data;
}

TEST_CASE("Ring and planet shift give the published centre distance and the sun's shift") {
    const mc::Study study = study_of(measured(2 | 4));
    CHECK(1e3 * mc::centre_distance_m(study) == Approx(kDistance_mm).epsilon(1e-6));
    CHECK(mc::gear_of(study, mc::Member::sun).profile_shift == Approx(0.1).margin(1e-3));
    CHECK(mc::working_angle_rad(study, mc::MeshKind::ring_planet) ==
          Approx(21.125 * 3.14159265 / 180).epsilon(1e-4));
}

TEST_CASE("Every determined combination of shifts and centre distance gives the same set") {
    // Two shifts, or one shift and the distance.
    for (const int subset : {3, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15}) {
        INFO(subset);
        const mc::Study study = study_of(measured(subset));
        CHECK(1e3 * mc::centre_distance_m(study) == Approx(kDistance_mm).epsilon(1e-4));
        CHECK(mc::gear_of(study, mc::Member::sun).profile_shift == Approx(kSun).margin(5e-3));
        CHECK(mc::gear_of(study, mc::Member::ring).profile_shift == Approx(kRing).margin(5e-3));
    }
}

TEST_CASE("Contradictory shifts and distances are refused with the values") {
    // A distance 4 mm too large opens the sun mesh by 0.22 modules, 8 mm by 0.4 modules.
    mc::PlanetaryDatasheet data = measured(1 | 2 | 8);
    data.centre_distance_mm = kDistance_mm + 8;
    const std::string open = problems_of(data);
    INFO(open);
    CHECK(contains(open, "--planet-shift: leaves"));
    CHECK(contains(open, "between sun and planets at a centre distance of 565.089 mm"));
    CHECK(contains(open, "leaves none"));
    data.centre_distance_mm = kDistance_mm - 4;
    CHECK(!new_planetary(data, "new planetary").problems.empty());
    // A ring shift that contradicts the other two.
    data = measured(7);
    data.ring_shift = -0.7;
    const std::string ring = problems_of(data);
    INFO(ring);
    CHECK(contains(ring, "--ring-shift: leaves"));
}

using std::numbers::pi;

// Total force of the rollers when their ring is displaced by `shift` mm. Each roller has Palmgren's
// ((shift cos angle) / 7.68e-5)^(1/0.9) l^(8/9), without clearance.
double rollers_N(int rollers, double length_mm, double shift_mm) {
    double sum = 0.0;
    for (int i = 0; i < rollers; ++i) {
        const double cosine = std::cos(2.0 * pi * (i + 0.25) / rollers);
        if (cosine > 0.0) {
            const double load =
                std::pow(shift_mm * cosine / 7.68e-5, 1.0 / 0.9) * std::pow(length_mm, 0.8 / 0.9);
            sum += load * cosine;
        }
    }
    return sum;
}

TEST_CASE("The stiffness of a roller bearing is that of its rollers in parallel") {
    for (const double bore : {0.04, 0.12, 0.35}) {
        const RollerBearing bearing = bearing_in_bore(bore, 0.8 * bore);
        const double length_mm = 1e3 * bearing.roller_length_m;
        for (const double shift_mm : {0.002, 0.01, 0.05}) {
            const double load = bearing.rows * rollers_N(bearing.rollers, length_mm, shift_mm);
            const double more =
                bearing.rows * rollers_N(bearing.rollers, length_mm, 1.001 * shift_mm);
            const double tangent = 1e3 * (more - load) / (0.001 * shift_mm);
            CHECK(bearing.stiffness_N_m(load) == Approx(tangent).epsilon(0.1));
        }
    }
}

// Source: ISO 15, dimension series 22; 2210 is 50 x 90 x 23 mm, 2220 is 100 x 180 x 46, 2240 is 200
// x 360 x 98.
TEST_CASE(
    "A bearing in a bore has the dimensions of a cylindrical roller bearing, and its rollers fit") {
    for (const auto& [outside, inside] :
         {std::pair{90.0, 50.0}, std::pair{180.0, 100.0}, std::pair{360.0, 200.0}}) {
        const RollerBearing bearing = bearing_in_bore(1e-3 * outside, 0.1);
        CHECK(1e3 * bearing.inner_diameter_m == Approx(inside).epsilon(0.03));
        const double roller = 0.14 * outside, circle = 0.77 * outside;
        CHECK(circle - roller > inside);
        CHECK(circle + roller < outside);
        CHECK(bearing.rollers * roller < pi * circle);        // adjacent
        CHECK((bearing.rollers + 4) * roller > pi * circle);  // with few gaps
    }
}

// Source: ISO 286-1, table 1, grade 7; 10 to 18 mm 18 um, 50 to 80 30 um, 120 to 180 40 um, 315 to
// 400 57 um, 800 to 1000 90 um. The standard uses the geometric mean of each step and rounds.
TEST_CASE("The tolerance of grade 7 matches ISO 286's table") {
    for (const auto& [low, high, um] :
         {std::tuple{10.0, 18.0, 18.0}, std::tuple{50.0, 80.0, 30.0},
          std::tuple{120.0, 180.0, 40.0}, std::tuple{315.0, 400.0, 57.0},
          std::tuple{800.0, 1000.0, 90.0}}) {
        CHECK(1e6 * grade_7_tolerance_m(1e-3 * std::sqrt(low * high)) == Approx(um).epsilon(0.05));
    }
}

// A steel ring of 20 and 50 mm radius, 30 mm wide: 197.9 cm^3, 1.554 kg; thin hoops have m r^2.
TEST_CASE("Masses and inertias are those of steel rings") {
    const Annulus ring{0.05, 0.02, 0.03};
    CHECK(ring.mass_kg() == Approx(1.5537).epsilon(1e-3));
    const Annulus hoop{0.1001, 0.1, 0.01};
    CHECK(hoop.inertia_kg_m2() == Approx(hoop.mass_kg() * 0.01).epsilon(2e-3));
    const Annulus disc{0.1, 0.0, 0.01};
    CHECK(disc.inertia_kg_m2() == Approx(0.5 * disc.mass_kg() * 0.01));
}

}  // namespace gearpod::mc::test_new_planetary
