#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "gears/planetary.hpp"

namespace test_planetary {

using namespace gearpod::gears;

namespace {

constexpr PlanetaryTrain kLiang{19, 31, 81, 4};
constexpr PlanetaryTrain kPark{16, 26, 68, 3};
constexpr PlanetaryTrain kYang{28, 34, 96, 4};
constexpr PlanetaryTrain kYangRig{32, 40, 112, 3};

}  // namespace

TEST_CASE("mesh phases of 19/31/81 with four planets are Liang's Table 2.2") {
    const double sun[] = {0, 0.75, 0.5, 0.25};
    const double ring[] = {0, -0.25, -0.5, -0.75};
    for (int n = 0; n < 4; ++n) {
        CHECK(sun_mesh_phase(kLiang, n) == sun[n]);
        CHECK(ring_mesh_phase(kLiang, n) == ring[n]);
    }
    CHECK(ring_to_sun_phase(kLiang) == 0);
}

TEST_CASE("Park's phases 68/3 and -16/3 of counter-clockwise planets are 2/3 each") {
    const auto fraction = [](double phase) { return phase - std::floor(phase); };
    constexpr auto kSense = PlanetSense::counter_clockwise;
    CHECK(fraction(ring_mesh_phase(kPark, 1, kSense)) == Approx(2.0 / 3));
    CHECK(fraction(sun_mesh_phase(kPark, 1, kSense)) == Approx(2.0 / 3));
    CHECK(fraction(ring_mesh_phase(kPark, 1, kSense)) == Approx(fraction(68.0 / 3)));
    CHECK(fraction(sun_mesh_phase(kPark, 1, kSense)) == Approx(fraction(-16.0 / 3)));
}

TEST_CASE(
    "Yang's planets are in phase and their ring meshes half a mesh later than their sun meshes") {
    // Source: Yang (2022), Table 3.
    for (int n = 0; n < 4; ++n) {
        CHECK(sun_mesh_phase(kYang, n) == 0);
        CHECK(ring_mesh_phase(kYang, n) == 0);
    }
    CHECK(ring_to_sun_phase(kYang) == 0.5);
}

TEST_CASE("the ring-to-sun phase follows from a planet's flanks laid out around its pitch circle") {
    for (int teeth = 12; teeth < 60; ++teeth) {
        // Angles in pitches: trailing flanks at integers, leading ones half a pitch ahead; the
        // sun's pitch point at 0, the ring's half a turn away. Computes the distance until a
        // leading flank reaches it.
        const double wait = teeth / 2.0 - 0.5;
        CHECK(ring_to_sun_phase({19, teeth, 19 + 2 * teeth, 3}) == wait - std::floor(wait));
    }
}

TEST_CASE("Yang's characteristic frequencies follow from the sun's 25 Hz") {
    const Speeds speeds = train_speeds(kYang, Member::ring, Member::sun, 25);
    CHECK(speeds.carrier == Approx(5.65).margin(0.006));
    CHECK(std::abs(speeds.planet) == Approx(10.29).margin(0.006));
    CHECK(mesh_frequency(kYang, speeds) == Approx(541.94).margin(0.006));
    CHECK(speeds.sun - speeds.carrier == Approx(19.35).margin(0.006));
    CHECK(4 * (speeds.sun - speeds.carrier) == Approx(77.42).margin(0.006));

    const Speeds rig = train_speeds(kYangRig, Member::ring, Member::sun, 10);
    CHECK(mesh_frequency(kYangRig, rig) == Approx(248.89).margin(0.006));
    CHECK(rig.carrier == Approx(2.22).margin(0.006));
    CHECK(rig.sun - rig.carrier == Approx(7.78).margin(0.006));
    CHECK(3 * (rig.sun - rig.carrier) == Approx(23.33).margin(0.006));
}

TEST_CASE("mesh frequencies are Kahraman's for each fixed member") {
    // Source: Liang (2016), Eq. 2.3.9.
    const double s = 19, r = 81;
    const auto frequency = [](Member fixed, Member given) {
        return mesh_frequency(kLiang, train_speeds(kLiang, fixed, given, 3));
    };
    CHECK(frequency(Member::ring, Member::sun) == Approx(3 * s * r / (s + r)));
    CHECK(frequency(Member::sun, Member::ring) == Approx(3 * s * r / (s + r)));
    CHECK(frequency(Member::carrier, Member::sun) == Approx(3 * s));
    CHECK(frequency(Member::carrier, Member::ring) == Approx(3 * r));
}

TEST_CASE(
    "half a planet turn has 15.5 meshes with the carrier fixed, 12.56 at the same sun speed with "
    "the ring fixed") {
    // Source: Liang (2016), Figs. 2.8 and 2.11.
    const Speeds standing = train_speeds(kLiang, Member::carrier, Member::sun, 1);
    const double half_turn = 0.5 / std::abs(standing.planet);
    CHECK(half_turn * mesh_frequency(kLiang, standing) == Approx(15.5));
    const Speeds turning = train_speeds(kLiang, Member::ring, Member::sun, 1);
    CHECK(half_turn * mesh_frequency(kLiang, turning) == Approx(12.56).margin(0.0051));
}

TEST_CASE("no tooth slips: the pitch line velocities of mating gears are equal") {
    for (const Member fixed : {Member::ring, Member::sun, Member::carrier}) {
        const Member given = fixed == Member::ring ? Member::carrier : Member::ring;
        const Speeds v = train_speeds(kLiang, fixed, given, -7);
        CHECK(19 * (v.sun - v.carrier) == Approx(-31 * (v.planet - v.carrier)));
        CHECK(81 * (v.ring - v.carrier) == Approx(31 * (v.planet - v.carrier)));
        CHECK((given == Member::carrier ? v.carrier : v.ring) == Approx(-7));
    }
    CHECK_THROWS_AS(train_speeds(kLiang, Member::ring, Member::ring, 1), std::invalid_argument);
}

TEST_CASE("one carrier turn meets every tooth of the fixed gear once") {
    CHECK(meshes_per_carrier_turn(kLiang, Member::ring) == 81);
    CHECK(meshes_per_carrier_turn(kLiang, Member::sun) == 19);
    CHECK_FALSE(meshes_per_carrier_turn(kLiang, Member::carrier).has_value());
}

TEST_CASE("the published trains can be assembled, and invalid ones give the reasons") {
    for (const auto& train : {kLiang, kPark, kYang, kYangRig})
        CHECK(assembly_problems(train).empty());
    CHECK(assembly_problems({19, 31, 82, 4}).size() == 2);  // ring, spacing
    // Liang's Table 4.3 has modes for 3 and 5 such planets, which cannot be assembled. The number
    // 100 / 3 is no integer, and axes 50 sin 36 = 29.4 modules apart leave no room for tip circles
    // of 33 modules.
    CHECK(assembly_problems({19, 31, 81, 3}).size() == 1);
    const auto crowded = assembly_problems({19, 31, 81, 5});
    REQUIRE(crowded.size() == 1);
    CHECK(crowded[0].find("at most 4 planets") != std::string::npos);
    CHECK(assembly_problems({0, 31, 81, 4}).size() == 1);
}

}  // namespace test_planetary
