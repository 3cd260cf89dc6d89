// Speeds at which the turning carrier frame itself loses stability, and those just below.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <numbers>

#include "../lockstep/liang_train.hpp"
#include "lockstep/instability.hpp"

using namespace gearpod;
using namespace gearpod::lockstep;
using test::LiangTrain;

namespace {

std::vector<double> mean_pairs(const MarchPlan& plan) {
    std::vector<double> mean(8, 0.0);
    const auto& nodes = plan.nodes.stiffness;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        mean[i % 8] += nodes[i] * 8.0 / static_cast<double>(nodes.size());
    }
    return mean;
}

// Carrier speed at which the springs no longer hold the masses in the turning frame: the smallest W
// with det(K - W^2 M_xy) = 0, M_xy the masses that move in x and y. From there on a static
// displacement grows. Independent of damping and of Coriolis forces, which do no work at rest.
double critical_speed_rad_s(const MarchPlan& plan, const dynamics::PlanetaryInputs& in) {
    const auto m = dynamics::assemble(plan.layout, in, mean_pairs(plan));
    const Eigen::Index n = m.mass.rows();
    Eigen::MatrixXd moving = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        moving(i, i) = i % 3 == 2 ? 0.0 : m.mass(i, i);
    }
    // 1 / W^2 are the eigenvalues of K^-1 M_xy; a weak spring holds the rigid rotation for this.
    const Eigen::VectorXd turn = dynamics::rigid_rotation(plan.layout).normalized();
    const Eigen::MatrixXd held = m.stiffness + 1e8 * turn * turn.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(moving, held,
                                                                           Eigen::EigenvaluesOnly);
    return 1.0 / std::sqrt(solver.eigenvalues().maxCoeff());
}

dynamics::PlanetaryInputs soft_train(double carrier_rad_s) {
    auto in = LiangTrain::instance().inputs(1.0, 1e7);
    const double speedup = carrier_rad_s / in.carrier_speed_rad_s;
    in = LiangTrain::instance().inputs(speedup, 1e7);
    return in;
}

}  // namespace

TEST_CASE("Below its critical speed a train settles, above it is reported as unstable") {
    const auto& train = LiangTrain::instance();
    const MarchPlan plan = train.plan(24, 240, dynamics::Motion::translational_torsional);
    const double critical = critical_speed_rad_s(plan, soft_train(1.0));
    INFO("critical speed " << critical << " rad/s");
    CHECK(critical > 300.0);
    CHECK(critical < 3000.0);
    for (const double share : {0.5, 0.8, 1.3, 2.0}) {
        const auto in = soft_train(share * critical);
        INFO(share << " of the critical speed");
        const double growth = growth_per_mesh(plan, in, 1);
        CHECK((growth > 1.0 + 1e-5) == (share > 1.0));
        const std::vector<dynamics::GearboxInputs> inputs{in};
        TileSettings settings;
        settings.max_meshes = 10000;
        settings.tolerance = 1e-6;
        const TileResult tile = run_tile<1>(plan, inputs, train.no_fault(1), settings);
        const bool stable = share < 1.0;
        CHECK(tile.status[0] == (stable ? LaneStatus::ok : LaneStatus::diverged));
        CHECK(find_instability(plan, in) ==
              (stable ? Instability::none : Instability::turning_frame));
    }
}
