#include "signals/path/transmission_path.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_transmission_path {

double farthest(double alpha) {
    const double pi = std::numbers::pi;
    return std::exp(alpha * pi * pi) * path_window("hamming").weight(0.0);
}

TEST_CASE("The farthest planet keeps the weight that Liang states for each path exponent") {
    // Source: Liang (2016), section 4.3, 0.21, 0.08, 0.03; the last belongs to -0.1, not -1.
    CHECK(farthest(0.1) == Approx(0.21).margin(0.01));
    CHECK(farthest(0.0) == Approx(0.08).margin(0.001));
    CHECK(farthest(-0.1) == Approx(0.03).margin(0.001));
}

TEST_CASE("The path grid holds the angles of every sample of a carrier turn") {
    const SpanLayout layout{31, 81, 81};
    const int planets = 4;
    const int phases = 12;
    const PathGrid grid(path_window("hann"), planets, phases, layout);
    REQUIRE(grid.positions() == 81);
    const double pi = std::numbers::pi;
    double worst = 0.0;
    for (int p = 0; p < phases; ++p) {
        for (int c = 0; c < 81; ++c) {
            const double theta = 2.0 * pi * (c + p / 12.0) / 81.0;
            const int place = p * 81 + c;
            worst = std::max({worst, std::abs(grid.sine()[place] - std::sin(theta)),
                              std::abs(grid.cosine()[place] - std::cos(theta))});
            for (int n = 0; n < planets; ++n) {
                // Compared through a cosine, which does not depend on the side of the wrap.
                const double angle = theta + 2.0 * pi * n / planets;
                const int steps = (c - grid.centre()[p * planets + n] + 81 + 40) % 81 - 40;
                const double from_sensor =
                    2.0 * pi / 81.0 * (steps + grid.fraction()[p * planets + n]);
                worst = std::max(
                    {worst, std::abs(std::cos(from_sensor) + std::cos(angle)),
                     std::abs(grid.window()[place * planets + n] - (0.5 - 0.5 * std::cos(angle)))});
            }
        }
    }
    CHECK(worst < 1e-13);
}

TEST_CASE("With the carrier fixed the planets keep their positions") {
    const PathGrid grid(path_window("hamming"), 4, 10, {31, 81, 1});
    for (int p = 0; p < 10; ++p) {
        CHECK(grid.sine()[p] == 0.0);
        CHECK(grid.cosine()[p] == 1.0);
        CHECK(grid.window()[4 * p + 0] == Approx(0.08));
        CHECK(grid.window()[4 * p + 1] == Approx(0.54));
        CHECK(grid.window()[4 * p + 2] == Approx(1.0));
    }
}

TEST_CASE("The path grid holds the angles of planets at given positions, for both directions") {
    // Planets of 16/26/68 at positions 0, 25 and 51 of 84.
    const SpanLayout layout{26, 68, 68};
    const gears::PlanetPositions planets{{0, 25, 51}, 84};
    const double pi = std::numbers::pi;
    const int phases = 6;
    for (const auto sense : {CarrierSense::positive, CarrierSense::negative}) {
        const PathGrid grid(path_window("hann"), planets, phases, layout, sense);
        REQUIRE(grid.planets() == 3);
        double worst = 0.0;
        for (int p = 0; p < phases; ++p) {
            for (int c = 0; c < 68; ++c) {
                const double turned = 2.0 * pi * (c + p / 6.0) / 68.0;
                const double theta = sense == CarrierSense::positive ? turned : -turned;
                const int place = p * 68 + c;
                worst = std::max({worst, std::abs(grid.sine()[place] - std::sin(theta)),
                                  std::abs(grid.cosine()[place] - std::cos(theta))});
                for (int n = 0; n < 3; ++n) {
                    const double angle = theta + gears::planet_angle(planets, PlanetId{n});
                    const int steps = (c - grid.centre()[p * 3 + n] + 68 + 34) % 68 - 34;
                    const double h = 2.0 * pi / 68.0;
                    const double from_sensor = h * (steps + grid.fraction()[p * 3 + n]);
                    // Weight g depends on x - pi by its square: its sign does not matter.
                    worst = std::max(
                        {worst, std::abs(std::cos(from_sensor) + std::cos(angle)),
                         std::abs(grid.window()[place * 3 + n] - (0.5 - 0.5 * std::cos(angle)))});
                    CHECK(std::abs(from_sensor) <= pi + 1e-12);
                }
            }
        }
        CHECK(worst < 1e-13);
    }
}

TEST_CASE("Every path window is found by its name and weights a planet most at the sensor") {
    const double pi = std::numbers::pi;
    for (const PathWindow& window : path_windows()) {
        INFO(window.name);
        CHECK(&path_window(window.name) == &window);
        CHECK_FALSE(window.doc.empty());
        CHECK(window.weight(pi) == Approx(1.0).epsilon(1e-15));
        for (int i = 0; i < 100; ++i) {
            const double x = 2.0 * pi * i / 100;
            CHECK(window.weight(x) >= 0.0);
            CHECK(window.weight(x) <= window.weight(pi));
            // The path is symmetric about the sensor.
            CHECK(window.weight(x) == Approx(window.weight(2.0 * pi - x)).margin(1e-15));
        }
    }
}

TEST_CASE("An unknown path window is refused by naming the known ones") {
    CHECK_THROWS_WITH(path_window("hanning"), Catch::Contains("hamming, hann, rectangular"));
}

}  // namespace gearpod::signals::test_transmission_path
