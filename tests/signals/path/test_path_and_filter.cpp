#include "signals/path/transmission_path.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_path_and_filter {

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

// Checks a grid of the Hann window at every sample of a carrier turn of `meshes` mesh periods, for
// planets at these angles.
void check_angles(const PathGrid& grid, int meshes, int phases, CarrierSense sense,
                  const std::vector<double>& planets) {
    const double pi = std::numbers::pi, h = 2.0 * pi / meshes;
    const int count = static_cast<int>(planets.size());
    REQUIRE(grid.planets() == count);
    double worst = 0.0;
    for (int p = 0; p < phases; ++p) {
        for (int c = 0; c < meshes; ++c) {
            const double turned = h * (c + double(p) / phases);
            const double theta = sense == CarrierSense::positive ? turned : -turned;
            const int place = p * meshes + c;
            worst = std::max({worst, std::abs(grid.sine()[place] - std::sin(theta)),
                              std::abs(grid.cosine()[place] - std::cos(theta))});
            for (int n = 0; n < count; ++n) {
                const double angle = theta + planets[n];
                const int half = meshes / 2;
                const int steps =
                    (c - grid.centre()[p * count + n] + meshes + half) % meshes - half;
                const double from_sensor = h * (steps + grid.fraction()[p * count + n]);
                // Compared through a cosine, which does not depend on the side of the wrap. Weight
                // g depends on x - pi by its square: its sign does not matter.
                worst = std::max(
                    {worst, std::abs(std::cos(from_sensor) + std::cos(angle)),
                     std::abs(grid.window()[place * count + n] - (0.5 - 0.5 * std::cos(angle)))});
                CHECK(std::abs(from_sensor) <= pi + 1e-12);
            }
        }
    }
    CHECK(worst < 1e-13);
}

TEST_CASE("The path grid holds the angles of every sample of a carrier turn") {
    const PathGrid grid(path_window("hann"), 4, 12, {31, 81, 81});
    REQUIRE(grid.positions() == 81);
    const double quarter = std::numbers::pi / 2.0;
    check_angles(grid, 81, 12, CarrierSense::positive, {0.0, quarter, 2 * quarter, 3 * quarter});
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
    const gears::PlanetPositions planets{{0, 25, 51}, 84};
    const auto angles =
        test::tabulated(3, [&](int n) { return gears::planet_angle(planets, PlanetId{n}); });
    for (const auto sense : {CarrierSense::positive, CarrierSense::negative}) {
        const PathGrid grid(path_window("hann"), planets, 6, {26, 68, 68}, sense);
        check_angles(grid, 68, 6, sense, angles);
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

constexpr double kPi = std::numbers::pi;

// Fourth-order Butterworth low-pass, two sections by the bilinear transform.
class Butterworth {
  public:
    Butterworth(double cutoff_Hz, double sampling_Hz) {
        const double w = std::tan(kPi * cutoff_Hz / sampling_Hz);
        for (int s = 0; s < 2; ++s) {
            const double damping = 2.0 * std::cos(kPi * (2 * s + 1) / 8.0);
            const double norm = 1.0 / (1.0 + damping * w + w * w);
            sections_[s] = {w * w * norm, 2.0 * (w * w - 1.0) * norm,
                            (1.0 - damping * w + w * w) * norm, 0.0, 0.0};
        }
    }
    double operator()(double x) {
        for (Section& s : sections_) {
            const double y = s.b * x + s.z1;
            s.z1 = 2.0 * s.b * x - s.a1 * y + s.z2;
            s.z2 = s.b * x - s.a2 * y;
            x = y;
        }
        return x;
    }

  private:
    struct Section {
        double b, a1, a2, z1, z2;
    };
    Section sections_[2];
};

// Relative rms difference between two orders: filtering each planet's acceleration before the path,
// and filtering the resultant after it. Evaluated over the second of two carrier turns.
double difference_of_orders(double carrier_rpm, double cutoff_Hz, double sampling_Hz) {
    constexpr int kPlanets = 4;
    constexpr double kAlpha = 0.1;
    const double speed = carrier_rpm * 2.0 * kPi / 60.0;
    const double mesh_Hz = 81.0 * speed / (2.0 * kPi);
    const auto turn = static_cast<long>(sampling_Hz * 2.0 * kPi / speed);
    std::vector<Butterworth> before(2 * kPlanets, Butterworth(cutoff_Hz, sampling_Hz));
    Butterworth after(cutoff_Hz, sampling_Hz);
    double difference = 0.0;
    double total = 0.0;
    for (long i = 0; i < 2 * turn; ++i) {
        const double t = static_cast<double>(i) / sampling_Hz;
        const double theta = speed * t;
        double early = 0.0;
        double raw = 0.0;
        for (int n = 0; n < kPlanets; ++n) {
            // A decaying 570 Hz oscillation after each engagement, with a steady inward
            // acceleration.
            const double since = std::fmod(mesh_Hz * t + 0.25 * n, 1.0) / mesh_Hz;
            const double burst =
                50.0 * std::exp(-200.0 * since) * std::cos(2 * kPi * 570.0 * since);
            const double accel[2] = {burst - 0.08, 0.7 * burst};
            const double x = std::fmod(theta + 2.0 * kPi * n / kPlanets, 2.0 * kPi);
            const double g =
                std::exp(kAlpha * (x - kPi) * (x - kPi)) * path_window("hamming").weight(x);
            raw += g * (std::sin(theta) * accel[0] + std::cos(theta) * accel[1]);
            const double filtered_x = before[2 * n](accel[0]);
            const double filtered_y = before[2 * n + 1](accel[1]);
            early += g * (std::sin(theta) * filtered_x + std::cos(theta) * filtered_y);
        }
        const double late = after(raw);
        if (i >= turn) {
            difference += (early - late) * (early - late);
            total += late * late;
        }
    }
    return std::sqrt(difference / total);
}

TEST_CASE("The low-pass may be applied before the path: they commute to the ratio of their rates") {
    const double ratio = (8.87 / 60.0) / 800.0;  // Omega / omega_c
    const double difference = difference_of_orders(8.87, 800.0, 20000.0);
    WARN("filter before against after the path at 8.87 rpm, 800 Hz: relative rms difference "
         << difference << ", Omega/omega_c " << ratio);
    CHECK(difference < 5.0 * ratio);
    // The ratio determines the difference: four times the speed, four times the difference.
    CHECK(difference_of_orders(4 * 8.87, 800.0, 20000.0) / difference == Approx(4.0).epsilon(0.3));
}

}  // namespace gearpod::signals::test_path_and_filter
