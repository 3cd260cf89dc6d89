// Checks the energy operator, linear prediction and deconvolution of an averaged turn against
// closed forms of noise, tones and impulses.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "features/feature.hpp"
#include "features/prediction_features.hpp"
#include "features/residual_indicators.hpp"
#include "features/statistics/signal_statistics.hpp"

namespace test_prediction_features {

using namespace gearpod;
using namespace gearpod::features;

namespace {

constexpr int kTeeth = 31, kPerMesh = 32;
constexpr std::size_t kPoints = kTeeth * kPerMesh;

SensorTurn turn_of(const std::vector<double>& samples) {
    SensorTurn sensor;
    sensor.turn = samples;
    sensor.residual = samples;
    sensor.mesh_order = kTeeth;
    return sensor;
}

std::vector<double> noise(std::size_t points) {
    std::mt19937_64 engine(51);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<double> values(points);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

// Kurtosis of one impulse in n samples.
double of_impulse(double n) {
    const double p = 1.0 / n, q = 1.0 - p;
    return (p * std::pow(q, 4) + q * std::pow(p, 4)) / (p * q * p * q);
}

// Impulse at sample 500 and what follows in a resonator with poles at radius 0.9.
std::vector<double> ringing() {
    std::vector<double> x(kPoints, 0.0);
    for (std::size_t i = 500; i < kPoints; ++i) {
        x[i] = (i == 500 ? 1.0 : 0.0) + 2.0 * 0.9 * std::cos(1.1) * x[i - 1] - 0.81 * x[i - 2];
    }
    return x;
}

TEST_CASE("The energy operator is 9 for white Gaussian noise and that of an impulse for one") {
    // E = r0^2 - r1 r2: variance 2 + 1, fourth central moment 60 + 6 * 2 * 1 + 9.
    CHECK(energy_operator(turn_of(noise(4000000))) == Approx(9.0).epsilon(0.02));
    std::vector<double> impulse(kPoints, 0.0);
    impulse[400] = -3.0;
    CHECK(energy_operator(turn_of(impulse)) == Approx(of_impulse(kPoints)));
}

TEST_CASE("A tone has constant energy, and thus no kurtosis of it") {
    std::vector<double> tone;
    for (std::size_t i = 0; i < kPoints; ++i) {
        tone.push_back(5.0 * std::cos(2.0 * std::numbers::pi * 20.0 * static_cast<double>(i) /
                                      static_cast<double>(kPoints)));
    }
    CHECK(std::isnan(energy_operator(turn_of(tone))));
    // A residual of rounding errors.
    SensorTurn rounding = turn_of(tone);
    const std::vector<double> small = noise(kPoints);
    std::vector<double> residual(small);
    for (double& value : residual) {
        value *= 1e-15;
    }
    rounding.residual = residual;
    CHECK(std::isnan(energy_operator(rounding)));
}

TEST_CASE("The prediction error of a resonator's response is its excitation") {
    const std::vector<double> x = ringing();
    CHECK(ar_residual_kurtosis(turn_of(x)) == Approx(of_impulse(kPoints)).epsilon(0.01));
    CHECK(standardised_moment(x, 4) < 0.3 * of_impulse(kPoints));
}

TEST_CASE("Linear prediction removes mesh lines and leaves noise, or an impulse in noise") {
    std::vector<double> excitation = noise(kPoints), x(kPoints);
    const auto with_mesh = [&] {
        for (std::size_t i = 0; i < kPoints; ++i) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPerMesh;
            x[i] =
                excitation[i] + 40.0 * std::cos(angle) + 25.0 * std::cos(3.0 * angle + 1.0) + 7.0;
        }
        return turn_of(x);
    };
    // The kurtosis of 992 normal values scatters by (24 / 992)^(1/2) = 0.16.
    CHECK(ar_residual_kurtosis(with_mesh()) == Approx(3.0).margin(0.6));
    excitation[300] += 12.0;
    const double faulty = ar_residual_kurtosis(with_mesh());
    CHECK(faulty == Approx(standardised_moment(excitation, 4)).epsilon(0.2));
    CHECK(standardised_moment(x, 4) < 2.5);
    for (double& value : x) {
        value *= 1e-5;
    }
    CHECK(ar_residual_kurtosis(turn_of(x)) == Approx(faulty));
}

TEST_CASE("Deconvolution turns the response to an impulse into an impulse") {
    const std::vector<double> x = ringing();
    CHECK(med_kurtosis(turn_of(x)) == Approx(of_impulse(kPoints)).epsilon(0.02));
    // Noise has no impulse; the filter finds the most impulsive combination of 32 samples.
    const double healthy = med_kurtosis(turn_of(noise(kPoints)));
    CHECK(healthy > 3.0);
    CHECK(healthy < 15.0);
}

TEST_CASE("Filtered signals of rounding size have no kurtosis, and none is a default feature") {
    const std::vector<double> constant(kPoints, 3.0);
    CHECK(std::isnan(ar_residual_kurtosis(turn_of(constant))));
    CHECK(std::isnan(med_kurtosis(turn_of(constant))));
    for (const char* name : {"energy_operator", "ar_residual_kurtosis", "med_kurtosis"}) {
        CHECK(find_feature(name)->from_sensor);
        CHECK(!find_feature(name)->basic());
    }
}

}  // namespace

}  // namespace test_prediction_features
