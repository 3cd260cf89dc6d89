#include "gears/gear.hpp"
#include "gears/mesh_geometry.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_mesh_geometry {

constexpr double kPi = std::numbers::pi;
constexpr double kPressureAngle = 20 * kPi / 180;
constexpr double kModule = 3.175e-3;  // 8 teeth per inch of diameter

Gear external(int teeth) {
    return {teeth, false, kModule, kPressureAngle};
}
Gear internal(int teeth) {
    return {teeth, true, kModule, kPressureAngle};
}

// Pressure angle arccos(N1 cos a0 / O1B) on gear 1 where gear 2's tip circle intersects the line of
// action, as printed in Tian (2004), Eq. 2.50 (side = +1) and Liang (2016), Eq. 2.2.13 (side = -1).
// Lengths are in half modules.
double printed_start_angle(double n1, double n2, int side) {
    const double tip = n2 + side * 2, centre = n2 + side * n1, cosine = std::cos(kPressureAngle);
    const double angle = std::acos(n2 * cosine / tip) - kPressureAngle;
    return std::acos(n1 * cosine /
                     std::sqrt(tip * tip + centre * centre - 2 * tip * centre * std::cos(angle)));
}

TEST_CASE(
    "Tian's pair of 19 and 48 teeth has contact ratio 1.6456 and spans of 12.232 and 6.715 "
    "degrees") {
    const MeshGeometry mesh(external(19), external(48));
    CHECK(mesh.contact_ratio() == Approx(1.6456).margin(5e-5));
    CHECK((mesh.contact_ratio() - 1) * 360 / 19 == Approx(12.232).margin(1e-3));
    CHECK((2 - mesh.contact_ratio()) * 360 / 19 == Approx(6.715).margin(1e-3));
    // The first pair's alpha_1 passes 0 at 1.292 degrees (Tian, section 2.4).
    const double zero = -mesh.contact_angle_at_start(1) / mesh.contact_angle_rate(1);
    CHECK(zero * 360 / 19 == Approx(1.292).margin(5e-4));
}

TEST_CASE("contact angles of an external pair follow Tian's Eqs. 2.51 and 2.60") {
    const MeshGeometry mesh(external(19), external(48));
    const double inv = involute(kPressureAngle);
    for (const double theta : {0.0, 0.2, 0.5}) {
        const double tau = theta * 19 / (2 * kPi);
        CHECK(mesh.contact_angle(1, tau) ==
              Approx(theta - kPi / 38 - inv + std::tan(printed_start_angle(19, 48, 1))));
        CHECK(mesh.contact_angle(2, tau) ==
              Approx(std::tan(std::acos(48 * std::cos(kPressureAngle) / 50)) - kPi / 96 - inv -
                     19.0 / 48 * theta));
    }
}

TEST_CASE("contact angles of an internal pair follow Liang's Eqs. 2.2.14 and 2.2.31") {
    const MeshGeometry mesh(external(31), internal(81));
    const double inv = involute(kPressureAngle);
    for (const double theta : {0.0, 0.1, 0.35}) {
        const double tau = theta * 31 / (2 * kPi);
        CHECK(mesh.contact_angle(1, tau) ==
              Approx(theta - kPi / 62 - inv + std::tan(printed_start_angle(31, 81, -1))));
        CHECK(mesh.contact_angle(2, tau) ==
              Approx(31.0 / 81 * theta + std::tan(std::acos(81 * std::cos(kPressureAngle) / 79)) +
                     kPi / 162 - inv));
    }
}

TEST_CASE("the ring-planet pair of 31 and 81 teeth has contact ratio 1.9") {
    CHECK(MeshGeometry(external(31), internal(81)).contact_ratio() == Approx(1.9).margin(0.05));
}

TEST_CASE("pitch points match Liang's Eqs. 2.3.5 and 2.3.6") {
    const double slope = std::tan(kPressureAngle);
    CHECK(MeshGeometry(external(31), internal(81)).pitch_position() ==
          Approx((slope - std::tan(printed_start_angle(31, 81, -1))) * 31 / (2 * kPi)));
    CHECK(MeshGeometry(external(19), external(31)).pitch_position() ==
          Approx((slope - std::tan(printed_start_angle(19, 31, 1))) * 19 / (2 * kPi)));
}

