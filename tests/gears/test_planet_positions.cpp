// Checks planets at given positions: assembly, mesh phases and shared teeth.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "gears/planetary.hpp"

namespace test_planet_positions {

using namespace gearpod::gears;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

PlanetaryTrain park_at(std::vector<double> degrees) {
    PlanetaryTrain train{16, 26, 68, static_cast<int>(degrees.size()), {}};
    for (const double position : degrees)
        train.positions_rad.push_back(position * kTurn / 360);
    return train;
}

bool contains(const std::vector<std::string>& problems, const std::string& part) {
    return problems.size() == 1 && problems[0].find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Explicit equal positions give the same phases as default positions") {
    const PlanetaryTrain given = park_at({0, 120, 240});
    const PlanetaryTrain equal{16, 26, 68, 3};
    CHECK(assembly_problems(given).empty());
    for (int n = 0; n < 3; ++n)
        for (const auto sense : {PlanetSense::clockwise, PlanetSense::counter_clockwise}) {
            CHECK(sun_mesh_phase(given, n, sense) == Approx(sun_mesh_phase(equal, n, sense)));
            CHECK(ring_mesh_phase(given, n, sense) == Approx(ring_mesh_phase(equal, n, sense)));
            CHECK(sun_tooth_delay(given, n, sense) == Approx(sun_tooth_delay(equal, n, sense)));
            CHECK(planet_angle(planet_places(given), n) == Approx(kTurn * n / 3));
        }
}

TEST_CASE("Planets a quarter turn apart are in phase on 16/26/68") {
    // Park et al. (2016), Eqs. 1 and 5: 16 / 4 and 68 / 4 are integers.
    const PlanetaryTrain train = park_at({0, 90, 270});
    CHECK(assembly_problems(train).empty());
    for (int n = 0; n < 3; ++n) {
        CHECK(sun_mesh_phase(train, n) == 0);
        CHECK(ring_mesh_phase(train, n, PlanetSense::counter_clockwise) == 0);
    }
}

TEST_CASE("Phases at any position are Parker and Lin's Z psi / 2 pi") {
    const double places = 84;
    const PlanetaryTrain train = park_at({0, 360 * 25 / places, 360 * 51 / places});
    CHECK(assembly_problems(train).empty());
    const auto fraction = [](double phase) { return phase - std::floor(phase); };
    for (int n = 1; n < 3; ++n) {
        const double psi = train.positions_rad[static_cast<std::size_t>(n)];
        CHECK(fraction(sun_mesh_phase(train, n)) == Approx(fraction(16 * psi / kTurn)));
        CHECK(fraction(ring_mesh_phase(train, n)) == Approx(fraction(-68 * psi / kTurn)));
        // The tooth that left planet 0 arrives after the meshes in between, consistent with the
        // phase.
        CHECK(sun_tooth_delay(train, n) == Approx(16 * psi / kTurn));
        CHECK(ring_tooth_delay(train, n) == Approx(68 - 68 * psi / kTurn));
        CHECK(fraction(ring_tooth_delay(train, n)) == Approx(fraction(ring_mesh_phase(train, n))));
    }
}

TEST_CASE("A planet meshes with sun and ring only at the allowed positions") {
    // A sun tooth and a ring tooth that both point at planet 0 lie on one radius. At the next
    // allowed position teeth of both gears coincide again: 1/84 turn further for one more tooth of
    // either.
    CHECK(assembly_problems(park_at({0, 120.00001, 240})).empty());
    CHECK(contains(assembly_problems(park_at({0, 121, 240})), "120.000000 or 124.285714"));
    CHECK(contains(assembly_problems(park_at({0, 360.0 * 14 / 84, 240})), "planets 1 and 2 touch"));
    // Axes 42 sin 30 = 21 modules apart leave no room for tip circles of 28. This is one problem,
    // not six.
    CHECK(contains(assembly_problems(park_at({0, 60, 120, 180, 240, 300})), "(at most 4 planets)"));
    CHECK(contains(assembly_problems(park_at({0, 240, 120})), "does not follow planet 2"));
    CHECK(assembly_problems(park_at({0, 120, 360})).size() ==
          2);  // not below 360; overlaps planet 1
    CHECK(contains(assembly_problems(park_at({360.0 / 84, 120, 240})), "counted from it"));
    PlanetaryTrain two = park_at({0, 120});
    two.planets = 3;
    CHECK(contains(assembly_problems(two), "2 planet positions are given for 3 planets"));
}

}  // namespace test_planet_positions
