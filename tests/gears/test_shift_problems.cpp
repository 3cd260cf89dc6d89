// Checks gears that do not mesh, standard teeth, and shifts that are completed without backlash.
#include "gears/mesh_geometry.hpp"
#include "gears/planetary.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_shift_problems {

constexpr double kDegree = std::numbers::pi / 180;

Gear gear(int teeth, double shift = 0) {
    Gear gear{std::abs(teeth), teeth < 0, 2e-3, 20 * kDegree};
    gear.profile_shift = shift;
    return gear;
}

bool contains(const std::vector<std::string>& problems, const std::string& text) {
    return std::ranges::any_of(problems, [&](const auto& p) { return test::contains(p, text); });
}

TEST_CASE("the inverse of the involute function inverts it") {
    for (const double degrees : {0.01, 1.0, 15.0, 20.0, 45.0, 80.0}) {
        CHECK(inverse_involute(involute(degrees * kDegree)) ==
              Approx(degrees * kDegree).epsilon(1e-9));
    }
    CHECK(inverse_involute(0) == 0);
    CHECK(inverse_involute(-1) == 0);
}

TEST_CASE("standard gears at the standard distance keep every bit") {
    for (const auto& [one, two] : {std::pair{19, 31}, std::pair{31, -81}}) {
        const MeshGeometry standard(gear(one), gear(two));
        const double distance = reference_centre_distance(gear(one), gear(two));
        for (const MeshGeometry& given : {MeshGeometry(gear(one, 0.0), gear(two, 0.0)),
                                          MeshGeometry(gear(one), gear(two), distance)}) {
            CHECK(given.contact_ratio() == standard.contact_ratio());
            CHECK(given.pitch_position() == standard.pitch_position());
            CHECK(given.working_pressure_angle() == gear(one).pressure_angle_rad);
            CHECK(given.contact_angle(1, 0.3) == standard.contact_angle(1, 0.3));
            CHECK(given.contact_angle(2, 0.3) == standard.contact_angle(2, 0.3));
        }
    }
    const Gear ring = gear(-81);
    const WorkingShifts set = working_shifts(gear(19), gear(31), &ring, {0.0, 0.0, 0.0});
    CHECK(!set.centre_distance_m);
    CHECK(set.first == 0);
    CHECK(set.second == 0);
    CHECK(set.ring == 0);
    CHECK(set.tip_shortening == 0);
}

TEST_CASE("shifts that cancel keep distance and pressure angle, but move the pitch point") {
    const MeshGeometry standard(gear(19), gear(31)), shifted(gear(19, 0.3), gear(31, -0.3));
    CHECK(shifted.working_pressure_angle() == standard.working_pressure_angle());
    CHECK(shifted.centre_distance() == standard.centre_distance());
    CHECK(shifted.backlash() == Approx(0).margin(1e-15));
    CHECK(shifted.pitch_position() < standard.pitch_position());
    CHECK(shifted.contact_ratio() < standard.contact_ratio());
}

TEST_CASE("missing values of a set's shifts follow from zero backlash") {
    const Gear ring = gear(-99);
    const WorkingShifts set = working_shifts(gear(27), gear(35), &ring, {{}, {}, {}, 63e-3});
    REQUIRE(set.centre_distance_m);
    CHECK(set.first == set.second);
    const MeshGeometry sun(gear(27, set.first), gear(35, set.second), 63e-3);
    const MeshGeometry outer(gear(35, set.second), gear(-99, set.ring), 63e-3);
    CHECK(sun.backlash() == Approx(0).margin(1e-15));
    CHECK(outer.backlash() == Approx(0).margin(1e-15));
    const WorkingShifts fuller = working_shifts(gear(27), gear(35), &ring, {{}, 0.2, 0.1, 63e-3});
    CHECK(fuller.first + fuller.second == Approx(set.first + set.second));
    CHECK(fuller.second == 0.2);
    CHECK(fuller.ring == 0.1);
}

