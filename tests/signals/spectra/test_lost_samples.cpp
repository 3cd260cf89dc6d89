// Checks the detection of missing samples in signals whose losses are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "signals/spectra/lost_samples.hpp"

namespace test_lost_samples {

using namespace gearpod;
using namespace gearpod::signals;

namespace {

constexpr int kPerMesh = 12, kTurnMeshes = 20, kTurns = 10;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Two mesh harmonics with amplitude modulation once per turn, a small speed error, and noise.
std::vector<double> signal(double ratio, double noise) {
    std::mt19937 engine(5);
    std::normal_distribution<double> draw;
    std::vector<double> samples;
    for (int i = 0; i < kTurns * kTurnMeshes * kPerMesh; ++i) {
        const double mesh = ratio * i / kPerMesh, turn = mesh / kTurnMeshes;
        samples.push_back((1.2 + std::cos(kTwoPi * turn)) * std::cos(kTwoPi * mesh) +
                          0.5 * std::cos(2.0 * kTwoPi * mesh + 1.0) + noise * draw(engine));
    }
    return samples;
}

TEST_CASE("Samples lost in a turn are located there, to a twentieth of a mesh period") {
    for (const long lost : {1L, 2L, 4L, 7L, 15L}) {
        auto samples = signal(1.0002, 0.2);
        samples.erase(samples.begin() + 1300, samples.begin() + 1300 + lost);
        const auto found = lost_samples(samples, kPerMesh, kTurnMeshes);
        INFO(lost);
        REQUIRE(found);
        CHECK(found->found);
        // Unique up to whole mesh periods.
        CHECK(found->meshes ==
              Approx(std::remainder(static_cast<double>(lost) / kPerMesh, 1.0)).margin(0.05));
        CHECK(found->first_mesh <= 1300 / kPerMesh);
        CHECK(found->last_mesh >= 1300 / kPerMesh);
    }
}

TEST_CASE("Repeated samples count as surplus") {
    auto samples = signal(1.0, 0.1);
    samples.insert(samples.begin() + 900, {samples[900], samples[900], samples[900]});
    const auto found = lost_samples(samples, kPerMesh, kTurnMeshes);
    REQUIRE(found);
    CHECK(found->found);
    CHECK(found->meshes == Approx(-3.0 / kPerMesh).margin(0.05));
}

TEST_CASE("Complete recordings lack nothing, also with a small speed error and in noise") {
    for (const double ratio : {1.0, 1.0005, 0.999}) {
        for (const double noise : {0.0, 0.3, 1.0}) {
            const auto found = lost_samples(signal(ratio, noise), kPerMesh, kTurnMeshes);
            INFO(ratio << " " << noise);
            CHECK((!found || !found->found));
        }
    }
}

TEST_CASE("Few turns, noise alone and silence give no result") {
    const auto samples = signal(1.0, 0.1);
    CHECK(
        !lost_samples(std::span(samples).first(5 * kTurnMeshes * kPerMesh), kPerMesh, kTurnMeshes));
    std::mt19937 engine(1);
    std::normal_distribution<double> draw;
    std::vector<double> noise(samples.size());
    for (double& value : noise) {
        value = draw(engine);
    }
    CHECK(!lost_samples(noise, kPerMesh, kTurnMeshes));
    CHECK(!lost_samples(std::vector<double>(samples.size(), 0.0), kPerMesh, kTurnMeshes));
    CHECK(!lost_samples({}, kPerMesh, kTurnMeshes));
}

}  // namespace

}  // namespace test_lost_samples
