#include "signals/spectra/recording_checks.hpp"
#include "signals/spectra/speed_variation.hpp"
#include "signals/spectra/wide_speed.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_mesh_speed {

constexpr int kPerMesh = 24;

// Lines of a planetary gearbox at multiples of the carrier frequency (`turn_meshes` meshes per
// turn), in noise, at `ratio` times the speed assumed by its samples.
std::vector<double> gearbox(int turn_meshes, int planets, double ratio, double noise, int meshes,
                            unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi), size(0.2, 1.0);
    std::normal_distribution<double> normal;
    std::vector<double> samples(static_cast<std::size_t>(meshes) * kPerMesh);
    for (double& sample : samples) {
        sample = noise * normal(engine);
    }
    for (int k = 1; k <= 6; ++k) {
        for (int j = -5; j <= 5; ++j) {
            // Evenly phased planets leave the lines whose order is a multiple of their number.
            if ((k * turn_meshes + j) % planets != 0) {
                continue;
            }
            const double order = (k * turn_meshes + j) * ratio / turn_meshes;
            const double start = phase(engine), amplitude = size(engine) / (1.0 + std::abs(j));
            for (std::size_t i = 0; i < samples.size(); ++i) {
                samples[i] += amplitude * std::cos(2.0 * std::numbers::pi * order *
                                                       static_cast<double>(i) / kPerMesh +
                                                   start);
            }
        }
    }
    return samples;
}

// Signals without mesh lines, of 400 mesh periods.
std::pair<std::vector<double>, std::vector<double>> noise_and_tone() {
    std::mt19937 engine(7);
    std::normal_distribution<double> normal;
    std::vector<double> noise(static_cast<std::size_t>(400) * kPerMesh), tone = noise;
    for (std::size_t i = 0; i < noise.size(); ++i) {
        noise[i] = normal(engine);
        tone[i] = std::sin(0.271 * static_cast<double>(i)) + 0.01 * noise[i];
    }
    return {noise, tone};
}

TEST_CASE("A speed that varies is measured; noise and short records show no variation") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const std::vector<double> even = gearbox(81, 4, 1.0, 1.0, 620, seed);
        CHECK_FALSE(speed_variation(std::span(even).first(100 * kPerMesh), kPerMesh));
        CHECK_FALSE(speed_variation(std::span(even).first(600 * kPerMesh), kPerMesh));
        // A speed that rises by 2 %: the phase is late by up to 600 * 2 % / 8 mesh periods.
        std::vector<double> ramp;
        for (double i = 0.0, n = 600.0 * kPerMesh; i < n; ++i) {
            const double at = i * (0.99 + 0.01 * i / n);
            const auto sample = static_cast<std::size_t>(at);
            ramp.push_back(std::lerp(even[sample], even[sample + 1], at - std::floor(at)));
        }
        const auto found = speed_variation(ramp, kPerMesh);
        REQUIRE(found);
        CHECK(found->speed == Approx(0.02).epsilon(0.2));
        CHECK(found->meshes == Approx(1.5).epsilon(0.1));
    }
    CHECK_FALSE(speed_variation(noise_and_tone().first, kPerMesh));
}

TEST_CASE(
    "Speeds that are wrong by 0.5 % to three times are found, right and short records confirmed") {
    for (const int turn_meshes : {35, 81, 99}) {
        for (const double ratio : {0.34, 0.61, 0.87, 0.96, 0.98, 0.995, 1.02, 1.05, 1.13, 2.0}) {
            const auto found =
                wide_speed(gearbox(turn_meshes, 4, ratio, 0.5, 700, 3), kPerMesh, turn_meshes);
            INFO(turn_meshes << " " << ratio);
            REQUIRE(found);
            CHECK_FALSE(found->fits());
            CHECK(found->contradicts());
            CHECK(found->ratio == Approx(ratio).epsilon(0.0015));
        }
        for (const unsigned seed : {1U, 2U, 3U, 4U}) {
            const auto noisy =
                wide_speed(gearbox(turn_meshes, 4, 1.0, 2.0, 400, seed), kPerMesh, turn_meshes);
            const auto brief =
                wide_speed(gearbox(turn_meshes, 4, 1.0, 0.5, 60, seed), kPerMesh, turn_meshes);
            INFO(turn_meshes << " " << seed);
            CHECK(noisy->fits());
            CHECK(brief->fits());
        }
    }
}

TEST_CASE("Noise and a single tone fit no speed") {
    const auto [noise, tone] = noise_and_tone();
    for (const auto& samples : {noise, tone}) {
        const auto found = wide_speed(samples, kPerMesh, 40);
        REQUIRE(found);
        CHECK_FALSE(found->fits());
        CHECK_FALSE(found->contradicts());
    }
    CHECK_FALSE(wide_speed(std::span(noise).first(15 * kPerMesh), kPerMesh, 40));
}

}  // namespace gearpod::signals::test_mesh_speed

// Checks the detection of missing samples in signals whose losses are known.

namespace gearpod::signals::test_lost_samples {

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
    std::vector<double> noise = test::tabulated(samples.size(), [&](auto) { return draw(engine); });
    CHECK(!lost_samples(noise, kPerMesh, kTurnMeshes));
    CHECK(!lost_samples(std::vector<double>(samples.size(), 0.0), kPerMesh, kTurnMeshes));
    CHECK(!lost_samples({}, kPerMesh, kTurnMeshes));
}

}  // namespace gearpod::signals::test_lost_samples
