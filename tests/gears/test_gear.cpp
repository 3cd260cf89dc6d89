#include "gears/gear.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_gear {

constexpr double kPressureAngle = 20 * std::numbers::pi / 180;
constexpr double kModule = 3.175e-3;  // 8 teeth per inch of diameter

Gear external(int teeth) {
    return {teeth, false, kModule, kPressureAngle};
}
Gear internal(int teeth) {
    return {teeth, true, kModule, kPressureAngle};
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

}  // namespace gearpod::gears::test_gear
