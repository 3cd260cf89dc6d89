#include "signals/spectra/resampling.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_order_tracking {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TEST_CASE("Samples on the grid, or on a multiple of it, are used unchanged") {
    std::vector<double> phase, signal;
    for (int i = 0; i < 96; ++i) {
        phase.push_back(2.0 + i / 12.0);
        signal.push_back(std::sqrt(i));
    }
    const OrderTracking tracking(phase);
    CHECK(tracking.meshes(12) == 8);
    CHECK(tracking.resample(signal, 12, 8) == signal);
    const auto fourth = tracking.resample(signal, 3, 8);
    for (std::size_t i = 0; i < fourth.size(); ++i) {
        CHECK(fourth[i] == signal[4 * i]);
    }
}

TEST_CASE("A speed that rises by half is tracked") {
    // Phase phi(t) = 20 t + t^2 over 10 s, sampled at 1 kHz; the signal has orders 1 and 3.
    const auto of_phase = [](double phase) {
        return std::sin(kTwoPi * phase) + 0.3 * std::cos(3.0 * kTwoPi * phase);
    };
    std::vector<double> phase, signal;
    for (int i = 0; i <= 10000; ++i) {
        const double t = 1e-3 * i;
        phase.push_back(20.0 * t + t * t);
        signal.push_back(of_phase(phase.back()));
    }
    const OrderTracking tracking(phase);
    CHECK(tracking.meshes(40) == 300);
    const auto resampled = tracking.resample(signal, 40, 300);
    double worst = 0.0;
    for (std::size_t i = 40; i + 40 < resampled.size(); ++i) {  // not at the ends
        worst = std::max(worst, std::abs(resampled[i] - of_phase(static_cast<double>(i) / 40.0)));
    }
    CHECK(worst < 1e-3);
}

// The interpolant of exp(2 pi i f n) has the line f with weight 1 / (1 + S) and its images f - k
// with the rest, S = sum over k != 0 of (f / (f - k))^4. The total error is at most 2 S / (1 + S).
TEST_CASE("The error of a sine at a tenth and at a fifth of the sampling rate matches the theory") {
    for (const double share : {0.1, 0.2}) {
        double images = 0.0;
        for (int k = 1; k < 200; ++k) {
            images += std::pow(share / (share - k), 4) + std::pow(share / (share + k), 4);
        }
        const double bound = 2.0 * images / (1.0 + images);
        std::vector<double> phase, signal;
        for (int i = 0; i < 2000; ++i) {
            phase.push_back(0.01 * i);
            signal.push_back(std::sin(kTwoPi * share * i));
        }
        const OrderTracking tracking(phase);
        const auto resampled = tracking.resample(signal, 73, 19);
        double worst = 0.0;
        for (std::size_t i = 73; i + 73 < resampled.size(); ++i) {
            const double exact = std::sin(kTwoPi * share * 100.0 * static_cast<double>(i) / 73.0);
            worst = std::max(worst, std::abs(resampled[i] - exact));
        }
        CHECK(worst <= bound);
        CHECK(worst > 0.8 * bound);
    }
}

TEST_CASE("Decreasing phases and recordings that are too short are refused") {
    CHECK_THROWS_AS(OrderTracking({0.0}), std::invalid_argument);
    CHECK_THROWS_AS(OrderTracking({0.0, 1.0, 1.0}), std::invalid_argument);
    const OrderTracking tracking({0.0, 0.5, 1.0, 1.5});
    CHECK(tracking.meshes(2) == 2);
    CHECK_THROWS_AS(tracking.resample(std::vector<double>(4), 2, 3), std::invalid_argument);
    CHECK_THROWS_AS(tracking.resample(std::vector<double>(3), 2, 2), std::invalid_argument);
}

}  // namespace gearpod::signals::test_order_tracking

// Checks values of periodic signals between their samples against sums of harmonics.

namespace gearpod::test_periodic_interpolation {

using signals::PeriodicInterpolation;

// Mean, and harmonics up to a fifth of the number of samples.
double sum_of_harmonics(double position, std::size_t samples) {
    double sum = 0.3;
    for (const double share : {0.02, 0.1, 0.2}) {
        const double harmonic = std::floor(share * static_cast<double>(samples));
        sum += std::cos(
            2.0 * std::numbers::pi * harmonic * position / static_cast<double>(samples) + harmonic);
    }
    return sum;
}

TEST_CASE("A periodic signal is interpolated like its harmonics, at any position") {
    for (const std::size_t samples : {100U, 101U, 1240U}) {
        std::vector<double> period;
        for (std::size_t i = 0; i < samples; ++i) {
            period.push_back(sum_of_harmonics(static_cast<double>(i), samples));
        }
        PeriodicInterpolation interpolation(static_cast<int>(samples));
        const auto signal = interpolation.spline(period);
        for (double position = -2.5 * static_cast<double>(samples);
             position < 3.5 * static_cast<double>(samples); position += 0.377) {
            CHECK(signal(position) == Approx(sum_of_harmonics(position, samples)).margin(1e-4));
        }
    }
}

TEST_CASE("Periods of three samples or of another length are refused") {
    CHECK_THROWS_AS(PeriodicInterpolation(3), std::invalid_argument);
    CHECK_THROWS_AS(PeriodicInterpolation(5).spline(std::vector<double>{1.0, 2.0, 3.0, 4.0}),
                    std::invalid_argument);
}

}  // namespace gearpod::test_periodic_interpolation
