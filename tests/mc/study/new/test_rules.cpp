#include "mc/study/new/rules.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_rules {

using std::numbers::pi;

// Total force of the rollers when their ring is displaced by `shift` mm. Each roller has Palmgren's
// ((shift cos angle) / 7.68e-5)^(1/0.9) l^(8/9), without clearance.
double rollers_N(int rollers, double length_mm, double shift_mm) {
    double sum = 0.0;
    for (int i = 0; i < rollers; ++i) {
        const double cosine = std::cos(2.0 * pi * (i + 0.25) / rollers);
        if (cosine > 0.0) {
            const double load =
                std::pow(shift_mm * cosine / 7.68e-5, 1.0 / 0.9) * std::pow(length_mm, 0.8 / 0.9);
            sum += load * cosine;
        }
    }
    return sum;
}

TEST_CASE("The stiffness of a roller bearing is that of its rollers in parallel") {
    for (const double bore : {0.04, 0.12, 0.35}) {
        const RollerBearing bearing = bearing_in_bore(bore, 0.8 * bore);
        const double length_mm = 1e3 * bearing.roller_length_m;
        for (const double shift_mm : {0.002, 0.01, 0.05}) {
            const double load = bearing.rows * rollers_N(bearing.rollers, length_mm, shift_mm);
            const double more =
                bearing.rows * rollers_N(bearing.rollers, length_mm, 1.001 * shift_mm);
            const double tangent = 1e3 * (more - load) / (0.001 * shift_mm);
            CHECK(bearing.stiffness_N_m(load) == Approx(tangent).epsilon(0.1));
        }
    }
}

// Source: ISO 15, dimension series 22; 2210 is 50 x 90 x 23 mm, 2220 is 100 x 180 x 46, 2240 is 200
// x 360 x 98.
TEST_CASE(
    "A bearing in a bore has the dimensions of a cylindrical roller bearing, and its rollers fit") {
    for (const auto& [outside, inside] :
         {std::pair{90.0, 50.0}, std::pair{180.0, 100.0}, std::pair{360.0, 200.0}}) {
        const RollerBearing bearing = bearing_in_bore(1e-3 * outside, 0.1);
        CHECK(1e3 * bearing.inner_diameter_m == Approx(inside).epsilon(0.03));
        const double roller = 0.14 * outside, circle = 0.77 * outside;
        CHECK(circle - roller > inside);
        CHECK(circle + roller < outside);
        CHECK(bearing.rollers * roller < pi * circle);        // adjacent
        CHECK((bearing.rollers + 4) * roller > pi * circle);  // with few gaps
    }
}

// Source: ISO 286-1, table 1, grade 7; 10 to 18 mm 18 um, 50 to 80 30 um, 120 to 180 40 um, 315 to
// 400 57 um, 800 to 1000 90 um. The standard uses the geometric mean of each step and rounds.
TEST_CASE("The tolerance of grade 7 matches ISO 286's table") {
    for (const auto& [low, high, um] :
         {std::tuple{10.0, 18.0, 18.0}, std::tuple{50.0, 80.0, 30.0},
          std::tuple{120.0, 180.0, 40.0}, std::tuple{315.0, 400.0, 57.0},
          std::tuple{800.0, 1000.0, 90.0}}) {
        CHECK(1e6 * grade_7_tolerance_m(1e-3 * std::sqrt(low * high)) == Approx(um).epsilon(0.05));
    }
}

// A steel ring of 20 and 50 mm radius, 30 mm wide: 197.9 cm^3, 1.554 kg; thin hoops have m r^2.
TEST_CASE("Masses and inertias are those of steel rings") {
    const Annulus ring{0.05, 0.02, 0.03};
    CHECK(ring.mass_kg() == Approx(1.5537).epsilon(1e-3));
    const Annulus hoop{0.1001, 0.1, 0.01};
    CHECK(hoop.inertia_kg_m2() == Approx(hoop.mass_kg() * 0.01).epsilon(2e-3));
    const Annulus disc{0.1, 0.0, 0.01};
    CHECK(disc.inertia_kg_m2() == Approx(0.5 * disc.mass_kg() * 0.01));
}

}  // namespace gearpod::mc::test_rules
