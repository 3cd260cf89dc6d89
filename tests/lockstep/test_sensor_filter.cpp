// The sensor's low-pass against the closed form of a 4th-order Butterworth filter,
// |H|^2 = 1 / (1 + (f / f_c)^8).
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "lockstep/sensor_filter.hpp"

using namespace gearpod::lockstep;

namespace {

// Gain of the stepped filter for a sine at `frequency` (times the cutoff), from its steady
// response.
double gain(double frequency, double steps_per_cutoff_period) {
    const double w = 2 * std::numbers::pi;  // cutoff 1 Hz
    const double h = 1.0 / steps_per_cutoff_period;
    double m[kFilterCoefficients];
    filter_step(w, h, m);
    double z[kFilterStates] = {};
    double sine = 0.0, cosine = 0.0;
    const auto input = [&](double t) { return std::sin(w * frequency * t); };
    const int settle = static_cast<int>(20 / h), measure = static_cast<int>(10 / frequency / h);
    for (int i = 0; i < settle + measure; ++i) {
        const double t = i * h;
        if (i >= settle) {
            sine += z[kFilterOutput] * std::sin(w * frequency * t);
            cosine += z[kFilterOutput] * std::cos(w * frequency * t);
        }
        double next[kFilterStates];
        for (int r = 0; r < 2; ++r) {
            next[r] = m[kFilterXX + 2 * r] * z[0] + m[kFilterXX + 2 * r + 1] * z[1];
            next[2 + r] = m[kFilterYX + 2 * r] * z[0] + m[kFilterYX + 2 * r + 1] * z[1] +
                          m[kFilterYY + 2 * r] * z[2] + m[kFilterYY + 2 * r + 1] * z[3];
        }
        for (int r = 0; r < kFilterStates; ++r) {
            z[r] = next[r] + m[kFilterInput + r] * input(t) +
                   m[kFilterInput + 4 + r] * input(t + h / 2) +
                   m[kFilterInput + 8 + r] * input(t + h);
        }
    }
    return 2.0 * std::hypot(sine, cosine) / measure;
}

double butterworth(double frequency) {
    return 1.0 / std::sqrt(1.0 + std::pow(frequency, 8));
}

}  // namespace

TEST_CASE("The low-pass has the gain of a 4th-order Butterworth filter") {
    for (const double frequency : {0.1, 0.5, 1.0, 2.0, 4.0}) {
        INFO("frequency over cutoff " << frequency);
        CHECK(gain(frequency, 100) == Approx(butterworth(frequency)).epsilon(2e-4));
    }
}

TEST_CASE("The low-pass converges at order 4 in the step") {
    // At twice the cutoff, where the gain is small and its error shows.
    const double coarse = std::abs(gain(2.0, 40) - butterworth(2.0));
    const double fine = std::abs(gain(2.0, 80) - butterworth(2.0));
    CHECK(std::log2(coarse / fine) > 3.5);
}
