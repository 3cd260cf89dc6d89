// Checks the gear blank factor of ISO 6336-1 against hand calculation and the standard's limits.
#include <catch2/catch.hpp>

#include "stiffness/foundation/gear_blank.hpp"

namespace test_gear_blank {

using gearpod::stiffness::gear_blank_factor;

// A wheel of module 4 mm, 20 mm wide, on a web of 6 mm, its rim 8 mm thick: ln 0.3 = -1.2039728,
// 5 exp(0.4) = 7.4591235.
TEST_CASE("A web of three tenths of the face under two modules of rim leaves 84 %") {
    CHECK(gear_blank_factor(6.0 / 20, 8.0 / 4) == Approx(1 - 1.2039728 / 7.4591235).epsilon(1e-8));
    CHECK(gear_blank_factor(6.0 / 20, 8.0 / 4) == Approx(0.8386).margin(5e-5));
}

TEST_CASE("A web as wide as the face is a disc's, under any rim") {
    for (const double rim : {0.5, 1.0, 3.0, 10.0})
        CHECK(gear_blank_factor(1, rim) == 1);
}

// The standard uses the limit beyond its range: 1 - 1.6094379 / 6.1070138 for the softest.
TEST_CASE("Webs and rims beyond the standard's range count as its limits") {
    CHECK(gear_blank_factor(0.2, 1) == Approx(1 - 1.6094379 / 6.1070138).epsilon(1e-8));
    CHECK(gear_blank_factor(0.05, 1) == gear_blank_factor(0.2, 1));
    CHECK(gear_blank_factor(0.5, 0.3) == gear_blank_factor(0.5, 1));
    CHECK(gear_blank_factor(2, 1) == gear_blank_factor(1.2, 1));
    CHECK(gear_blank_factor(1.2, 1) > 1);
}

TEST_CASE("Thicker webs and rims are stiffer") {
    for (const double rim : {1.0, 2.0, 4.0})
        for (const double web : {0.2, 0.4, 0.7}) {
            CHECK(gear_blank_factor(web + 0.1, rim) > gear_blank_factor(web, rim));
            CHECK(gear_blank_factor(web, rim + 0.5) > gear_blank_factor(web, rim));
        }
}

}  // namespace test_gear_blank
