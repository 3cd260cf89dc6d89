// Checks selective mass scaling against the natural frequencies of the matrices with and without
// the additional inertia.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/mode_inertia.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_mode_inertia {

using test::LiangTrain;

constexpr double kLimit_Hz = 3000.0;

dynamics::GearboxMatrices liang_matrices() {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 2400, dynamics::Motion::translational_torsional);
    const std::vector<double> stiffness{2e8, 2e8, 2e8, 2e8, 3e8, 3e8, 3e8, 3e8};
    return dynamics::assemble(plan.layout, train.inputs(), stiffness);
}

ModeInertia inertia_at(const dynamics::GearboxMatrices& matrices, double limit_Hz) {
    return mode_inertia(matrices, 2.0 * std::numbers::pi * limit_Hz);
}

TEST_CASE("Selective mass scaling lowers the fast modes to the limit and leaves the others") {
    const dynamics::GearboxMatrices matrices = liang_matrices();
    const ModeInertia inertia = inertia_at(matrices, kLimit_Hz);
    const std::vector<double> before = dynamics::natural_frequencies_Hz(matrices),
                              after = dynamics::natural_frequencies_Hz(
                                  with_mode_inertia(matrices, inertia));
    REQUIRE(inertia.modes == std::ranges::count_if(before, [](double f) { return f > kLimit_Hz; }));
    REQUIRE(inertia.modes > 4);
    CHECK(inertia.fastest_rad_s == Approx(2.0 * std::numbers::pi * before.back()).epsilon(1e-12));
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i] == Approx(std::min(before[i], kLimit_Hz)).epsilon(1e-8).margin(1e-6));
    }
}

TEST_CASE("The tables of selective mass scaling give the accelerations of the heavier gearbox") {
    const dynamics::GearboxMatrices matrices = liang_matrices();
    const ModeInertia inertia = inertia_at(matrices, 1000.0);  // more modes than fill one block
    const Eigen::Index n = matrices.mass.rows();
    REQUIRE(inertia.blocks == 2);
    const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(n, -3.0, 5.0);
    const Eigen::VectorXd exact = dynamics::inverse(matrices.mass + inertia.mass) * force;
    Eigen::VectorXd a = dynamics::inverse(matrices.mass) * force;
    for (int block = 0; block < inertia.blocks; ++block) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(kModesPerBlock);
        const auto at = [&](Eigen::Index i, int k) {
            return static_cast<std::size_t>((block * n + i) * kModesPerBlock + k);
        };
        for (Eigen::Index i = 0; i < n; ++i) {
            for (int k = 0; k < kModesPerBlock; ++k) {
                sum(k) += inertia.in_double.momentum[at(i, k)] * a(i);
            }
        }
        for (Eigen::Index i = 0; i < n; ++i) {
            for (int k = 0; k < kModesPerBlock; ++k) {
                a(i) += inertia.in_double.effect[at(i, k)] * sum(k);
            }
        }
    }
    CHECK((a - exact).norm() < 1e-10 * exact.norm());
}

TEST_CASE("Selective mass scaling allows steps that are longer by the ratio of the frequencies") {
    dynamics::GearboxMatrices matrices = liang_matrices();
    matrices.damping.setZero();
    const ModeInertia inertia = inertia_at(matrices, kLimit_Hz);
    const double before = longest_stable_step(matrices, Integrator::central_difference),
                 after = longest_stable_step(with_mode_inertia(matrices, inertia),
                                             Integrator::central_difference);
    // Without damping the limit is omega h = 2.
    CHECK(before == Approx(2.0 / inertia.fastest_rad_s).epsilon(1e-6));
    CHECK(after == Approx(2.0 / (2.0 * std::numbers::pi * kLimit_Hz)).epsilon(1e-6));
}

TEST_CASE("Without a limit there is no additional inertia") {
    const dynamics::GearboxMatrices matrices = liang_matrices();
    CHECK(inertia_at(matrices, 0.0).modes == 0);
    CHECK(inertia_at(matrices, 1e6).modes == 0);
    CHECK(with_mode_inertia(matrices, ModeInertia{}).mass == matrices.mass);
}

}  // namespace gearpod::lockstep::test_mode_inertia
