// Checks that gears that cannot mesh are refused when the study is read.
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_problems.hpp"
#include "tests/test.hpp"

namespace gearpod::test_bad_gears {

using mc::format;
using mc::Problem;
using mc::read_study_text;
using namespace tests;

TEST_CASE("All gears that do not mesh are named, on the line of the angle or the smaller gear") {
    // Lengths in modules, tip circles one module from the pitch circles. True if the mate's contact
    // reaches below the base circle of the gear of z1 teeth: the length of the line of action up to
    // there is (r1 +- r2) sin a.
    const auto undercuts = [](int z1, int z2, bool internal, double angle_deg) {
        const double a = angle_deg * M_PI / 180.0, side = internal ? -1.0 : 1.0;
        const double r1 = 0.5 * z1, r2 = 0.5 * z2, tip = r2 + side, base = r2 * std::cos(a);
        const double reach = std::sqrt(tip * tip - base * base),
                     room = (r2 + side * r1) * std::sin(a);
        return side * reach > side * room;
    };
    struct Train {
        int planets, sun, planet, ring;
        const char *angle_deg, *marker, *key;
    };
    const Train trains[] = {
        {4, 19, 31, 81, "14.5", "pressure_angle", "gearbox.pressure_angle_deg"},
        {6, 20, 10, 40, "20", "planet.teeth", "gearbox.planet.teeth"},
        {6, 20, 10, 40, "20.5", "planet.teeth", "gearbox.planet.teeth"},
    };
    for (const Train& train : trains) {
        std::string text = example_with("pressure_angle_deg = 20",
                                        "pressure_angle_deg = " + std::string(train.angle_deg));
        const auto set = [&](const std::string& from, const std::string& key, int value) {
            text.replace(text.find(from), from.size(), key + " = " + std::to_string(value));
        };
        set("planets = 4", "planets", train.planets);
        set("sun.teeth = 19", "sun.teeth", train.sun);
        set("planet.teeth = 31", "planet.teeth", train.planet);
        set("ring.teeth = 81", "ring.teeth", train.ring);
        const double angle_deg = std::stod(train.angle_deg);
        REQUIRE(undercuts(std::min(train.sun, train.planet), std::max(train.sun, train.planet),
                          false, angle_deg));
        REQUIRE(undercuts(train.planet, train.ring, true, angle_deg));
        const auto problems = read_study_text(text, "bad.toml").problems;
        INFO(format(problems));
        REQUIRE(problems.size() == 2);
        for (const Problem& problem : problems) {
            CHECK(problem.line == line_of(text, train.marker));
            CHECK(problem.key == train.key);
        }
        CHECK(mentions(problems[0], "sun and planet do not mesh (the tips of " +
                                        std::to_string(std::max(train.sun, train.planet)) +
                                        " teeth reach below the base circle"));
        CHECK(mentions(problems[1], "planet and ring do not mesh (the tips of " +
                                        std::to_string(train.ring) + " teeth"));
    }
}

TEST_CASE("A centre distance that no gears have is one problem, which names the fitting one") {
    const std::string text = example_with("planets = 4", "planets = 4\ncentre_distance_mm = 70");
    const auto problems = read_study_text(text, "bad.toml").problems;
    INFO(format(problems));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].key == "gearbox.centre_distance_mm");
    CHECK(problems[0].line == line_of(text, "centre_distance_mm"));
    CHECK(mentions(problems[0], "the other keys give 79.375 mm"));  // (19 + 31) 3.175 mm / 2
}

TEST_CASE("Gears without tooth contact at some phase are refused") {
    const auto problems =
        read_study_text(example_with("planets = 4", "planets = 4\naddendum_coefficient = 0.2"),
                        "bad.toml")
            .problems;
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].key == "gearbox.sun.teeth");
    CHECK(mentions(problems[0], "sun and planet do not mesh (the contact ratio of 19 against 31"));
    CHECK(problems[1].key == "gearbox.planet.teeth");
    CHECK(mentions(problems[1], "planet and ring do not mesh (the contact ratio of 31 against 81"));
}

}  // namespace gearpod::test_bad_gears
