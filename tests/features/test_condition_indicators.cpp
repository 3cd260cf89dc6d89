// Checks the condition indicators against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "features/feature.hpp"
#include "features/standardised_moment.hpp"

namespace test_condition_indicators {

using namespace gearpod;
using namespace gearpod::features;

namespace {

std::vector<double> normal_sample(std::size_t count) {
    std::mt19937_64 engine(8);
    std::normal_distribution<double> normal(2.0, 3.0);
    std::vector<double> values(count);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

std::vector<double> sine(double amplitude, int cycles, int points) {
    std::vector<double> values;
    for (int i = 0; i < points; ++i) {
        values.push_back(amplitude * std::sin(2.0 * std::numbers::pi * cycles * i / points));
    }
    return values;
}

TEST_CASE("FM4, M6A and M8A of a normal difference signal are 3, 15 and 105") {
    const auto difference = normal_sample(1000000);
    FeatureInput input;
    input.sensor.difference = difference;
    input.te.difference = difference;
    CHECK(fm4(input) == Approx(3.0).epsilon(0.01));
    CHECK(m6a(input) == Approx(15.0).epsilon(0.03));
    CHECK(m8a(input) == Approx(105.0).epsilon(0.08));
    CHECK(te_fm4(input) == fm4(input));
    CHECK(te_m6a(input) == m6a(input));
    CHECK(te_m8a(input) == m8a(input));
}

TEST_CASE("Moments of a sine are 3/2, 5/2 and 35/8, for any amplitude and mean") {
    auto values = sine(7.0, 3, 1000);
    for (double& value : values) {
        value += 11.0;
    }
    CHECK(standardised_moment(values, 4) == Approx(1.5));
    CHECK(standardised_moment(values, 6) == Approx(2.5));
    CHECK(standardised_moment(values, 8) == Approx(35.0 / 8.0));
}

TEST_CASE("A single shock in n samples has FM4 near n") {
    std::vector<double> difference(1000, 0.0);
    difference[400] = 1.0;
    FeatureInput input;
    input.sensor.difference = difference;
    // Kurtosis of one shock: p (1-p)^4 + (1-p) p^4 over (p (1-p))^2 with p = 1/n.
    const double p = 1e-3, q = 1.0 - p;
    CHECK(fm4(input) == Approx((p * std::pow(q, 4) + q * std::pow(p, 4)) / (p * q * p * q)));
}

TEST_CASE("The crest factor of a sine is the root of two, about its mean") {
    auto turn = sine(3.0, 5, 4000);
    for (double& value : turn) {
        value -= 40.0;
    }
    FeatureInput input;
    input.sensor.turn = turn;
    CHECK(crest_factor(input) == Approx(std::sqrt(2.0)));
}

TEST_CASE("Energy ratio, sideband index and level match the given amplitudes") {
    // Mesh order 20: 2 at 20, 0.3 at 19, 0.1 at 21, and in addition 0.5 at order 7.
    const int n = 800;
    const auto mesh = sine(2.0, 20, n), low = sine(0.3, 19, n), high = sine(0.1, 21, n);
    std::vector<double> regular(n);
    for (std::size_t i = 0; i < regular.size(); ++i) {
        regular[i] = mesh[i] + low[i] + high[i];
    }
    const auto difference = sine(0.5, 7, n);
    std::vector<double> amplitude(n / 2 + 1, 0.0);
    amplitude[20] = 2.0;
    amplitude[19] = 0.3;
    amplitude[21] = 0.1;
    amplitude[7] = 0.5;
    FeatureInput input;
    input.planet_teeth = 20;
    input.sensor.regular = regular;
    input.sensor.difference = difference;
    input.sensor.amplitude = amplitude;
    CHECK(energy_ratio(input) == Approx(0.5 / std::sqrt(4.0 + 0.09 + 0.01)));
    CHECK(sideband_index(input) == Approx(0.2));
    CHECK(sideband_level(input) == Approx(0.4 / std::sqrt(0.5 * (4.0 + 0.09 + 0.01 + 0.25))));
}

TEST_CASE("NA4 and NB4 are a kurtosis in steady state and rise with the square of energy") {
    const auto record = normal_sample(100000);
    std::vector<double> louder(record);
    for (double& value : louder) {
        value *= 2.0;
    }
    FeatureInput input;
    input.healthy.residual_variance = 9.0;
    input.healthy.envelope_variance = 9.0;
    input.sensor.residual = record;
    input.sensor.envelope = record;
    CHECK(na4(input) == Approx(3.0).epsilon(0.03));
    CHECK(nb4(input) == na4(input));
    const double healthy = na4(input);
    input.sensor.residual = louder;
    CHECK(na4(input) == Approx(16.0 * healthy));
}

TEST_CASE("NSDS sums the spectrum above the healthy one") {
    const std::vector<double> healthy{9.0, 1.0, 2.0, 1.0};
    const std::vector<double> now{0.0, 3.0, 1.0, 1.5};
    FeatureInput input;
    input.healthy.amplitude = healthy;
    input.sensor.amplitude = healthy;
    CHECK(nsds(input) == 0.0);
    input.sensor.amplitude = now;
    CHECK(nsds(input) == Approx(2.5 / 4.0));
}

TEST_CASE("Windows of the sun and the ring cover their own teeth") {
    std::vector<double> even(19, 2.0), odd(19, 2.0);
    odd[3] = 5.0;
    FeatureInput input;
    input.tooth_rms = even;
    input.planet = {{}, even, odd, odd};
    input.sun = {odd, even, odd, even};
    input.ring = {even, odd, even, odd};
    CHECK(window_ratio(input) == 1.0);
    CHECK(sun_window_ratio(input) == 2.5);
    CHECK(ring_window_ratio(input) == 1.0);
    CHECK(window_z(input) == 0.0);
    CHECK(sun_window_z(input) > 1e5);
    CHECK(ring_window_z(input) == 0.0);
    CHECK(window_kurtosis(input) == 1.0);
    CHECK(window_crest(input) == 2.5);
    CHECK(window_m8a(input) == 2.5);
    CHECK(sun_window_kurtosis(input) == 1.0);
    CHECK(sun_window_crest(input) == 2.5);
    CHECK(sun_window_m8a(input) == 1.0);
    CHECK(ring_window_kurtosis(input) == 2.5);
    CHECK(ring_window_crest(input) == 1.0);
    CHECK(ring_window_m8a(input) == 2.5);
    input.filtered_rms = 0.25;
    CHECK(frms(input) == 0.25);
}

}  // namespace

}  // namespace test_condition_indicators
