#include "features/te_features.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_te_features {

constexpr double kPi = std::numbers::pi;

std::vector<double> sine(double amplitude, int cycles, int points) {
    std::vector<double> x(points);
    for (int i = 0; i < points; ++i) {
        x[i] = amplitude * std::sin(2.0 * kPi * cycles * i / points);
    }
    return x;
}

TeTurn te_input(const std::vector<double>& turn, const std::vector<double>& amplitude = {}) {
    return {turn, amplitude, 31, 8};
}

TEST_CASE("A sine has rms A over root 2 and kurtosis 3/2") {
    const std::vector<double> x = sine(3e-5, 31, 31 * 16);
    CHECK(te_rms(te_input(x)) == Approx(3e-5 / std::numbers::sqrt2).epsilon(1e-12));
    CHECK(te_kurtosis(te_input(x)) == Approx(1.5).epsilon(1e-12));
}

TEST_CASE("A square wave has kurtosis 1, normal noise 3") {
    std::vector<double> square(100);
    for (int i = 0; i < 100; ++i) {
        square[i] = i % 2 == 0 ? 4.0 : 1.0;  // about its mean
    }
    CHECK(te_kurtosis(te_input(square)) == Approx(1.0));

    std::mt19937_64 engine(8);
    std::normal_distribution<double> normal(1.0, 2.0);
    std::vector<double> noise(400000);
    for (double& value : noise) {
        value = normal(engine);
    }
    // The standard error is sqrt(24/n) = 0.008.
    CHECK(te_kurtosis(te_input(noise)) == Approx(3.0).margin(0.03));
}

TEST_CASE("The frequency centre is the amplitude-weighted mean order without the constant part") {
    std::vector<double> amplitude(200, 0.0);
    amplitude[0] = 1000.0;
    amplitude[31] = 3.0;
    amplitude[62] = 1.0;
    CHECK(te_fc(te_input({}, amplitude)) == Approx((31.0 * 3.0 + 62.0) / 4.0));
    // Sidebands of a local fault at low orders lower it.
    amplitude[1] = 1.0;
    CHECK(te_fc(te_input({}, amplitude)) == Approx((31.0 * 3.0 + 62.0 + 1.0) / 5.0));
}

TEST_CASE("FM0 is peak-to-peak over the mesh harmonics below the Nyquist order") {
    const int points = 31 * 8;  // Nyquist order 124 = 4 * 31: harmonics 1 to 3 count
    const std::vector<double> x = sine(2.0, 31, points);
    std::vector<double> amplitude(points / 2 + 1, 0.0);
    amplitude[31] = 2.0;
    amplitude[62] = 0.5;
    amplitude[93] = 0.25;
    amplitude[124] = 100.0;
    CHECK(te_fm0(te_input(x, amplitude)) == Approx(4.0 / 2.75));
    TeTurn input = te_input(x, amplitude);
    input.harmonics = 1;
    CHECK(te_fm0(input) == Approx(2.0));  // a pure sine: 2 A / A
}

TEST_CASE("Features of an exactly constant signal have no value") {
    const std::vector<double> zero(31 * 8, 0.0);
    const std::vector<double> none(31 * 4 + 1, 0.0);
    CHECK(std::isnan(te_kurtosis(te_input(zero))));
    CHECK(std::isnan(te_fc(te_input(zero, none))));
    CHECK(std::isnan(te_fm0(te_input(zero, none))));
    CHECK(te_rms(te_input(zero)) == 0.0);
}

}  // namespace gearpod::features::test_te_features
