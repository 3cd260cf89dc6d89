// Checks the sensor's low-pass against the closed form of a 4th-order Butterworth filter, |H|^2 = 1
// / (1 + (f / f_c)^8).
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/filter_coefficients.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_sensor_filter {

// Position within a step of the input of each column of a method's coefficients.
std::vector<double> input_nodes(Integrator integrator) {
    if (integrator == Integrator::rk5) {
        return {0.0, 0.25, 0.25, 0.5, 0.75, 1.0};
    }
    // The newmark method uses the input at the start and the end of a step; central-difference in
    // the middle.
    const std::vector<double> given = stage_nodes(integrator);
    return given.size() == 1   ? std::vector<double>(3, given[0])
           : given.size() == 3 ? given
                               : std::vector<double>{0.0, 0.5, 1.0};
}

// Gain of the stepped filter for a sine at `frequency` (times the cutoff), from its steady
// response.
double gain(Integrator integrator, double frequency, double steps_per_cutoff_period) {
    const double w = 2 * std::numbers::pi;  // cutoff 1 Hz
    const double h = 1.0 / steps_per_cutoff_period;
    double m[kFilterCoefficients];
    filter_step(integrator, w, h, m);
    const std::vector<double> nodes = input_nodes(integrator);
    double z[kFilterStates] = {};
    double sine = 0.0, cosine = 0.0;
    const auto input = [&](double t) { return std::sin(w * frequency * t); };
    const int run_in_steps = static_cast<int>(20 / h),
              measure = static_cast<int>(10 / frequency / h);
    for (int i = 0; i < run_in_steps + measure; ++i) {
        const double t = i * h;
        if (i >= run_in_steps) {
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
            z[r] = next[r];
            for (std::size_t stage = 0; stage < nodes.size(); ++stage) {
                z[r] += m[kFilterInput + kFilterStates * stage + r] * input(t + nodes[stage] * h);
            }
        }
    }
    return 2.0 * std::hypot(sine, cosine) / measure;
}

double butterworth(double frequency) {
    return 1.0 / std::sqrt(1.0 + std::pow(frequency, 8));
}

TEST_CASE("The low-pass has the gain of a 4th-order Butterworth filter") {
    for (const double frequency : {0.1, 0.5, 1.0, 2.0, 4.0}) {
        INFO("frequency over cutoff " << frequency);
        CHECK(gain(Integrator::rk4, frequency, 100) ==
              Approx(butterworth(frequency)).epsilon(2e-4));
        CHECK(gain(Integrator::rk5, frequency, 50) == Approx(butterworth(frequency)).epsilon(2e-4));
        CHECK(gain(Integrator::sdirk3, frequency, 400) ==
              Approx(butterworth(frequency)).epsilon(2e-4));
        CHECK(gain(Integrator::newmark, frequency, 800) ==
              Approx(butterworth(frequency)).epsilon(2e-3));
        CHECK(gain(Integrator::central_difference, frequency, 800) ==
              Approx(butterworth(frequency)).epsilon(2e-3));
    }
}

TEST_CASE("The low-pass converges at its integrator's order in the step") {
    // The gain at twice the cutoff is small, so its error is visible.
    const auto order = [](Integrator integrator, double steps) {
        const double coarse = std::abs(gain(integrator, 2.0, steps) - butterworth(2.0));
        const double fine = std::abs(gain(integrator, 2.0, 2 * steps) - butterworth(2.0));
        return std::log2(coarse / fine);
    };
    CHECK(order(Integrator::rk4, 40) > 3.5);
    CHECK(order(Integrator::rk5, 20) > 4.5);
    CHECK(order(Integrator::sdirk3, 80) > 2.7);
    CHECK(order(Integrator::newmark, 80) == Approx(2.0).margin(0.1));
    CHECK(order(Integrator::central_difference, 80) == Approx(2.0).margin(0.1));
}

}  // namespace gearpod::lockstep::test_sensor_filter
