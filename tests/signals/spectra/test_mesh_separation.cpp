#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "signals/spectra/mesh_separation.hpp"

namespace test_mesh_separation {

using namespace gearpod;
using namespace gearpod::signals;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<double> sampled(int points, const auto& function) {
    std::vector<double> values;
    for (int i = 0; i < points; ++i) {
        values.push_back(function(kTwoPi * i / points));
    }
    return values;
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    return worst;
}

TEST_CASE("Mesh harmonics, their first sidebands and the rest go to their parts") {
    constexpr int kTeeth = 31, kPoints = 31 * 24;
    const auto harmonics = sampled(kPoints, [](double x) {
        return 2.0 * std::cos(31 * x + 0.3) + 0.5 * std::sin(62 * x) + 0.1 * std::cos(372 * x);
    });
    const auto sidebands = sampled(
        kPoints, [](double x) { return 0.4 * std::cos(30 * x) + 0.2 * std::sin(63 * x + 1.0); });
    const auto rest = sampled(kPoints, [](double x) {
        return 0.3 * std::cos(x) + 0.7 * std::sin(29 * x) + 0.05 * std::cos(34 * x);
    });
    std::vector<double> turn(kPoints), residual(kPoints), regular(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) {
        regular[i] = harmonics[i] + sidebands[i];
        residual[i] = sidebands[i] + rest[i];
        turn[i] = 5.0 + harmonics[i] + residual[i];
    }
    MeshSeparation separation(kPoints, kTeeth);
    separation.load(turn);
    CHECK(largest_difference(separation.regular(), regular) < 1e-12);
    CHECK(largest_difference(separation.residual(), residual) < 1e-12);
    CHECK(largest_difference(separation.difference(), rest) < 1e-12);
    CHECK(separation.amplitude()[0] == Approx(5.0));
    CHECK(separation.amplitude()[30] == Approx(0.4));
    CHECK(separation.amplitude()[29] == Approx(0.7));
    CHECK(separation.amplitude()[372] == Approx(0.1));  // the Nyquist order
}

TEST_CASE("The envelope of a modulated mesh harmonic is its modulation") {
    constexpr int kTeeth = 20, kPoints = 400;
    const auto modulation = [](double x) {
        return 1.0 + 0.5 * std::cos(x) + 0.2 * std::sin(3 * x);
    };
    MeshSeparation separation(kPoints, kTeeth);
    // The second harmonic, the mean and components below the band have no influence.
    separation.load(sampled(kPoints, [&](double x) {
        return modulation(x) * std::cos(20 * x + 0.7) + std::cos(40 * x) + 3.0 + std::sin(4 * x);
    }));
    CHECK(largest_difference(separation.envelope(), sampled(kPoints, modulation)) < 1e-12);
}

TEST_CASE("The parts of any turn add up to it") {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal;
    for (const int points : {7 * 9, 7 * 16}) {  // with and without a Nyquist order
        std::vector<double> turn(points);
        double mean = 0.0;
        for (double& value : turn) {
            value = 1.0 + normal(engine);
            mean += value / points;
        }
        MeshSeparation separation(points, 7);
        separation.load(turn);
        std::vector<double> sum(points);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] = mean + separation.regular()[i] + separation.difference()[i];
        }
        CHECK(largest_difference(sum, turn) < 1e-12);
    }
    CHECK_THROWS_AS(MeshSeparation(7, 2), std::invalid_argument);
    CHECK_THROWS_AS(MeshSeparation(27, 7), std::invalid_argument);
    CHECK_THROWS_AS(MeshSeparation(28, 7).load(std::vector<double>(27)), std::invalid_argument);
}

}  // namespace

}  // namespace test_mesh_separation
