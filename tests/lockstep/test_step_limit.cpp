// The step limit against the method's known bounds: 2.8284 / omega for an undamped mode and
// 2.7853 / rate for an overdamped one (Hairer, Norsett, Wanner, section IV.2).
#include <catch2/catch.hpp>
#include <cmath>

#include "lockstep/step_limit.hpp"

using namespace gearpod;

namespace {

dynamics::GearboxMatrices oscillator(double stiffness, double damping) {
    const auto one = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
    return {one(1.0), one(damping), one(stiffness), one(0.0), one(0.0), Eigen::VectorXd::Zero(1)};
}

}  // namespace

TEST_CASE("The step limit of Runge-Kutta is 2.828 on the imaginary and 2.785 on the real axis") {
    const double omega = 5e4;
    CHECK(lockstep::runge_kutta_limit(oscillator(omega * omega, 0.0)).step_s * omega ==
          Approx(2.0 * std::sqrt(2.0)).epsilon(1e-3));
    // Overdamped: the fast root is close to the damping rate.
    const double rate = 1e7;
    CHECK(lockstep::runge_kutta_limit(oscillator(1e6, rate)).step_s * rate ==
          Approx(2.7853).epsilon(1e-3));
}

TEST_CASE("The slowest decay of an oscillator is half its damping rate") {
    CHECK(lockstep::runge_kutta_limit(oscillator(1e8, 500.0)).slowest_decay_1_s == Approx(250.0));
}
