// Checks the condition indicators against closed forms.
#include "features/feature.hpp"
#include "features/healthy_comparison.hpp"
#include "features/modulation_indicators.hpp"
#include "features/residual_indicators.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "features/tooth_windows.hpp"
#include "features/vibration_statistics.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "tests/numbers.hpp"

namespace gearpod::features::test_condition_indicators {

using test::normal_values;
using test::sine;

TEST_CASE("FM4, M6A and M8A of a normal difference signal are 3, 15 and 105") {
    const auto difference = normal_values(1000000, 8, 2.0, 3.0);
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
    std::vector<double> regular =
        test::tabulated(n, [&](std::size_t i) { return mesh[i] + low[i] + high[i]; });
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
    const auto record = normal_values(100000, 8, 2.0, 3.0);
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

ToothRms<gears::Member::planet> teeth(const std::vector<double>& rms) {
    return {rms};
}

TEST_CASE("The median is the middle value, or the mean of the middle two") {
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0, 3.0, 2.0}) == 2.5);
    CHECK(median({7.0}) == 7.0);
    CHECK(std::isnan(median({})));
}

TEST_CASE("The window ratio of Liang's tooth RMS values of Fig. 5.8 is 76/39") {
    std::vector<double> rms(31, 39.0);
    rms[8] = 76.0;
    CHECK(window_ratio(teeth(rms)) == Approx(76.0 / 39.0));
    CHECK(window_ratio(teeth(std::vector<double>(31, 39.0))) == 1.0);
}

TEST_CASE("The window score compares the worst tooth with the spread of the others") {
    // The others are 1..5: median 3, absolute deviations 2 1 0 1 2, MAD 1.
    CHECK(window_z(teeth({1.0, 2.0, 10.0, 3.0, 4.0, 5.0})) == Approx(7.0 / 1.4826));
    // The worst tooth does not enter the spread, however large it is.
    CHECK(window_z(teeth({1.0, 2.0, 1e6, 3.0, 4.0, 5.0})) == Approx((1e6 - 3.0) / 1.4826));
}

TEST_CASE("The window score of normal teeth is in standard deviations") {
    std::vector<double> rms = normal_values(100000, 12, 100.0, 2.0);
    rms[77] = 120.0;
    CHECK(window_z(teeth(rms)) == Approx(10.0).epsilon(0.02));
}

TEST_CASE("Teeth equal to the last bit give a finite score") {
    CHECK(window_z(teeth(std::vector<double>(31, 39.0))) == 0.0);
    std::vector<double> rms(31, 39.0);
    rms[3] = 39.0 * (1.0 + 1e-15);
    CHECK(window_z(teeth(rms)) < 1e-8);
    rms[3] = 39.0 * 1.5;
    CHECK(window_z(teeth(rms)) == Approx(0.5e6 / 1.4826));
    CHECK(std::isnan(window_z(teeth({}))));
    CHECK(std::isnan(window_ratio(teeth({}))));
}

TEST_CASE("The sensor's rms is the root of its mean square") {
    CHECK(sensor_rms({6.25}) == 2.5);
}

// Checks FM0 of known mesh lines.

constexpr int kTeeth = 31, kPerMesh = 16, kPoints = kTeeth * kPerMesh;

// Averaged turn x(angle), angle from 0 to 2 pi, with the parts that features use.
struct Turn {
    template <class Function>
    explicit Turn(const Function& x) {
        samples = test::tabulated(kPoints,
                                  [&](int i) { return x(2.0 * std::numbers::pi * i / kPoints); });
        parts.load(samples);
        sensor.turn = samples;
        sensor.amplitude = parts.amplitude();
        sensor.mesh_order = kTeeth;
    }
    std::vector<double> samples;
    signals::MeshSeparation parts{kPoints, kTeeth};
    SensorTurn sensor;
};

TEST_CASE("FM0 of one mesh line is 2, and a shock of 3 amplitudes at its peak adds 3") {
    const auto mesh = [](double t) { return 0.4 * std::cos(kTeeth * t); };
    CHECK(fm0(Turn(mesh).sensor) == Approx(2.0));
    // The shock raises every mesh line by up to 2/n of itself.
    const Turn shock([&](double t) { return mesh(t) + (t == 0.0 ? 1.2 : 0.0); });
    const double lines = 0.4 + 7.0 * 2.0 / kPoints * 1.2;
    CHECK(fm0(shock.sensor) == Approx(2.0 / lines));
}

TEST_CASE("Signals without mesh lines have no FM0") {
    const Turn other([](double t) { return 7.0 + std::cos(5.0 * t); });
    const Turn zero([](double) { return 0.0; });
    for (const SensorTurn* turn : {&other.sensor, &zero.sensor}) {
        CHECK(std::isnan(fm0(*turn)));
    }
    CHECK(find_feature("fm0")->from_sensor);
    CHECK(!find_feature("fm0")->basic());
}

}  // namespace gearpod::features::test_condition_indicators