// Source: KISSsoft's report on the second stage of the NREL 5 MW gearbox (test_working_pair.cpp),
// shifts 0.3890, 0.5039 and 0.1171 at 584 mm. Any two of the shifts give the third and the
// distance.
TEST_CASE("two shifts of a set give the third and the centre distance") {
    const auto standard = [](int teeth) {
        Gear coarse = gear(teeth);
        coarse.module_m = 21e-3;
        return coarse;
    };
    const Gear sun = standard(18), planet = standard(36), ring = standard(-93);
    for (const SpecifiedShifts& specified :
         {SpecifiedShifts{0.3890, 0.5039, {}, {}}, SpecifiedShifts{{}, 0.5039, 0.1171, {}},
          SpecifiedShifts{0.3890, {}, 0.1171, {}}}) {
        const WorkingShifts set = working_shifts(sun, planet, &ring, specified);
        REQUIRE(set.centre_distance_m);
        CHECK(1e3 * *set.centre_distance_m == Approx(584).margin(5e-3));
        CHECK(set.first == Approx(0.3890).margin(2e-4));
        CHECK(set.second == Approx(0.5039).margin(2e-4));
        CHECK(set.ring == Approx(0.1171).margin(2e-4));
    }
    // The other shifts follow from the distance and the ring's shift.
    const WorkingShifts set = working_shifts(sun, planet, &ring, {{}, {}, 0.1171, 0.584});
    CHECK(set.first == Approx(0.3890).margin(2e-4));
    CHECK(set.second == Approx(0.5039).margin(2e-4));
}

TEST_CASE("any given shifts of a set without a distance give meshes without backlash") {
    const Gear ring = gear(-99);
    constexpr std::optional<double> kNone;
    for (const std::optional<double>& first : {kNone, std::optional(0.3)})
        for (const std::optional<double>& second : {kNone, std::optional(-0.1)})
            for (const std::optional<double>& outer : {kNone, std::optional(0.4)}) {
                if (first && second && outer)
                    continue;  // overdetermined
                const WorkingShifts set =
                    working_shifts(gear(27), gear(35), &ring, {first, second, outer, {}});
                CHECK(set.first == first.value_or(set.first));
                CHECK(set.second == second.value_or(set.second));
                CHECK(set.ring == outer.value_or(set.ring));
                const MeshGeometry sun(gear(27, set.first), gear(35, set.second),
                                       set.centre_distance_m);
                const MeshGeometry rim(gear(35, set.second), gear(-99, set.ring),
                                       sun.centre_distance());
                CHECK(sun.backlash() == Approx(0).margin(1e-12));
                CHECK(rim.backlash() == Approx(0).margin(1e-12));
            }
}

TEST_CASE("teeth are as thick as the spaces of the mating gear on the pitch circle") {
    // Half of the pitch plus 2 x m tan a0 (ISO 21771), for internal teeth, too.
    for (const int teeth : {23, -71})
        for (const double shift : {-0.2, 0.0, 0.4}) {
            const Gear one = gear(teeth, shift);
            CHECK(one.thickness_at(one.pitch_radius()) ==
                  Approx(2e-3 * (std::numbers::pi / 2 + 2 * shift * std::tan(20 * kDegree)))
                      .epsilon(1e-12));
        }
}

