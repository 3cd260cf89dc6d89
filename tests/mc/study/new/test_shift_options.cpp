// Checks profile shifts and centre distance of `new planetary` and of study files in every
// combination.
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/study.hpp"
#include "tests/test.hpp"

namespace gearpod::test_shift_options {

// Set of 62/17/96 teeth whose ring and planet were measured: shifts 0.2 and -0.5 give 557.089 mm
// and a sun's shift of 0.1 (rounded).
constexpr double kSun = 0.09995, kPlanet = 0.2, kRing = -0.5, kDistance_mm = 557.089;

mc::PlanetaryDatasheet measured(int subset) {
    mc::PlanetaryDatasheet data;
    data.sun = 62;
    data.planet = 17;
    data.ring = 96;
    data.module_mm = 14;
    data.power_kW = 100;
    data.speed_rpm = 152.9;
    const auto given = [&](int bit, double value) {
        return subset >> bit & 1 ? std::optional(value) : std::nullopt;
    };
    data.sun_shift = given(0, kSun);
    data.planet_shift = given(1, kPlanet);
    data.ring_shift = given(2, kRing);
    data.centre_distance_mm = given(3, kDistance_mm);
    return data;
}

TEST_CASE("Ring and planet shift give the published centre distance and the sun's shift") {
    const mc::NewStudy made = new_planetary(measured(2 | 4), "new planetary");
    INFO(format(made.problems));
    const auto study = mc::read_study_text(made.text, "s.toml").study;
    REQUIRE(study);
    CHECK(1e3 * mc::centre_distance_m(*study) == Approx(kDistance_mm).epsilon(1e-6));
    CHECK(mc::gear_of(*study, mc::Member::sun).profile_shift == Approx(0.1).margin(1e-3));
    CHECK(mc::working_angle_rad(*study, mc::MeshKind::ring_planet) ==
          Approx(21.125 * 3.14159265 / 180).epsilon(1e-4));
}

TEST_CASE("Every determined combination of shifts and centre distance gives the same set") {
    // Two shifts, or one shift and the distance.
    for (const int subset : {3, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15}) {
        const mc::NewStudy made = new_planetary(measured(subset), "new planetary");
        INFO(subset << ": " << format(made.problems));
        const auto study = mc::read_study_text(made.text, "s.toml").study;
        REQUIRE(study);
        CHECK(1e3 * mc::centre_distance_m(*study) == Approx(kDistance_mm).epsilon(1e-4));
        CHECK(mc::gear_of(*study, mc::Member::sun).profile_shift == Approx(kSun).margin(5e-3));
        CHECK(mc::gear_of(*study, mc::Member::ring).profile_shift == Approx(kRing).margin(5e-3));
    }
}

TEST_CASE("Contradictory shifts and distances are refused with the values") {
    // A distance 4 mm too large opens the sun mesh by 0.22 modules, 8 mm by 0.4 modules.
    mc::PlanetaryDatasheet data = measured(1 | 2 | 8);
    data.centre_distance_mm = kDistance_mm + 8;
    const std::string open = format(new_planetary(data, "new planetary").problems);
    INFO(open);
    CHECK(open.find("--planet-shift: leaves") != std::string::npos);
    CHECK(open.find("between sun and planets at a centre distance of 565.089 mm") !=
          std::string::npos);
    CHECK(open.find("leaves none") != std::string::npos);
    data.centre_distance_mm = kDistance_mm - 4;
    CHECK(!new_planetary(data, "new planetary").problems.empty());
    // A ring shift that contradicts the other two.
    data = measured(7);
    data.ring_shift = -0.7;
    const std::string ring = format(new_planetary(data, "new planetary").problems);
    INFO(ring);
    CHECK(ring.find("--ring-shift: leaves") != std::string::npos);
}

}  // namespace gearpod::test_shift_options
