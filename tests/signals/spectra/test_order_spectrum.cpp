#include "signals/spectra/order_spectrum.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_order_spectrum {

constexpr double kPi = std::numbers::pi;

// One-sided amplitudes by the definition of the Fourier coefficients.
std::vector<double> direct_amplitudes(const std::vector<double>& x) {
    const std::size_t n = x.size();
    std::vector<double> amplitudes(n / 2 + 1);
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        double re = 0.0;
        double im = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle =
                2.0 * kPi * static_cast<double>(k * i % n) / static_cast<double>(n);
            re += x[i] * std::cos(angle);
            im += x[i] * std::sin(angle);
        }
        const bool single = k == 0 || 2 * k == n;
        amplitudes[k] = (single ? 1.0 : 2.0) * std::hypot(re, im) / static_cast<double>(n);
    }
    return amplitudes;
}

TEST_CASE(
    "Order amplitudes of signal plus noise agree with the Fourier sums, even and odd lengths") {
    std::mt19937_64 engine(2);
    std::normal_distribution<double> normal;
    for (const int points : {31 * 8, 31 * 9, 28 * 5}) {
        std::vector<double> signal(points);
        std::vector<double> noise(points);
        for (int i = 0; i < points; ++i) {
            signal[i] = normal(engine);
            noise[i] = normal(engine);
        }
        OrderSpectrum spectrum(points);
        spectrum.load(signal, noise);
        for (const double factor : {0.0, 0.5, 3.0}) {
            std::vector<double> mixed =
                test::tabulated(points, [&](int i) { return signal[i] + factor * noise[i]; });
            const std::vector<double> expected = direct_amplitudes(mixed);
            std::vector<double> amplitudes(spectrum.orders());
            spectrum.amplitudes(factor, amplitudes);
            REQUIRE(amplitudes.size() == expected.size());
            CHECK(test::largest_difference(amplitudes, expected) < 1e-13);
        }
    }
}

TEST_CASE("A sine of one order has its amplitude at that order alone") {
    const int points = 31 * 16;
    const auto signal = test::tabulated(
        points, [&](int i) { return 2.5 * std::sin(2.0 * kPi * 31.0 * i / points + 0.4) + 0.7; });
    OrderSpectrum spectrum(points);
    spectrum.load(signal);
    std::vector<double> amplitudes(spectrum.orders());
    spectrum.amplitudes(1.0, amplitudes);
    CHECK(amplitudes[0] == Approx(0.7));
    CHECK(amplitudes[31] == Approx(2.5));
    amplitudes[0] = amplitudes[31] = 0.0;
    CHECK(*std::max_element(amplitudes.begin(), amplitudes.end()) < 1e-13);
}

TEST_CASE("Noise that is zero throughout leaves the signal's spectrum unchanged") {
    const auto signal = test::tabulated(62, [](int i) { return std::cos(0.3 * (i * i)); });
    OrderSpectrum spectrum(62);
    std::vector<double> alone(spectrum.orders()), with_other(spectrum.orders());
    spectrum.load(signal);
    spectrum.amplitudes(1.0, alone);
    spectrum.load(signal, std::vector<double>(62, 0.0));
    spectrum.amplitudes(1.0, with_other);
    CHECK(alone == with_other);
}

TEST_CASE("A spectrum refuses signals that are not one turn") {
    OrderSpectrum spectrum(10);
    CHECK_THROWS_AS(spectrum.load(std::vector<double>(9)), std::invalid_argument);
    CHECK_THROWS_AS(spectrum.load(std::vector<double>(10), std::vector<double>(3)),
                    std::invalid_argument);
    CHECK_THROWS_AS(OrderSpectrum(1), std::invalid_argument);
}

}  // namespace gearpod::signals::test_order_spectrum

namespace gearpod::signals::test_mesh_separation {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<double> sampled(int points, const auto& function) {
    return test::tabulated(points, [&](int i) { return function(kTwoPi * i / points); });
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
    CHECK(test::largest_difference(separation.regular(), regular) < 1e-12);
    CHECK(test::largest_difference(separation.residual(), residual) < 1e-12);
    CHECK(test::largest_difference(separation.difference(), rest) < 1e-12);
    CHECK(separation.amplitude()[0] == Approx(5.0));
    CHECK(separation.amplitude()[30] == Approx(0.4));
    CHECK(separation.amplitude()[29] == Approx(0.7));
    CHECK(separation.amplitude()[372] == Approx(0.1));  // the Nyquist order
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
        CHECK(test::largest_difference(sum, turn) < 1e-12);
    }
    CHECK_THROWS_AS(MeshSeparation(7, 2), std::invalid_argument);
    CHECK_THROWS_AS(MeshSeparation(27, 7), std::invalid_argument);
    CHECK_THROWS_AS(MeshSeparation(28, 7).load(std::vector<double>(27)), std::invalid_argument);
}

}  // namespace gearpod::signals::test_mesh_separation
