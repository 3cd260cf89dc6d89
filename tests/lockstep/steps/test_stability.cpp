// Checks the step limit against the method's known bounds: 2.8284 / omega for an undamped mode and
// 2.7853 / rate for an overdamped one (Hairer, Norsett, Wanner, section IV.2). The limit of central
// differences is compared with the spectral radius of a step.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/lockstep/integrators/order.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_step_limit {

dynamics::GearboxMatrices oscillator(double stiffness, double damping) {
    const auto one = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
    return {one(1.0), one(damping), one(stiffness), one(0.0), one(0.0), Eigen::VectorXd::Zero(1)};
}

TEST_CASE("The step limit of Runge-Kutta is 2.828 on the imaginary and 2.785 on the real axis") {
    const double omega = 5e4;
    CHECK(longest_stable_step(oscillator(omega * omega, 0.0), Integrator::rk4) * omega ==
          Approx(2.0 * std::sqrt(2.0)).epsilon(1e-3));
    // Overdamped case: the fast root is close to the damping rate.
    const double rate = 1e7;
    CHECK(longest_stable_step(oscillator(1e6, rate), Integrator::rk4) * rate ==
          Approx(2.7853).epsilon(1e-3));
}

// Spectral radius of one step of central differences on (q, v, previous a), from the method's own
// formulas.
double central_growth(const dynamics::GearboxMatrices& m, double h) {
    const Eigen::Index n = m.mass.rows();
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd inverse = dynamics::inverse(m.mass);
    const Eigen::MatrixXd k = inverse * (m.stiffness + m.centrifugal);
    const Eigen::MatrixXd c = inverse * (m.damping + m.gyroscopic);
    Eigen::MatrixXd a(n, 3 * n), q(n, 3 * n), v(n, 3 * n);
    a << -k, -0.5 * h * k - c, -0.5 * h * c;
    v << Eigen::MatrixXd::Zero(n, n), one, Eigen::MatrixXd::Zero(n, n);
    q << one, h * one, Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd step(3 * n, 3 * n);
    step << q + 0.5 * h * h * a, v + h * a, a;
    // Scaled so that q, h v and h^2 a have similar magnitudes.
    const Eigen::VectorXd scale =
        (Eigen::VectorXd(3 * n) << Eigen::VectorXd::Ones(n), Eigen::VectorXd::Constant(n, h),
         Eigen::VectorXd::Constant(n, h * h))
            .finished();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * step * scale.cwiseInverse().asDiagonal();
    return dynamics::eigenvalues(scaled).cwiseAbs().maxCoeff();
}

// Growth due to the model itself in that time: in the linearized equations centrifugal forces on
// the planets accelerate the rotation.
double own_growth(const dynamics::GearboxMatrices& m, double h) {
    const Eigen::MatrixXd system = state_matrix(m);
    return std::exp(h * dynamics::eigenvalues(system).real().maxCoeff());
}

TEST_CASE("The step limit of central differences is where one mode's step begins to grow") {
    const double omega = 5e4;
    for (const double zeta : {0.0, 0.01, 0.07, 0.2, 1.0, 5.0}) {
        const auto mode = oscillator(omega * omega, 2 * zeta * omega);
        const double limit = longest_stable_step(mode, Integrator::central_difference);
        CHECK(limit * omega ==
              Approx(2 * (std::sqrt(1 + 4 * zeta * zeta) - 2 * zeta)).epsilon(1e-9));
        CHECK(central_growth(mode, 0.999 * limit) <= 1 + 1e-9);
        CHECK(central_growth(mode, 1.001 * limit) > 1 + 1e-4);
    }
    CHECK(std::isinf(longest_stable_step(oscillator(0.0, 0.0), Integrator::central_difference)));
}

TEST_CASE("The step limit of central differences holds for whole gearboxes, rotating or not") {
    const auto& train = test::LiangTrain::instance();
    const auto plan = train.plan(24, 1200, dynamics::Motion::translational_torsional);
    for (const double speedup : {1.0, 1000.0}) {  // gyroscopic forces are significant at 8870 rpm
        for (const double stiffness : {2e8, 1e9}) {
            const auto m = dynamics::assemble(plan.layout, train.inputs(speedup),
                                              std::vector<double>(8, stiffness));
            const double limit = longest_stable_step(m, Integrator::central_difference);
            INFO("speed " << speedup << ", stiffness " << stiffness);
            CHECK(central_growth(m, 0.99 * limit) <= own_growth(m, limit) + 1e-6);
            CHECK(central_growth(m, 1.01 * limit) > own_growth(m, limit) + 1e-3);
        }
    }
    const auto stage =
        dynamics::assemble(dynamics::GearboxLayout(test::TianGearbox::instance().layout()),
                           test::TianGearbox::instance().inputs(), {1.1e9});
    const double limit = longest_stable_step(stage, Integrator::central_difference);
    CHECK(central_growth(stage, 0.99 * limit) <= 1 + 1e-7);
    CHECK(central_growth(stage, 1.01 * limit) > 1 + 1e-3);
}

