// Checks the path of sensors at other places against the symmetry of the carrier's turn.
#include <cstring>

#include "signals/path/transmission_path.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_sensor_position {

constexpr int kPlanets = 4, kPhases = 6, kPositions = 81;
constexpr SpanLayout kLayout{31, 81, kPositions};

PathGrid grid_of(const SensorPosition& sensor, CarrierSense sense = CarrierSense::positive) {
    return {path_window("hamming"),
            gears::planet_positions({.planets = kPlanets}),
            kPhases,
            kLayout,
            sense,
            sensor};
}

double sine_at(const PathGrid& grid, int p, int c) {
    return grid.sine()[p * kPositions + (c + kPositions) % kPositions];
}
double cosine_at(const PathGrid& grid, int p, int c) {
    return grid.cosine()[p * kPositions + (c + kPositions) % kPositions];
}
double window_at(const PathGrid& grid, int p, int c, int n) {
    return grid.window()[(p * kPositions + (c + kPositions) % kPositions) * kPlanets + n];
}
// x - pi of planet n, in whole steps and fractions of a mesh period: m + f.
double steps_at(const PathGrid& grid, int p, int c, int n) {
    const int below = kPositions / 2;
    int m = (c + kPositions) % kPositions - grid.centre()[p * kPlanets + n];
    m += m < -below ? kPositions : m >= kPositions - below ? -kPositions : 0;
    return m + grid.fraction()[p * kPlanets + n];
}

// A third of a turn is 27 of the 81 mesh periods.
TEST_CASE("A sensor at an angle sees the carrier as the first one did that angle earlier") {
    for (const auto sense : {CarrierSense::positive, CarrierSense::negative}) {
        const int shift = sense == CarrierSense::positive ? -27 : 27;
        const PathGrid first = grid_of({}, sense), other = grid_of({.angle_deg = 120.0}, sense);
        for (int p = 0; p < kPhases; ++p) {
            for (int c = 0; c < kPositions; ++c) {
                REQUIRE(sine_at(other, p, c) == Approx(sine_at(first, p, c + shift)).margin(1e-12));
                REQUIRE(cosine_at(other, p, c) ==
                        Approx(cosine_at(first, p, c + shift)).margin(1e-12));
                for (int n = 0; n < kPlanets; ++n) {
                    REQUIRE(window_at(other, p, c, n) ==
                            Approx(window_at(first, p, c + shift, n)).margin(1e-12));
                    REQUIRE(steps_at(other, p, c, n) ==
                            Approx(steps_at(first, p, c + shift, n)).margin(1e-9));
                }
            }
        }
    }
}

TEST_CASE("Planets pass a sensor at any angle where they stand opposite to it") {
    const PathGrid grid = grid_of({.angle_deg = 33.33});
    for (int c = 0; c < kPositions; ++c) {
        const double theta = 2.0 * std::numbers::pi * c / kPositions,
                     beta = 33.33 * std::numbers::pi / 180.0;
        CHECK(sine_at(grid, 0, c) == Approx(std::sin(theta - beta)).margin(1e-12));
        const double x = theta - beta + std::numbers::pi / 2.0;  // planet 2 of 4
        CHECK(window_at(grid, 0, c, 1) == Approx(0.54 - 0.46 * std::cos(x)).margin(1e-12));
        const double turns = x / (2.0 * std::numbers::pi) - 0.5;
        CHECK(steps_at(grid, 0, c, 1) ==
              Approx((turns - std::rint(turns)) * kPositions).margin(1e-9));
    }
}

TEST_CASE("A tangential sensor measures at a right angle, and a gain scales its path") {
    const PathGrid first = grid_of({.angle_deg = 50.0}),
                   other = grid_of({.angle_deg = 50.0, .tangential = true, .gain = 2.5});
    for (int c = 0; c < kPositions; ++c) {
        CHECK(sine_at(other, 1, c) == cosine_at(first, 1, c));
        CHECK(cosine_at(other, 1, c) == -sine_at(first, 1, c));
        CHECK(window_at(other, 1, c, 2) == 2.5 * window_at(first, 1, c, 2));
    }
}

TEST_CASE("Cross-axis sensitivity adds its part of the path at right angles") {
    constexpr double kPart = 0.05;
    const gears::PlanetPositions planets = gears::planet_positions({.planets = kPlanets});
    for (const auto sense : {CarrierSense::positive, CarrierSense::negative}) {
        for (const bool tangential : {false, true}) {
            const SensorPosition along{.angle_deg = 50.0, .tangential = tangential},
                across{.angle_deg = 50.0, .tangential = !tangential},
                both{.angle_deg = 50.0, .tangential = tangential, .cross_axis = kPart};
            const PathGrid a = grid_of(along, sense), b = grid_of(across, sense),
                           sum = grid_of(both, sense);
            for (int c = 0; c < kPositions; ++c) {
                CHECK(sine_at(sum, 1, c) == sine_at(a, 1, c) + kPart * sine_at(b, 1, c));
                CHECK(cosine_at(sum, 1, c) == cosine_at(a, 1, c) + kPart * cosine_at(b, 1, c));
                CHECK(window_at(sum, 1, c, 2) == window_at(a, 1, c, 2));
            }
            // The modal load of an elastic ring.
            const auto ring = [&](const SensorPosition& sensor) {
                return PathGrid(RingLoad{2, RingLoad::Axis::y}, planets, kPhases, kLayout, sense,
                                sensor);
            };
            const PathGrid ring_a = ring(along), ring_b = ring(across), ring_sum = ring(both);
            for (int c = 0; c < kPositions; ++c) {
                CHECK(window_at(ring_sum, 1, c, 2) ==
                      Approx(window_at(ring_a, 1, c, 2) + kPart * window_at(ring_b, 1, c, 2))
                          .margin(1e-15));
            }
        }
    }
}

TEST_CASE("A sensor at the first one's place has the same bits") {
    const PathGrid first(path_window("hamming"), kPlanets, kPhases, kLayout),
        other = grid_of({.gain = 1.0});
    const std::size_t places = std::size_t{kPhases} * kPositions;
    CHECK(std::memcmp(first.sine(), other.sine(), places * sizeof(double)) == 0);
    CHECK(std::memcmp(first.window(), other.window(), places * kPlanets * sizeof(double)) == 0);
}

}  // namespace gearpod::signals::test_sensor_position