TEST_CASE("at the pitch point both teeth are in contact on their pitch circles") {
    for (const bool ring : {false, true}) {
        const Gear second = ring ? internal(81) : external(48);
        const MeshGeometry mesh(external(31), second);
        const double tau = mesh.pitch_position();
        const double roll_1 = mesh.contact_angle(1, tau) + mesh.gear(1).half_base_angle();
        const double sign = ring ? -1 : 1;
        const double roll_2 = mesh.contact_angle(2, tau) + sign * second.half_base_angle();
        CHECK(roll_1 == Approx(std::tan(kPressureAngle)));
        CHECK(roll_2 == Approx(std::tan(kPressureAngle)));
    }
    CHECK(MeshGeometry(external(31), internal(81)).centre_distance() == Approx(25 * kModule));
    CHECK(MeshGeometry(external(19), external(31)).centre_distance() == Approx(25 * kModule));
}

TEST_CASE("contact ends where gear 1's tip circle leaves the line of action") {
    const MeshGeometry mesh(external(19), external(31));
    const Gear sun = mesh.gear(1);
    const double roll = mesh.contact_angle(1, mesh.contact_ratio()) + sun.half_base_angle();
    CHECK(sun.base_radius() * std::hypot(1, roll) == Approx(sun.tip_radius()));
}

TEST_CASE("pairs with contact below a base circle are refused") {
    CHECK(mesh_problems(external(12), external(100)).size() == 1);
    CHECK_THROWS_AS(MeshGeometry(external(12), external(100)), std::invalid_argument);
    CHECK_THROWS_AS(MeshGeometry(internal(81), external(31)), std::invalid_argument);
    CHECK_FALSE(mesh_problems(external(81), internal(31)).empty());
    Gear other = external(31);
    other.module_m *= 2;
    CHECK(mesh_problems(external(19), other).size() == 1);
}

TEST_CASE("Liang's radii follow from module 3.175 mm, not from the 3.2 mm of his tables") {
    // Source: Liang (2016), Table 3.1, in mm with one decimal.
    CHECK(external(19).base_radius() * 1e3 == Approx(28.3).margin(0.05));
    CHECK(external(31).base_radius() * 1e3 == Approx(46.2).margin(0.05));
    CHECK(internal(81).base_radius() * 1e3 == Approx(120.8).margin(0.05));
    CHECK(external(19).root_radius() * 1e3 == Approx(26.2).margin(0.05));
    CHECK(external(31).root_radius() * 1e3 == Approx(45.2).margin(0.05));
    CHECK(internal(81).root_radius() * 1e3 == Approx(132.6).margin(0.05));
    CHECK(Gear{81, true, 3.2e-3, kPressureAngle}.root_radius() * 1e3 > 133);
}

TEST_CASE("the root circle passes the base circle between 41 and 42 teeth") {
    // Source: Liang (2016), section 3.2.1.
    CHECK(external(41).root_radius() < external(41).base_radius());
    CHECK(external(42).root_radius() > external(42).base_radius());
}

TEST_CASE(
    "half an external and half an internal tooth fill a quarter pitch on the base circle each "
    "way") {
    const double quarter_pitch = std::numbers::pi / (2 * 50);
    CHECK(external(50).half_base_angle() - quarter_pitch == Approx(involute(kPressureAngle)));
    CHECK(quarter_pitch - internal(50).half_base_angle() == Approx(involute(kPressureAngle)));
    CHECK(involute(kPressureAngle) ==
          Approx(0.014904).margin(5e-7));  // source: any table of inv 20 degrees
}

TEST_CASE("impossible gears are named with every problem at once") {
    CHECK(gear_problems(external(19)).empty());
    CHECK(gear_problems(internal(81)).empty());
    CHECK(gear_problems({2, false, -1, 0}).size() == 3);
    // Internal full-depth teeth of 20 degrees require (N - 2) >= N cos 20: 34 teeth.
    CHECK(gear_problems(internal(34)).empty());
    CHECK(gear_problems(internal(33)).size() == 1);
    CHECK(gear_problems({19, false, kModule, kPressureAngle, 1.8, 2.0}).size() == 1);  // pointed
}

}  // namespace gearpod::gears::test_mesh_geometry