// Two unit masses joined by a spring and damper: relative motion decays at the damper's rate. A
// centrifugal term makes their common motion grow and decay at 20 1/s.
TEST_CASE("The slowest decay is that of the elastic modes, without the rigid rotation") {
    for (const double damping : {500.0, 0.0}) {
        auto m = dynamics::zero_matrices(2);
        m.mass.setIdentity();
        dynamics::add(m, {"shaft", Eigen::Vector2d(1.0, -1.0), 1e8, damping});
        m.centrifugal.diagonal().setConstant(-400.0);
        CHECK(slowest_decay_1_s(m, Eigen::Vector2d(1.0, 1.0)) == Approx(damping).margin(1e-6));
    }
}

TEST_CASE("The stiff mode of Tian's gearbox is the motor coupling's damper; it requires sdirk3") {
    // Rate of the damper from the printed values, c (1/I_m + 1/I_1); the gears barely move.
    const auto& gearbox = test::TianGearbox::instance();
    const dynamics::GearboxLayout layout = gearbox.layout();
    const dynamics::FixedShaftInputs in = gearbox.inputs();
    const StiffPart stiff = stiffest_part(layout, in, {1.1e9});
    CHECK(stiff.part == "the damper of the motor coupling");
    CHECK(stiff.motion == "pinion_u");
    CHECK(stiff.rate_1_s == Approx(5e5 * (1 / 0.0021 + 1 / 4.3659e-4)).epsilon(1e-3));
    const double step_s =
        longest_stable_step(dynamics::assemble(layout, in, {1.1e9}), Integrator::rk4);
    CHECK(step_s * stiff.rate_1_s == Approx(2.7853).epsilon(1e-3));
    CHECK(choose_integrator(in.mesh_period_s / step_s) == Integrator::sdirk3);

    // A gearbox without strong dampers is stiff only by its springs and is integrated explicitly.
    const auto& train = test::LiangTrain::instance();
    const auto plan = train.plan(24, 1200, dynamics::Motion::translational_torsional);
    const auto inputs = train.inputs();
    const std::vector<double> k(8, 1e9);
    CHECK(stiffest_part(plan.layout, inputs, k).part.find("the spring of planet") == 0);
    const double steps =
        inputs.mesh_period_s /
        longest_stable_step(dynamics::assemble(plan.layout, inputs, k), Integrator::rk4);
    CHECK(choose_integrator(steps) == Integrator::rk4);
}

// Largest error of a mesh period's acceleration and TE, relative to their largest values.
std::pair<double, double> errors(const MeshRecord& ours, const MeshRecord& exact) {
    const auto error = [](const machine::AlignedVector& a, const machine::AlignedVector& b) {
        double largest = 0.0, apart = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            apart = std::max(apart, std::abs(a[i] - b[i]));
            largest = std::max(largest, std::abs(b[i]));
        }
        return apart / largest;
    };
    return {error(ours.acceleration, exact.acceleration), error(ours.te, exact.te)};
}

TEST_CASE(
    "The steps of the implicit integrators keep signals within 0.1 % of their largest value") {
    const auto& gearbox = test::TianGearbox::instance();
    const std::vector<dynamics::GearboxInputs> stage{gearbox.inputs()};
    const auto stage_matrices =
        dynamics::assemble(dynamics::GearboxLayout(gearbox.layout()), stage[0], {1.1e9});
    for (const double low_pass_Hz : {2e3, 10e3}) {
        const auto periodic_orbit = [&](Integrator integrator, double steps) {
            IntegrationPlan plan = gearbox.plan(50, static_cast<int>(std::ceil(steps)), integrator);
            plan.low_pass_rad_s = 2 * std::numbers::pi * low_pass_Hz;
            return run_tile<1>(plan, stage, gearbox.no_fault(1), PeriodicSolution{}).records[0];
        };
        const auto exact = periodic_orbit(Integrator::sdirk3, 10000);
        for (const auto integrator : test::integrators(false)) {
            const double steps =
                implicit_steps(integrator, stage_matrices, gearbox.inputs().mesh_period_s,
                               2 * std::numbers::pi * low_pass_Hz);
            CHECK(steps < 2000);  // rk4 would need 870,000
            const auto [acceleration, te] = errors(periodic_orbit(integrator, steps), exact);
            INFO("low-pass " << low_pass_Hz << " Hz, steps " << steps);
            CHECK(acceleration < 1e-3);
            CHECK(te < 1e-3);
        }
    }

    const auto& train = test::LiangTrain::instance();
    const std::vector<dynamics::GearboxInputs> planetary{train.inputs(10.0)};
    const auto full = dynamics::Motion::translational_torsional;
    const IntegrationPlan fine = train.plan(24, 2400, full);
    const auto exact =
        run_tile<1>(fine, planetary, train.no_fault(1), PeriodicSolution{}).records[0];
    const auto matrices =
        dynamics::assemble(fine.layout, planetary[0], std::vector<double>(8, 1e9));
    for (const auto integrator : test::integrators(false)) {
        const double steps = implicit_steps(integrator, matrices, train.inputs(10.0).mesh_period_s,
                                            fine.low_pass_rad_s);
        const IntegrationPlan plan =
            train.plan(24, static_cast<int>(std::ceil(steps)), full, integrator);
        const auto ours =
            run_tile<1>(plan, planetary, train.no_fault(1), PeriodicSolution{}).records[0];
        const auto [acceleration, te] = errors(ours, exact);
        INFO("steps " << steps);
        CHECK(acceleration < 1e-3);
        CHECK(te < 1e-3);
    }
}

}  // namespace gearpod::lockstep::test_step_limit
