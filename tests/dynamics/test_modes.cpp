// Checks natural frequencies of Lin and Parker's planetary gears, published in their Table 2 and by
// Liang (2016), Tables 4.2 and 4.3.
#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/planetary.hpp"
#include "tests/dynamics/lin_parker.hpp"
#include "tests/numbers.hpp"

namespace gearpod::dynamics::test_modes {

using test_gearbox::lin_parker_inputs;

PlanetaryLayout lin_parker_layout(int planets) {
    PlanetaryLayout layout;
    layout.planets = planets;
    layout.pressure_angle_rad = 24.6 * std::numbers::pi / 180;
    return layout;
}

std::vector<double> frequencies(const PlanetaryLayout& layout, const PlanetaryInputs& in) {
    const std::vector<double> k(static_cast<std::size_t>(layout.pairs()), 5e8);
    return natural_frequencies_Hz(assemble(layout, in, k));
}

TEST_CASE(
    "Lin and Parker's natural frequencies are reproduced within 0.4 Hz, with their "
    "multiplicities") {
    // Rotational modes are single, translational double, planet modes (N - 3)-fold.
    const std::map<int, std::vector<double>> rotational{
        {3, {0, 1475.7, 1930.3, 2658.3, 7462.8, 11775.3}},
        {4, {0, 1536.5, 1970.6, 2625.6, 7773.6, 13071.1}},
        {5, {0, 1567.4, 2006.1, 2614.8, 8065.4, 14253.1}}};
    const std::map<int, std::vector<double>> translational{
        {3, {743.2, 1102.4, 1896.0, 2276.4, 6986.3, 9647.9}},
        {4, {727.0, 1091.0, 1892.8, 2342.5, 7189.9, 10437.6}},
        {5, {710.0, 1072.4, 1888.1, 2425.3, 7382.3, 11172.3}}};
    const std::vector<double> planet_modes{1808.2, 5963.8, 6981.7};

    for (const int n : {3, 4, 5}) {
        std::vector<double> published = rotational.at(n);
        for (const double f : translational.at(n)) {
            published.insert(published.end(), 2, f);
        }
        for (const double f : planet_modes) {
            published.insert(published.end(), static_cast<std::size_t>(n - 3), f);
        }
        std::sort(published.begin(), published.end());
        const auto ours = frequencies(lin_parker_layout(n), lin_parker_inputs());
        REQUIRE(ours.size() == published.size());
        for (std::size_t i = 0; i < ours.size(); ++i) {
            INFO("N = " << n << ", mode " << i);
            CHECK(ours[i] == Approx(published[i]).margin(0.4));
        }
    }
}

TEST_CASE("Rigid planet bearings reduce the full model's rotations to the torsional model's") {
    PlanetaryLayout layout = lin_parker_layout(4);
    PlanetaryInputs stiff = lin_parker_inputs();
    stiff.bearing_stiffness_N_m[planet] = 1e15;
    for (const int body : {carrier, ring, sun}) {
        stiff.bearing_stiffness_N_m[body] = 1e15;
    }
    auto full = frequencies(layout, stiff);
    layout.motion = Motion::torsional;
    const auto torsional = frequencies(layout, lin_parker_inputs());
    REQUIRE(torsional.size() == 7);
    REQUIRE(full.size() == 21);
    for (std::size_t i = 1; i < torsional.size(); ++i) {
        CHECK(full[i] == Approx(torsional[i]).epsilon(1e-3));
    }
}

}  // namespace gearpod::dynamics::test_modes

// Checks natural frequencies in a turning frame against closed forms.

namespace gearpod::dynamics::test_rotating_modes {

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
    test::check_close(turning, resting, 1e-6, 1e-3);
}

}  // namespace gearpod::dynamics::test_rotating_modes
