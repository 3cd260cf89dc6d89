// Checks the measuring chain of a sensor against closed forms: its low-pass in place of another
// one, a resonant mounting, and a delay.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "signals/path/housing_response.hpp"
#include "signals/path/measuring_chain.hpp"

namespace test_measuring_chain {

using namespace gearpod::signals;
using Complex = std::complex<double>;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSampling_Hz = 2000.0;
constexpr int kSamples = 2000;  // one second: harmonics at whole Hz

// Butterworth low-pass of order 4 by its poles on the unit circle.
Complex butterworth(double r) {
    Complex product = 1.0;
    for (const double turns : {5.0, 7.0, 9.0, 11.0}) {
        product *= Complex(0.0, r) - std::polar(1.0, turns * kPi / 8.0);
    }
    return 1.0 / product;
}

// Sine of that frequency with a complex amplitude.
std::vector<double> sine(double f_Hz, Complex amplitude) {
    std::vector<double> signal;
    for (int i = 0; i < kSamples; ++i) {
        signal.push_back((amplitude * std::polar(1.0, 2.0 * kPi * f_Hz * i / kSampling_Hz)).imag());
    }
    return signal;
}

std::vector<double> measured_by(const MeasuringChain& chain, const std::vector<double>& signal) {
    PeriodicResponse response(static_cast<int>(signal.size()));
    response.add(signal, kSampling_Hz, {.modes = {}, .measured = {}, .chain = chain});
    return response.take(chain, kSampling_Hz);
}

}  // namespace

TEST_CASE("A low-pass of its own takes the place of the one that was applied") {
    constexpr double kOwn_Hz = 150.0, kApplied_Hz = 600.0;
    const MeasuringChain chain{.low_pass = {{kOwn_Hz, kApplied_Hz}}, .mounting = {}};
    for (const int f_Hz : {1, 20, 150, 300, 700, 990}) {
        INFO(f_Hz);
        // Sine of amplitude 1 before any low-pass.
        const auto out = measured_by(chain, sine(f_Hz, butterworth(f_Hz / kApplied_Hz)));
        const Complex expected = butterworth(f_Hz / kOwn_Hz);
        CHECK(std::abs(expected) == Approx(1.0 / std::sqrt(1.0 + std::pow(f_Hz / kOwn_Hz, 8.0))));
        const auto reference = sine(f_Hz, expected);
        double largest = 0.0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            largest = std::max(largest, std::abs(out[i] - reference[i]));
        }
        CHECK(largest < 1e-9 * std::abs(expected));
        // The ratio of both Butterworth gains is the amplitude of the chain.
        CHECK(std::abs(chain.at(f_Hz)) ==
              Approx(std::sqrt((1.0 + std::pow(f_Hz / kApplied_Hz, 8.0)) /
                               (1.0 + std::pow(f_Hz / kOwn_Hz, 8.0))))
                  .epsilon(1e-9));
    }
    CHECK(chain.at(0.0) == 1.0);
}

TEST_CASE("A delay of whole samples shifts them, and one of half a sample shifts a sine") {
    std::vector<double> signal(kSamples);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        signal[i] = static_cast<double>(i * i % 17) - 8.0;
    }
    for (const int shift : {7, -3, 0}) {
        const auto out =
            measured_by({.low_pass = {}, .mounting = {}, .delay_s = shift / kSampling_Hz}, signal);
        for (int i = 0; i < kSamples; ++i) {
            const int late = (i + shift + kSamples) % kSamples;
            REQUIRE(out[static_cast<std::size_t>(late)] ==
                    Approx(signal[static_cast<std::size_t>(i)]).margin(1e-9));
        }
    }
    const auto half = measured_by({.low_pass = {}, .mounting = {}, .delay_s = 0.5 / kSampling_Hz},
                                  sine(90.0, 1.0));
    for (int i = 0; i < kSamples; ++i) {
        REQUIRE(half[static_cast<std::size_t>(i)] ==
                Approx(std::sin(2.0 * kPi * 90.0 * (i - 0.5) / kSampling_Hz)).margin(1e-9));
    }
}

