// Checks natural frequencies in a turning frame against closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "dynamics/planetary.hpp"
#include "dynamics/rotating_modes.hpp"
#include "tests/dynamics/lin_parker.hpp"

namespace test_rotating_modes {

using namespace gearpod::dynamics;

constexpr double kPi = std::numbers::pi;

// A mass on equal springs in both directions. The turning frame adds its speed to the frequency of
// one whirl and subtracts it from that of the other.
TEST_CASE("A turning frame shifts the frequencies of an isotropic oscillator by its speed") {
    constexpr double kMass = 2.0, kStiffness = 8e4, kNatural = 200.0;  // rad/s
    for (const double speed : {0.0, 30.0, 250.0}) {
        GearboxMatrices m = zero_matrices(2);
        m.mass = kMass * Eigen::MatrixXd::Identity(2, 2);
        m.stiffness = kStiffness * Eigen::MatrixXd::Identity(2, 2);
        m.gyroscopic << 0.0, -2.0 * kMass * speed, 2.0 * kMass * speed, 0.0;
        m.centrifugal = -kMass * speed * speed * Eigen::MatrixXd::Identity(2, 2);
        const auto found = rotating_frequencies_Hz(m);
        REQUIRE(found.size() == 2);
        CHECK(found[0] == Approx(std::abs(kNatural - speed) / (2.0 * kPi)));
        CHECK(found[1] == Approx((kNatural + speed) / (2.0 * kPi)));
    }
}

TEST_CASE("At rest the frequencies are those of the symmetric eigenvalue problem") {
    PlanetaryLayout layout;
    layout.planets = 4;
    layout.pressure_angle_rad = 24.6 * kPi / 180;
    PlanetaryInputs in = test_gearbox::lin_parker_inputs();
    in.carrier_speed_rad_s = 0.0;
    const GearboxMatrices m = assemble(layout, in, std::vector<double>(8, 5e8));
    const auto turning = rotating_frequencies_Hz(m), resting = natural_frequencies_Hz(m);
    REQUIRE(turning.size() == resting.size());
    for (std::size_t i = 0; i < resting.size(); ++i) {
        CHECK(turning[i] == Approx(resting[i]).epsilon(1e-6).margin(1e-3));
    }
}

}  // namespace test_rotating_modes
