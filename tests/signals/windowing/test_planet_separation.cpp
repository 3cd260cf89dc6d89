// Checks that the vibration of each planet is recovered from passages that do not overlap.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "signals/windowing/planet_separation.hpp"

namespace test_planet_separation {

using namespace gearpod::signals;

namespace {

constexpr int kTeeth = 11, kCarrier = 36, kPlanets = 3, kPerMesh = 16;
constexpr std::size_t kTurn = kTeeth * kPerMesh, kPath = kCarrier * kPerMesh;
constexpr std::size_t kFirst = 48;  // first sample of a passage of planet 0

// Vibration of a planet in its own turn: meshing, and a small impulse of planet 1.
double vibration(std::size_t planet, std::size_t sample) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(sample) / kPerMesh;
    return std::cos(angle) + (planet == 1 && sample == 70 ? 0.05 : 0.0);
}

// The sensor is reached for two mesh periods of each passage.
std::vector<double> record(int carrier_turns) {
    std::vector<double> samples(static_cast<std::size_t>(carrier_turns) * kPath, 0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (std::size_t planet = 0; planet < kPlanets; ++planet) {
            const std::size_t begin = kFirst + planet * kPath / kPlanets;
            if ((i + kPath - begin) % kPath < 2 * kPerMesh) {
                samples[i] = vibration(planet, i % kTurn);
            }
        }
    }
    return samples;
}

TEST_CASE("Every planet's turn is recovered, with its impulse at its tooth") {
    for (const int turns : {kTeeth, 2 * kTeeth + 5}) {
        const auto averages =
            planet_averages(record(turns), {kTeeth, kCarrier, kCarrier}, kPlanets, kPerMesh);
        REQUIRE(averages.size() == kPlanets);
        for (std::size_t planet = 0; planet < kPlanets; ++planet) {
            INFO("planet " << planet);
            REQUIRE(averages[planet].size() == kTurn);
            for (std::size_t i = 0; i < kTurn; ++i) {
                CHECK(averages[planet][i] == Approx(vibration(planet, i)).margin(1e-12));
            }
        }
    }
}

TEST_CASE("Records without a passage of every tooth have no averages") {
    CHECK(planet_averages(record(kTeeth - 1), {kTeeth, kCarrier, kCarrier}, kPlanets, kPerMesh)
              .empty());
    CHECK(planet_averages(record(kTeeth), {kTeeth, kCarrier, 1}, kPlanets, kPerMesh).empty());
    CHECK(planet_averages(record(12), {12, kCarrier, kCarrier}, kPlanets, kPerMesh).empty());
}

}  // namespace

}  // namespace test_planet_separation
