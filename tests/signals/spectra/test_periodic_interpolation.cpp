// Checks values of periodic signals between their samples against sums of harmonics.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "signals/spectra/periodic_interpolation.hpp"

namespace test_periodic_interpolation {

using gearpod::signals::PeriodicInterpolation;

namespace {

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

}  // namespace

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

}  // namespace test_periodic_interpolation
