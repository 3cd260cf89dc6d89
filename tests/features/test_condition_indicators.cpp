// Checks the condition indicators against closed forms.
#include "features/healthy_comparison.hpp"
#include "features/modulation_indicators.hpp"
#include "features/residual_indicators.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "features/tooth_windows.hpp"
#include "features/vibration_statistics.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_condition_indicators {

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
    SensorTurn input;
    TeParts te;
    input.difference = difference;
    te.difference = difference;
    CHECK(fm4(input) == Approx(3.0).epsilon(0.01));
    CHECK(m6a(input) == Approx(15.0).epsilon(0.03));
    CHECK(m8a(input) == Approx(105.0).epsilon(0.08));
    CHECK(te_fm4(te) == fm4(input));
    CHECK(te_m6a(te) == m6a(input));
    CHECK(te_m8a(te) == m8a(input));
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
    SensorTurn input;
    input.difference = difference;
    // Kurtosis of one shock: p (1-p)^4 + (1-p) p^4 over (p (1-p))^2 with p = 1/n.
    const double p = 1e-3, q = 1.0 - p;
    CHECK(fm4(input) == Approx((p * std::pow(q, 4) + q * std::pow(p, 4)) / (p * q * p * q)));
}

TEST_CASE("The crest factor of a sine is the root of two, about its mean") {
    auto turn = sine(3.0, 5, 4000);
    for (double& value : turn) {
        value -= 40.0;
    }
    SensorTurn input;
    input.turn = turn;
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
    SensorTurn input;
    input.mesh_order = 20;
    input.regular = regular;
    input.difference = difference;
    input.amplitude = amplitude;
    CHECK(energy_ratio(input) == Approx(0.5 / std::sqrt(4.0 + 0.09 + 0.01)));
    CHECK(sideband_index(input) == Approx(0.2));
    CHECK(sideband_level(input) == Approx(0.4 / std::sqrt(0.5 * (4.0 + 0.09 + 0.01 + 0.25))));
}

TEST_CASE("NA4 is a kurtosis in steady state and rises with the square of energy") {
    const auto record = normal_sample(100000);
    std::vector<double> louder(record);
    for (double& value : louder) {
        value *= 2.0;
    }
    const HealthyRecords healthy{9.0};
    SensorTurn input;
    input.residual = record;
    CHECK(na4(input, healthy) == Approx(3.0).epsilon(0.03));
    const double steady = na4(input, healthy);
    input.residual = louder;
    CHECK(na4(input, healthy) == Approx(16.0 * steady));
}

TEST_CASE("Statistics of tooth windows compare the largest value with the median") {
    std::vector<double> even(19, 2.0), odd(19, 2.0);
    odd[3] = 5.0;
    CHECK(window_ratio(ToothRms<gears::Member::sun>{odd}) == 2.5);
    CHECK(window_ratio(ToothRms<gears::Member::ring>{even}) == 1.0);
    CHECK(window_z(ToothRms<gears::Member::planet>{even}) == 0.0);
    CHECK(window_z(ToothRms<gears::Member::sun>{odd}) > 1e5);
    CHECK(window_kurtosis(ToothMoments<gears::Member::planet>{even, odd, odd}) == 1.0);
    CHECK(window_kurtosis(ToothMoments<gears::Member::ring>{odd, even, even}) == 2.5);
    CHECK(window_crest(ToothMoments<gears::Member::planet>{even, odd, even}) == 2.5);
    CHECK(window_m8a(ToothMoments<gears::Member::sun>{odd, odd, even}) == 1.0);
    CHECK(frms(FilteredSensor{0.25}) == 0.25);
}

}  // namespace gearpod::features::test_condition_indicators