TEST_CASE("gears that cannot be cut or meshed are refused with the relevant numbers") {
    CHECK(contains(undercut_problems(gear(10)),
                   "10 teeth are undercut with a profile shift of 0 (shift by 0.215"));
    CHECK(undercut_problems(gear(14)).empty());
    CHECK(undercut_problems(gear(10, 0.3)).empty());
    CHECK(contains(gear_problems(gear(12, 1.2)), "where it would be -0."));
    Gear inside_out = gear(30);
    inside_out.given_tip_radius_m = inside_out.root_radius() - 1e-3;
    CHECK(contains(gear_problems(inside_out), "does not lie outside the root circle, 55 mm"));
    CHECK(contains(gear_problems(gear(-60, -2)), "the spaces between 60 internal teeth close"));

    // The distance is too small, too large, or below that of the base circles.
    CHECK(contains(mesh_problems(gear(30), gear(40), 69.5e-3), "mm thicker than the pitch"));
    CHECK(contains(mesh_problems(gear(30), gear(40), 65e-3), "base circles, 65.7785 mm"));
    CHECK(contains(mesh_problems(gear(30), gear(40), 73e-3), "the contact ratio of 30 against 40"));
    Gear long_teeth = gear(30);
    long_teeth.given_tip_radius_m = 32.6e-3;
    CHECK(
        contains(mesh_problems(long_teeth, gear(40)),
                 "the tips of 30 teeth run 0.1000 mm into the root circle of 40 teeth (let the tip "
                 "diameter be 65 mm)"));
    CHECK(contains(mesh_problems(gear(18), gear(-60)), "reach below the base circle of 18 teeth"));
    // Source: KHK gear technical reference; without shift tips pass where the tooth numbers differ
    // by 9.
    CHECK(contains(mesh_problems(gear(52), gear(-60)), "overlap those of the 60 internal teeth"));
    CHECK(mesh_problems(gear(52), gear(-61)).empty());
}

TEST_CASE("planets that would overlap are refused by their own tip circles") {
    const PlanetaryTrain train{27, 35, 99, 5};
    CHECK(
        contains(assembly_problems(train, {31.5, 37.1}), "axes 37.03 modules apart, tip diameter"));
    CHECK(!contains(assembly_problems(train, {31.5, 37.0}), "touch"));
    // The rule holds for any small value.
    CHECK(!contains(assembly_problems(train, {31.5, 1e-9}), "touch"));
    CHECK(!contains(assembly_problems(train, {31.5, 0.0}), "touch"));
}

// Source: Bell 206B, 126 positions for four planets; DSTG's description has them at 88.57 and 91.43
// degrees.
TEST_CASE("planets that cannot be spaced equally take the nearest positions") {
    PlanetaryTrain train{27, 35, 99, 4};
    train.positions_rad = nearest_positions(train);
    const PlanetPositions planets = planet_positions(train);
    CHECK(planets.steps == 126);
    CHECK(planets.step == std::vector<int>{0, 32, 63, 95});
    CHECK(assembly_problems(train, {31.5, 37.0}).empty());
    PlanetaryTrain equal{19, 31, 81, 4};
    equal.positions_rad = nearest_positions(equal);
    CHECK(planet_positions(equal).step == std::vector<int>{0, 25, 50, 75});
}

// Rotates a planet in small steps and detects when its flanks cross the line between the axes.
TEST_CASE("the phase of the ring mesh relative to the sun mesh follows from the planet's flanks") {
    const Gear ring = gear(-99);
    const WorkingShifts set = working_shifts(gear(27), gear(35), &ring, {0.4, {}, {}, 63e-3});
    const Gear planet = gear(35, set.second);
    const double sun_angle = working_angle_at(gear(27), planet, 63e-3);
    const double ring_angle = working_angle_at(planet, gear(-99, set.ring), 63e-3);
    const double pitch = 2 * std::numbers::pi / 35;
    const double half_at_sun = planet.half_angle_at(planet.base_radius() / std::cos(sun_angle));
    const double half_at_ring = planet.half_angle_at(planet.base_radius() / std::cos(ring_angle));
    // The sun lies at the angle 0, the ring's contact at pi; the planet rotates in the positive
    // sense. A trailing flank is at 0 at turn 0, so the middle of a tooth is half a tooth ahead.
    double later = -1;
    for (int tooth = 0; tooth < 35; ++tooth) {
        const double leading = half_at_sun + tooth * pitch + half_at_ring;
        const double turn = std::numbers::pi - leading;
        if (turn >= 0 && turn < pitch) {
            later = turn / pitch;
        }
    }
    const PlanetaryTrain train{27, 35, 99, 4};
    CHECK(ring_to_sun_phase(train, planet, sun_angle, ring_angle, PlanetSense::clockwise) ==
          Approx(later).epsilon(1e-10));
    CHECK(ring_to_sun_phase(train, planet, sun_angle, ring_angle, PlanetSense::counter_clockwise) ==
          Approx(1 - later).epsilon(1e-10));
    CHECK(ring_to_sun_phase(train, gear(35), 20 * kDegree, 20 * kDegree, PlanetSense::clockwise) ==
          ring_to_sun_phase(train));
}

