// Checks growth by Paris' law against closed integrals and against cycle-by-cycle summation.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "stiffness/growth/paris_growth.hpp"

namespace test_paris_growth {

using namespace gearpod;
using namespace gearpod::stiffness;

namespace {

// A crack with the same factor at all depths: K = Y sigma sqrt(pi a) for load sigma.
constexpr double kFactor = 1.12;
double same_factor(double depth) {
    return kFactor * std::sqrt(std::numbers::pi * depth);
}

// Cycles from a to b: P. C. Paris' integral for m != 2, its limit for m = 2.
double closed_cycles(const ParisLaw& law, double stress, double a, double b) {
    const double rate =
        law.factor * std::pow(kFactor * stress * std::sqrt(std::numbers::pi), law.exponent);
    const double p = 1.0 - 0.5 * law.exponent;
    return (p == 0.0 ? std::log(b / a) : (std::pow(b, p) - std::pow(a, p)) / p) / rate;
}

TEST_CASE("Growth with one geometry factor matches the closed integral", "[growth]") {
    const double first = 0.2e-3, last = 4e-3, stress = 150e6;
    for (const double m : {2.0, 2.7, 3.0, 4.0}) {
        INFO(m);
        const ParisLaw law = paris_law_mm_MPa(1e-8, m);
        const ParisGrowth growth(law, same_factor, first, last);
        for (const double depth : {0.21e-3, 0.5e-3, 1e-3, 3.9e-3, 4e-3}) {
            const double cycles = closed_cycles(law, stress, first, depth);
            CHECK(growth.damage_to(depth) ==
                  Approx(growth.damage_of(stress, cycles)).epsilon(1e-9));
            CHECK(growth.depth_after(growth.damage_of(stress, cycles)) ==
                  Approx(depth).epsilon(1e-9));
        }
        CHECK(growth.depth_after(0.0) == first);
        CHECK(std::isnan(growth.depth_after(std::nan(""))));
        CHECK(growth.depth_after(2.0 * growth.damage_to(last)) == last);
    }
}

TEST_CASE("C in mm per cycle at 1 MPa m^1/2 is that rate", "[growth]") {
    const ParisLaw law = paris_law_mm_MPa(6.9e-9, 3.0);
    CHECK(law.factor * std::pow(20e6, 3.0) == Approx(1e-3 * 6.9e-9 * 8000.0));
}

TEST_CASE("Loads in any order have the effect of cycle-by-cycle summation", "[growth]") {
    const ParisLaw law = paris_law_mm_MPa(5e-7, 3.2);
    const auto range = [](double a) { return same_factor(a) * (1.0 + 200.0 * a); };
    const ParisGrowth growth(law, range, 0.5e-3, 5e-3);
    double depth = 0.5e-3, damage = 0.0;
    for (int cycle = 0; cycle < 200'000 && depth < 3e-3; ++cycle) {
        const double stress = 60e6 * (1.0 + 0.3 * std::sin(0.1 * cycle));
        depth += law.factor * std::pow(stress * range(depth), law.exponent);
        damage += growth.damage_of(stress, 1.0);
    }
    REQUIRE(depth > 1e-3);
    // Growth per cycle is at most a thousandth of the depth, and so is the difference to the
    // integral.
    CHECK(growth.depth_after(damage) == Approx(depth).epsilon(2e-3));
}

TEST_CASE("Growth requires depths and a load that opens the crack", "[growth]") {
    const ParisLaw law = paris_law_mm_MPa(1e-8, 3.0);
    CHECK_THROWS_AS(ParisGrowth(law, same_factor, 0.0, 1e-3), std::invalid_argument);
    CHECK_THROWS_AS(ParisGrowth(law, same_factor, 1e-3, 1e-3), std::invalid_argument);
    CHECK_THROWS_AS(ParisGrowth(
                        law, [](double) { return 0.0; }, 1e-4, 1e-3),
                    std::invalid_argument);
}

}  // namespace

}  // namespace test_paris_growth
