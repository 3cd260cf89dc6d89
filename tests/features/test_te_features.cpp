#include "features/feature.hpp"
#include "features/speed_features.hpp"
#include "features/te_features.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "tests/numbers.hpp"

namespace gearpod::features::test_te_features {

constexpr double kPi = std::numbers::pi;

using test::sine;

TeTurn te_input(const std::vector<double>& turn, const std::vector<double>& amplitude = {}) {
    return {turn, amplitude, 31, 8};
}

TEST_CASE("A sine has rms A over root 2 and kurtosis 3/2") {
    const std::vector<double> x = sine(3e-5, 31, 31 * 16);
    CHECK(te_rms(te_input(x)) == Approx(3e-5 / std::numbers::sqrt2).epsilon(1e-12));
    CHECK(te_kurtosis(te_input(x)) == Approx(1.5).epsilon(1e-12));
}

TEST_CASE("A square wave has kurtosis 1, normal noise 3") {
    const auto square =  // about its mean
        test::tabulated(100, [](int i) { return i % 2 == 0 ? 4.0 : 1.0; });
    CHECK(te_kurtosis(te_input(square)) == Approx(1.0));
    // The standard error is sqrt(24/n) = 0.008.
    CHECK(te_kurtosis(te_input(test::normal_values(400000, 8, 1.0, 2.0))) ==
          Approx(3.0).margin(0.03));
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

// Checks features of the speed error against closed forms of sines and modulated sines.

constexpr int kTeeth = 31, kPerMesh = 8, kPoints = kTeeth * kPerMesh;

// Averaged transmission error: te(angle) over a turn.
struct Turn {
    template <class Function>
    explicit Turn(const Function& te) : amplitude(kPoints / 2 + 1) {
        for (int i = 0; i < kPoints; ++i) {
            turn.push_back(1e-5 * te(2.0 * std::numbers::pi * i / kPoints));
        }
        signals::OrderSpectrum spectrum(kPoints);
        spectrum.load(turn);
        spectrum.amplitudes(0.0, amplitude);
    }
    TeParts te() const {
        TeParts parts;
        parts.turn = turn;
        parts.amplitude = amplitude;
        parts.mesh_order = kTeeth;
        return parts;
    }
    std::vector<double> turn, amplitude;
};

const Turn kConstant([](double) { return 0.0; });

TEST_CASE("The speed error of one sine has the kurtosis 3/2, that of two equal ones 9/4") {
    const Turn one([](double t) { return std::sin(31.0 * t); });
    const Turn two([](double t) { return std::sin(31.0 * t) / 31.0 + std::cos(7.0 * t) / 7.0; });
    CHECK(te_speed_kurtosis(one.te()) == Approx(1.5));
    CHECK(te_speed_kurtosis(two.te()) == Approx(2.25));
    CHECK(std::isnan(te_speed_kurtosis(kConstant.te())));
}

TEST_CASE("Lines of the fault order count with their speed, relative to the strongest mesh line") {
    // Speeds: 1 at the orders 1, 2 and 5, 7 at order 6, 10 at 31 and 20 at 62.
    const Turn turn([](double t) {
        return std::sin(t) + std::cos(2.0 * t) / 2.0 + std::sin(5.0 * t) / 5.0 +
               7.0 / 6.0 * std::cos(6.0 * t) + 10.0 / 31.0 * std::sin(31.0 * t) +
               20.0 / 62.0 * std::cos(62.0 * t);
    });
    CHECK(te_speed_fault_order(turn.te()) == Approx(3.0 / 20.0));
    CHECK(std::isnan(te_speed_fault_order(kConstant.te())));
}

TEST_CASE("A train of five teeth has the lines below half its mesh order only") {
    TeParts te = kConstant.te();
    const std::vector<double> amplitude{0.0, 1.0, 1.0, 100.0, 100.0, 1.0, 0.0,
                                        0.0, 0.0, 0.0, 0.0,   0.0,   0.0};
    te.amplitude = amplitude;
    te.turn = te.turn.first(24);
    te.mesh_order = 5;
    CHECK(te_speed_fault_order(te) == Approx(3.0 / 5.0));
}

TEST_CASE("Windows of the speed error follow the amplitude modulation of the mesh") {
    // The RMS over a mesh period is 1 + m cos t: largest 1 + m, median 1. The speed of the
    // modulation itself and the length of the period add terms of the size of (m / Z)^2.
    for (const double m : {0.0, 0.2, 0.8}) {
        const Turn turn([m](double t) { return (1.0 + m * std::cos(t)) * std::sin(31.0 * t); });
        CHECK(te_speed_window_ratio(turn.te()) == Approx(1.0 + m).epsilon(3e-3));
    }
    CHECK(std::isnan(te_speed_window_ratio(kConstant.te())));
}

TEST_CASE("A step of the speed in one mesh period raises its window") {
    // Mesh line of speed 1, RMS 1/2^(1/2), and two pulses of +-8 a quarter of a mesh period wide.
    const Turn turn([](double t) {
        const double at = 31.0 * t / (2.0 * std::numbers::pi) - 12.0;
        const double pulse = std::exp(-0.5 * std::pow((at - 0.5) / 0.2, 2));
        return std::sin(31.0 * t) / 31.0 + 8.0 / 31.0 * pulse;
    });
    // The derivative of the pulse alone has an RMS over its mesh period of
    // 8 / (2 pi) (pi^(1/2) / (2 s))^(1/2), s = 0.2; the mesh line is not correlated with it.
    const double pulse_power =
        std::pow(8.0 / (2.0 * std::numbers::pi), 2) * std::sqrt(std::numbers::pi) / (2.0 * 0.2);
    CHECK(te_speed_window_ratio(turn.te()) ==
          Approx(std::sqrt((pulse_power + 0.5) / 0.5)).epsilon(0.1));
}

TEST_CASE("Features of the speed need no sensor and are not default features") {
    for (const char* name :
         {"te_speed_kurtosis", "te_speed_fault_order", "te_speed_window_ratio"}) {
        CHECK(!find_feature(name)->from_sensor);
        CHECK(!find_feature(name)->basic());
    }
}

}  // namespace gearpod::features::test_te_features
