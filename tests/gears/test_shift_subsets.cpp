// Checks that every subset of sun, planet and ring shift and centre distance is completed without
// backlash, for random planetary sets.
#include "gears/mesh_geometry.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_shift_subsets {

Gear gear(int teeth, bool internal, double shift = 0) {
    Gear result;
    result.teeth = teeth;
    result.internal = internal;
    result.module_m = 2e-3;
    result.pressure_angle_rad = 20 * std::numbers::pi / 180;
    result.profile_shift = shift;
    return result;
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
    Set set{gear(sun, false), gear(planet, false), gear(ring, true), shift(), shift(), 0, 0};
    set.distance =
        tight_centre_distance(gear(sun, false, set.x_sun), gear(planet, false, set.x_planet));
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

}  // namespace gearpod::gears::test_shift_subsets