// Sum of shifts in excess of the one that fits.
double excess(const Gear& gear_1, const Gear& gear_2, double sum, double distance) {
    return sum - tight_shift_sum(gear_1, gear_2, distance);
}

// Planetary set without backlash.
struct Set {
    Gear sun, planet, ring;
    double x_sun, x_planet, x_ring, distance;
};

Set random_set(std::mt19937& random) {
    const auto teeth = [&](int low, int high) {
        return std::uniform_int_distribution(low, high)(random);
    };
    const auto shift = [&] { return std::uniform_real_distribution(-0.3, 0.6)(random); };
    const int sun = teeth(15, 70), planet = teeth(15, 60);
    const int ring = sun + 2 * planet + teeth(-2, 2);
    Set set{gear(sun), gear(planet), gear(-ring), shift(), shift(), 0, 0};
    set.distance = tight_centre_distance(gear(sun, set.x_sun), gear(planet, set.x_planet));
    set.x_ring = tight_shift_sum(set.planet, set.ring, set.distance) - set.x_planet;
    return set;
}

TEST_CASE("every subset of shifts and centre distance is completed without backlash") {
    std::mt19937 random(47);
    int tried = 0;
    while (tried < 300) {
        const Set set = random_set(random);
        if (base_centre_distance(set.planet, set.ring) >= set.distance ||
            std::abs(set.x_ring) > 2) {
            continue;  // no such ring
        }
        ++tried;
        for (int subset = 0; subset < 16; ++subset) {
            SpecifiedShifts given;
            if (subset & 1) {
                given.first = set.x_sun;
            }
            if (subset & 2) {
                given.second = set.x_planet;
            }
            if (subset & 4) {
                given.ring = set.x_ring;
            }
            if (subset & 8) {
                given.centre_distance_m = set.distance;
            }
            // A ring shift alone is completed with an unshifted sun, for which not every ring has a
            // distance.
            if (subset == 4) {
                continue;
            }
            const WorkingShifts found = working_shifts(set.sun, set.planet, &set.ring, given);
            const double distance =
                found.centre_distance_m.value_or(reference_centre_distance(set.sun, set.planet));
            INFO(set.sun.teeth << "/" << set.planet.teeth << "/" << set.ring.teeth << ", subset "
                               << subset);
            if (base_centre_distance(set.planet, set.ring) < distance) {
                CHECK(excess(set.sun, set.planet, found.first + found.second, distance) ==
                      Approx(0).margin(1e-9));
                CHECK(excess(set.planet, set.ring, found.second + found.ring, distance) ==
                      Approx(0).margin(1e-9));
            }
            // Given values stay.
            CHECK(found.first == Approx(given.first.value_or(found.first)).margin(1e-12));
            CHECK(found.second == Approx(given.second.value_or(found.second)).margin(1e-12));
            CHECK(found.ring == Approx(given.ring.value_or(found.ring)).margin(1e-12));
            // Two shifts, or one and the distance, determine the set.
            const int shifts = (subset & 1) + (subset >> 1 & 1) + (subset >> 2 & 1);
            if (shifts >= 2 || (shifts == 1 && (subset & 8))) {
                CHECK(found.first == Approx(set.x_sun).margin(1e-7));
                CHECK(found.second == Approx(set.x_planet).margin(1e-7));
                CHECK(found.ring == Approx(set.x_ring).margin(1e-7));
                CHECK(distance == Approx(set.distance).epsilon(1e-9));
            }
        }
    }
}

}  // namespace gearpod::gears::test_shift_problems
