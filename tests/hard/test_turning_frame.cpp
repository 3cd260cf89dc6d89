// Checks speeds just above and just below the critical speed of the rotating carrier frame.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_turning_frame {

using test::LiangTrain;

constexpr Eigen::Index kDegrees = 21;

Eigen::VectorXd rigid_rotation() {
    return dynamics::rigid_rotation(
        LiangTrain::instance().plan(24, 24, dynamics::Motion::translational_torsional).layout);
}

// Largest growth rate (1/s) of M q'' + (C + G) q' + (K - W^2 M_xy) q = 0, by eigenvalues of the
// whole system in the rotating frame. The rigid rotation is projected out.
double growth_rate(const IntegrationPlan& plan, const dynamics::PlanetaryInputs& in) {
    std::vector<double> mean(8, 0.0);
    for (int i = 0; i < 8; ++i) {
        const auto& pair = LiangTrain::instance().pairs;
        for (int p = 0; p < 1000; ++p) {
            mean[static_cast<std::size_t>(i)] += pair.total(PairId{i}, (p + 0.5) / 1000) / 1000;
        }
    }
    const auto m = dynamics::assemble(plan.layout, in, mean);
    const Eigen::VectorXd turn = rigid_rotation();
    const Eigen::VectorXd weighted = m.mass * turn;
    const Eigen::MatrixXd keep = Eigen::MatrixXd::Identity(kDegrees, kDegrees) -
                                 turn * weighted.transpose() / weighted.dot(turn);
    const Eigen::MatrixXd inverse = keep * dynamics::inverse(m.mass);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * kDegrees, 2 * kDegrees);
    constexpr double kUnit_s = 1e-4;
    a.topRightCorner(kDegrees, kDegrees) = keep / kUnit_s;
    a.bottomLeftCorner(kDegrees, kDegrees) =
        -kUnit_s * inverse * (m.stiffness + m.centrifugal) * keep;
    a.bottomRightCorner(kDegrees, kDegrees) = -inverse * (m.damping + m.gyroscopic) * keep;
    return dynamics::eigenvalues(a).real().maxCoeff();
}

// A train of soft bearings, so that its critical speed is low.
dynamics::PlanetaryInputs soft_train(double carrier_rad_s) {
    const auto& train = LiangTrain::instance();
    return train.inputs(carrier_rad_s / train.inputs().carrier_speed_rad_s, 1e7);
}

// The speed between `low` and `high` at which the growth rate becomes positive.
double critical_speed_rad_s(const IntegrationPlan& plan, double low, double high) {
    while (high - low > 1e-4 * high) {
        const double middle = 0.5 * (low + high);
        (growth_rate(plan, soft_train(middle)) > 1e-3 ? high : low) = middle;
    }
    return low;
}

TEST_CASE("Below its critical speed a train converges, above it is reported as unstable") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 240, dynamics::Motion::translational_torsional);
    const double critical = critical_speed_rad_s(plan, 100.0, 5000.0);
    INFO("critical speed " << critical << " rad/s");
    CHECK(critical > 200.0);
    CHECK(critical < 4000.0);
    const std::vector<double> mean = mean_stiffness(plan);
    // The criterion changes at exactly the speed at which the stiffness becomes indefinite.
    CHECK_FALSE(above_critical_speed(plan.layout, soft_train(0.999 * critical), mean));
    CHECK(above_critical_speed(plan.layout, soft_train(1.001 * critical), mean));
    for (const double share : {0.6, 1.5}) {
        const auto in = soft_train(share * critical);
        INFO(share << " of the critical speed");
        const std::vector<dynamics::GearboxInputs> inputs{in};
        const PeriodicSolution solution{.convergence = {.max_meshes = 10000}};
        const TileResult tile = run_tile<1>(plan, inputs, train.no_fault(1), solution);
        const bool stable = share < 1.0;
        CHECK(tile.status[0] == (stable ? LaneStatus::ok : LaneStatus::diverged));
        CHECK(find_instability(plan, in) ==
              (stable ? Instability::none : Instability::rotating_frame));
    }
}

TEST_CASE(
    "Without inertial terms no speed is critical, and stiff bearings are stable at 5000 rpm") {
    const auto& train = LiangTrain::instance();
    const auto fast = train.inputs(5000.0 / 8.87);
    const IntegrationPlan with = train.plan(24, 240, dynamics::Motion::translational_torsional);
    const IntegrationPlan without =
        train.plan(24, 240, dynamics::Motion::translational_torsional, false);
    CHECK_FALSE(above_critical_speed(without.layout, soft_train(5000.0), mean_stiffness(without)));
    CHECK(growth_rate(with, fast) < 1e-3);
    CHECK_FALSE(above_critical_speed(with.layout, fast, mean_stiffness(with)));
    const PeriodicSolution solution{.convergence = {.max_meshes = 10000}, .with_motion = true};
    const std::vector<dynamics::GearboxInputs> inputs{fast};
    const TileResult tile = run_tile<1>(with, inputs, train.no_fault(1), solution);
    REQUIRE(tile.status[0] == LaneStatus::ok);
    // The centrifugal acceleration r W^2 of the carrier stretches every planet's bearing outwards:
    // by m r W^2 / (k - m W^2) on the mean of the four, while the meshes yield.
    const double w = fast.carrier_speed_rad_s;
    const double m = fast.mass_kg[dynamics::planet];
    const double expected = m * 25 * LiangTrain::kModule * w * w / (1e8 - m * w * w);
    double outwards = 0.0;
    const auto& motion = tile.records[0].motion;
    const std::size_t samples = motion.size() / kDegrees;
    for (std::size_t i = 0; i < samples; ++i) {
        for (int n = 0; n < 4; ++n) {
            const double* planet = motion.data() + i * kDegrees + 9 + 3 * n;
            const double psi = n * std::numbers::pi / 2;
            outwards += planet[0] * std::cos(psi) + planet[1] * std::sin(psi);
        }
    }
    CHECK(outwards / (4.0 * static_cast<double>(samples)) == Approx(expected).epsilon(0.02));
}

}  // namespace gearpod::lockstep::test_turning_frame
