// Checks statistics of the planet turn in a record against closed forms of modulated noise.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "features/cyclostationarity.hpp"
#include "features/feature.hpp"
#include "features/residual_indicators.hpp"
#include "features/spectral_kurtosis.hpp"

namespace test_cyclic_features {

using namespace gearpod;
using namespace gearpod::features;

namespace {

constexpr std::size_t kTeeth = 31, kTurns = 80;

// White noise times 1 + depth cos(2 pi cycles t), t in planet turns.
struct Record {
    Record(std::size_t per_mesh, double depth, double cycles) : turn(kTeeth * per_mesh, 0.0) {
        std::mt19937_64 engine(7);
        std::normal_distribution<double> normal(0.0, 2.0);
        const std::size_t points = kTeeth * per_mesh;
        for (std::size_t i = 0; i < kTurns * points; ++i) {
            const double t = static_cast<double>(i) / static_cast<double>(points);
            samples.push_back(normal(engine) *
                              (1.0 + depth * std::cos(2.0 * std::numbers::pi * cycles * t)));
        }
    }
    double envelope() const { return envelope_order({samples}, average()); }
    double kurtosis() const { return kurtogram_peak({samples}, average()); }
    double coherence() const { return cyclic_coherence({samples}, average()); }
    SensorTurn average() const {
        SensorTurn sensor;
        sensor.turn = turn;
        sensor.mesh_order = kTeeth;
        return sensor;
    }
    std::vector<double> turn, samples;
};

TEST_CASE("Stationary noise has envelope lines as high as their background") {
    // Five magnitudes of complex normal values over their medians: mean 1.065, deviation 0.25.
    CHECK(Record(4, 0.0, 1.0).envelope() == Approx(1.065).margin(0.75));
    CHECK(Record(16, 0.0, 1.0).envelope() == Approx(1.065).margin(0.75));
    // Modulation that is no multiple of the planet turn.
    CHECK(Record(16, 0.8, 31.0 / 81.0).envelope() == Approx(1.065).margin(0.75));
}

TEST_CASE("Modulated noise has the envelope lines of its modulation over the noise's background") {
    // With two samples per mesh period there is one band, a mesh order wide. The squared modulation
    // has the lines m and m^2/4 at orders 1 and 2. The noise of M independent values has an RMS of
    // <g^4>^(1/2) M^(-1/2) per line, and its median is ln(2)^(1/2) of this. Other lines are noise.
    constexpr double kDepth = 0.6;
    const double power = kDepth * kDepth;
    const double fourth = 1.0 + 3.0 * power + 0.375 * power * power;
    const double median = std::sqrt(std::numbers::ln2 * fourth / (kTeeth * kTurns));
    const double expected = (kDepth + 0.25 * power) / (5.0 * median) + 0.6 * 1.065;
    CHECK(Record(2, kDepth, 1.0).envelope() == Approx(expected).epsilon(0.1));
}

TEST_CASE("Impulses once per turn raise the envelope lines, in the band of their resonance") {
    Record record(16, 0.0, 1.0);
    const double healthy = record.envelope(), kurtosis = record.kurtosis();
    for (std::size_t i = 100; i + 60 < record.samples.size(); i += record.turn.size()) {
        for (std::size_t j = 0; j < 60; ++j) {
            const auto k = static_cast<double>(j);
            record.samples[i + j] += 6.0 * std::exp(-0.08 * k) * std::cos(1.9 * k);
        }
    }
    CHECK(record.envelope() > 5.0 * healthy);
    CHECK(record.kurtosis() > 5.0 * kurtosis);
}

TEST_CASE("The cyclic coherence of modulated white noise follows from the modulation") {
    // Spectral correlation m, power 1 + m^2/2. A mesh period is short against a turn.
    for (const double depth : {0.3, 0.6, 1.0}) {
        const double gamma = depth / (1.0 + 0.5 * depth * depth);
        INFO(depth);
        CHECK(Record(16, depth, 1.0).coherence() == Approx(gamma * gamma).epsilon(0.1));
    }
    CHECK(Record(16, 0.0, 1.0).coherence() < 4.0 / (kTeeth * kTurns));
    CHECK(Record(16, 0.8, 31.0 / 81.0).coherence() < 0.01);
}

TEST_CASE(
    "The kurtogram of noise peaks at 0, that of modulated noise at the modulation's kurtosis") {
    // The largest of 24 bands of 2480 orders and more scatters by some 2 / sqrt(2480) = 0.04.
    CHECK(Record(16, 0.0, 1.0).kurtosis() == Approx(0.08).margin(0.08));
    // With g = 1 + m cos, <|b|^4> = 2 <g^4> P^2 and <|b|^2> = <g^2> P.
    constexpr double kDepth = 0.8, kPower = kDepth * kDepth;
    const double expected =
        2.0 * (1.0 + 3.0 * kPower + 0.375 * kPower * kPower) / std::pow(1.0 + 0.5 * kPower, 2) -
        2.0;
    CHECK(Record(2, kDepth, 1.0).kurtosis() == Approx(expected).margin(0.25));
}

TEST_CASE("Cyclic features need three turns and a signal") {
    Record record(8, 0.5, 1.0);
    const std::span<const double> samples = record.samples;
    const SensorSamples two{samples.first(2 * record.turn.size())};
    CHECK(std::isnan(envelope_order(two, record.average())));
    CHECK(std::isnan(cyclic_coherence(two, record.average())));
    record.samples.assign(record.samples.size(), 0.0);
    CHECK(std::isnan(record.envelope()));
    CHECK(std::isnan(record.kurtosis()));
    CHECK(std::isnan(record.coherence()));
    // The same turn over and over: there is no background.
    for (std::size_t i = 0; i < record.samples.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i % record.turn.size()) /
                             static_cast<double>(record.turn.size());
        record.samples[i] = (1.0 + std::cos(angle)) * std::cos(40.0 * angle);
    }
    CHECK(std::isnan(record.envelope()));
    for (const char* name :
         {"envelope_order", "kurtogram_peak", "cyclic_coherence", "whitened_window_ratio"}) {
        CHECK(find_feature(name)->from_sensor);
        CHECK(!find_feature(name)->basic());
    }
}

TEST_CASE("The FM4 of separated planets is that of the worst planet, if any is above rounding") {
    std::vector<double> mesh(kTeeth * 8), tone(mesh), impulse(mesh.size(), 0.0), rounding(mesh);
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const auto k = static_cast<double>(i);
        mesh[i] = 4.0 * std::cos(2.0 * std::numbers::pi * k / 8.0);
        tone[i] = std::cos(2.0 * std::numbers::pi * k / 62.0);
        rounding[i] = 1e-16 * std::sin(k * k);
    }
    impulse[5] = 0.3;
    const std::vector<std::vector<double>> turn{mesh, mesh, mesh},
        none{rounding, rounding, rounding};
    const std::vector<std::vector<double>> faulty{tone, impulse, rounding}, sound{tone, tone, tone};
    CHECK(separated_fm4({turn, sound}) == Approx(1.5));
    const double p = 1.0 / static_cast<double>(mesh.size()), q = 1.0 - p;
    CHECK(separated_fm4({turn, faulty}) == Approx((q * q * q + p * p * p) / (p * q)));
    CHECK(std::isnan(separated_fm4({turn, none})));
    CHECK(std::isnan(separated_fm4({})));
    CHECK(!find_feature("separated_fm4")->basic());
}

}  // namespace

}  // namespace test_cyclic_features