TEST_CASE("A mounting responds as one mode with participation 1") {
    const MeasuringChain chain{.low_pass = {}, .mounting = {{320.0, 0.04}}};
    const HousingResponse mode{.modes = {{320.0, 0.04, 1.0}}, .measured = {}};
    for (const double f_Hz : {0.0, 10.0, 250.0, 320.0, 500.0, 5000.0}) {
        INFO(f_Hz);
        CHECK(std::abs(chain.at(f_Hz) - mode.at(f_Hz)) < 1e-12 * std::abs(mode.at(f_Hz)));
    }
    CHECK(std::abs(chain.at(320.0)) == Approx(std::hypot(1.0, 1.0 / 0.08)).epsilon(1e-12));
}

TEST_CASE("A sampling rate of its own keeps its samples and no frequency above half of it") {
    for (const int count : {60, 45}) {
        std::vector<double> signal;
        for (int i = 0; i < count; ++i) {
            signal.push_back(static_cast<double>(i * i % 23) - 9.0);
        }
        for (const int own : {1, 7, 8, 15, 22, 30, 44}) {
            INFO(count << " " << own);
            const double rate = kSampling_Hz * own / count;
            const auto out =
                measured_by({.low_pass = {}, .mounting = {}, .sampling_Hz = rate}, signal);
            // Discrete spectra of both; between the samples they are trigonometric polynomials.
            const auto spectrum = [&](const std::vector<double>& x) {
                std::vector<Complex> values;
                for (int k = 0; k <= count / 2; ++k) {
                    Complex sum = 0.0;
                    for (int i = 0; i < count; ++i) {
                        sum += x[static_cast<std::size_t>(i)] *
                               std::polar(1.0, -2.0 * kPi * (k * i % count) / count);
                    }
                    const bool once = k == 0 || 2 * k == count;
                    values.push_back(sum * ((once ? 1.0 : 2.0) / count));
                }
                return values;
            };
            const auto before = spectrum(signal), after = spectrum(out);
            const auto at = [&](const std::vector<Complex>& x, double turn) {
                double sum = 0.0;
                for (std::size_t k = 0; k < x.size(); ++k) {
                    sum +=
                        (x[k] * std::polar(1.0, 2.0 * kPi * static_cast<double>(k) * turn)).real();
                }
                return sum;
            };
            for (int m = 0; m < own; ++m) {
                const double turn = static_cast<double>(m) / own;
                CHECK(at(after, turn) == Approx(at(before, turn)).margin(1e-10));
            }
            for (int k = own / 2 + 1; k <= count / 2; ++k) {
                CHECK(std::abs(after[static_cast<std::size_t>(k)]) < 1e-12);
            }
        }
    }
    // A rate above that of the samples changes nothing.
    const MeasuringChain faster{.low_pass = {}, .mounting = {}, .sampling_Hz = 2.0 * kSampling_Hz};
    CHECK(faster.own_samples(60, kSampling_Hz) == 60);
}

TEST_CASE("The measuring chain multiplies the response of the housing and of the ring") {
    const MeasuringChain chain{
        .low_pass = {{90.0, 200.0}}, .mounting = {{320.0, 0.04}}, .delay_s = 1e-3};
    const HousingResponse housing{.modes = {{100.0, 0.02, 0.7}}, .measured = {}};
    const HousingResponse ring{.stiff_path = false, .modes = housing.modes, .measured = {}};
    HousingResponse measured;
    measured.measured = {{0.0, 1000.0}, {1.0, {0.0, 2.0}}};
    for (const HousingResponse& without : {housing, ring, measured}) {
        HousingResponse with = without;
        with.chain = chain;
        for (const double f_Hz : {5.0, 100.0, 340.0}) {
            CHECK(std::abs(with.at(f_Hz) - without.at(f_Hz) * chain.at(f_Hz)) < 1e-13);
        }
    }
}

}  // namespace test_measuring_chain
