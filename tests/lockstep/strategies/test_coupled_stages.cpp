// Checks coupled stages: without shafts they have the bits of single stages; with a shaft they
// agree with an independent integration of the equations of both, and converge with order 2.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/strategies/coupled_stages.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"

namespace test_coupled_stages {

using namespace gearpod;
using namespace gearpod::lockstep;
using test::LiangTrain;
using test::TianGearbox;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Stage with a mesh stiffness that varies as a sine, so that every solver keeps its order.
struct Stage {
    double period_s, mean_N_m, variation;
    dynamics::FixedShaftLayout layout = TianGearbox::instance().layout();
    dynamics::FixedShaftInputs in = TianGearbox::instance().inputs();
    std::vector<dynamics::GearboxInputs> lanes;
    FaultCurves no_fault = TianGearbox::instance().no_fault(1);

    Stage(double period, double mean, double part)
        : period_s(period), mean_N_m(mean), variation(part) {
        layout.mesh_damping = dynamics::MeshDamping::constant;
        for (const auto gear : {dynamics::pinion, dynamics::gear}) {
            in.bearing_damping_N_s_m[gear] = 2e3;
            in.coupling_damping_N_m_s_rad[gear] = 1.0;
        }
        in.mesh_damping[0] = 1e3;
        in.mesh_period_s = period_s;
        lanes.emplace_back(in);
    }

    double stiffness(double phase) const {
        return mean_N_m * (1.0 + variation * std::sin(kTurn * phase));
    }

    IntegrationPlan plan(int steps) const {
        IntegrationPlan p = TianGearbox::instance().plan(8, steps, Integrator::central_difference);
        p.layout = layout;
        p.grid = make_phase_grid(8, steps, {});
        p.grid.stage_nodes = stage_nodes(p.integrator);
        p.nodes.stiffness.clear();
        for (const Step& step : p.grid.steps) {
            p.nodes.stiffness.push_back(stiffness(step.phase + 0.5 * step.length));
        }
        p.nodes.damping_shape.assign(p.nodes.stiffness.size(), 1.0);
        return p;
    }
};

// Two stages: the load of the first one drives the second one.
struct Train {
    static constexpr double kStiffness_N_m_rad = 3e4, kDamping_N_m_s_rad = 2.0;
    static constexpr int kRunIn = 960, kMeshes = 48, kSecondMeshes = 19;
    Stage first{1.0 / 570.0, 2e8, 0.2};
    Stage second{48.0 / 19.0 / 570.0, 3e8, 0.3};

    CouplingShaft shaft(double stiffness = kStiffness_N_m_rad,
                        double damping = kDamping_N_m_s_rad) const {
        CouplingShaft shaft;
        shaft.stage[1] = 1;
        shaft.end[0] = {dynamics::u_b, 1.0 / first.layout.base_radius_m[dynamics::gear]};
        shaft.end[1] = {dynamics::u_m, 1.0 / second.layout.base_radius_m[dynamics::pinion]};
        shaft.stiffness_N_m_rad = {stiffness};
        shaft.damping_N_m_s_rad = {damping};
        return shaft;
    }

    // Transmission error of both stages at the samples of their last mesh periods.
    std::vector<std::vector<double>> integrated(int steps) const {
        const IntegrationPlan plans[] = {first.plan(steps), second.plan(steps * 48 / 19)};
        const CoupledStage stages[] = {
            {{plans[0], first.lanes, first.no_fault}, nullptr, {kMeshes, kRunIn}},
            {{plans[1], second.lanes, second.no_fault},
             nullptr,
             {kSecondMeshes, kRunIn * kSecondMeshes / kMeshes},
             48.0 / 19.0}};
        const CouplingShaft shafts[] = {shaft()};
        std::vector<std::vector<double>> te;
        for (const TileResult& result : run_coupled_stages<1>(stages, shafts, {})) {
            te.emplace_back();
            for (const int content : result.content) {
                const MeshRecord& record = result.records[static_cast<std::size_t>(content)];
                te.back().insert(te.back().end(), record.te.begin(), record.te.end());
            }
        }
        return te;
    }
};

// Integrates the equations of both stages and their shaft as one system by the classical
// Runge-Kutta method.
class WholeTrain {
  public:
    explicit WholeTrain(const Train& train) : train_(train) {
        const Stage* stages[] = {&train.first, &train.second};
        mass_ = damping_ = stiffness_ = Eigen::MatrixXd::Zero(2 * kOne, 2 * kOne);
        force_ = Eigen::VectorXd::Zero(2 * kOne);
        for (int s = 0; s < 2; ++s) {
            const auto m = dynamics::assemble(stages[s]->layout, stages[s]->in, {0.0});
            const int at = s * kOne;
            mesh_[s] = Eigen::VectorXd::Zero(2 * kOne);
            mesh_[s].segment(at, kOne) = dynamics::mesh_row(stages[s]->layout);
            mass_.block(at, at, kOne, kOne) = m.mass;
            damping_.block(at, at, kOne, kOne) = m.damping;
            stiffness_.block(at, at, kOne, kOne) = m.stiffness;
            force_.segment(at, kOne) = m.force;
        }
        Eigen::VectorXd twist = Eigen::VectorXd::Zero(2 * kOne);
        twist(dynamics::u_b) = 1.0 / train.first.layout.base_radius_m[dynamics::gear];
        twist(kOne + dynamics::u_m) = -1.0 / train.second.layout.base_radius_m[dynamics::pinion];
        stiffness_ += Train::kStiffness_N_m_rad * twist * twist.transpose();
        damping_ += Train::kDamping_N_m_s_rad * twist * twist.transpose();
    }

    std::vector<std::vector<double>> te(int steps_per_mesh) {
        const double h = train_.first.period_s / steps_per_mesh;
        Eigen::VectorXd q = Eigen::VectorXd::Zero(2 * kOne), v = q;
        std::vector<std::vector<double>> te(2);
        const long steps = long{Train::kRunIn + Train::kMeshes} * steps_per_mesh;
        const long first = long{Train::kRunIn} * steps_per_mesh;
        for (long i = 0; i < steps; ++i) {
            for (int s = 0; s < 2; ++s) {
                const long each = steps_per_mesh * (s == 0 ? 19 : 48) / 19 / 8;
                if (i >= first && (i - first) % each == 0) {
                    te[static_cast<std::size_t>(s)].push_back(te_of(q, s));
                }
            }
            const double t = static_cast<double>(i) * h;
            const auto a = [&](double time, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
                return acceleration(time, x, dx);
            };
            const Eigen::VectorXd a1 = a(t, q, v), v2 = v + h / 2 * a1;
            const Eigen::VectorXd a2 = a(t + h / 2, q + h / 2 * v, v2), v3 = v + h / 2 * a2;
            const Eigen::VectorXd a3 = a(t + h / 2, q + h / 2 * v2, v3), v4 = v + h * a3;
            const Eigen::VectorXd a4 = a(t + h, q + h * v3, v4);
            q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        return te;
    }

  private:
    static constexpr int kOne = dynamics::fixed_shaft_motions;

    Eigen::VectorXd acceleration(double t, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& v) const {
        const Stage* stages[] = {&train_.first, &train_.second};
        Eigen::VectorXd f = force_ - damping_ * v - stiffness_ * q;
        for (int s = 0; s < 2; ++s) {
            f -= stages[s]->stiffness(t / stages[s]->period_s) * mesh_[s].dot(q) * mesh_[s];
        }
        return mass_.diagonal().cwiseInverse().asDiagonal() * f;
    }
    double te_of(const Eigen::VectorXd& q, int s) const {
        const double radius = TianGearbox::instance().pinion.base_radius();
        return (q(s * kOne + dynamics::u_1) - q(s * kOne + dynamics::u_2)) / radius;
    }

    const Train& train_;
    Eigen::MatrixXd mass_, damping_, stiffness_;
    Eigen::VectorXd force_, mesh_[2];
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] - b[i]));
    }
    return largest;
}

double range(const std::vector<double>& a) {
    return std::ranges::max(a) - std::ranges::min(a);
}

}  // namespace

TEST_CASE("A coupled train agrees with one integration of all its equations", "[coupled]") {
    const Train train;
    const auto exact = WholeTrain(train).te(19 * 8 * 20);
    const auto coarse = train.integrated(19 * 8 * 4), fine = train.integrated(19 * 8 * 8);
    for (const std::size_t stage : {0u, 1u}) {
        const double size = range(exact[stage]);
        const double error = largest_difference(fine[stage], exact[stage]) / size;
        CHECK(error < 2e-4);
        CHECK(largest_difference(coarse[stage], exact[stage]) / size > 3.0 * error);
    }
}

TEST_CASE("A shaft carries the vibration of a stage to the other one", "[coupled]") {
    const Train train;
    Train alone;
    alone.second.variation = 0.0;
    const auto both = train.integrated(19 * 8 * 4), one = alone.integrated(19 * 8 * 4);
    // The second stage vibrates although its own stiffness is constant; the first one differs by
    // the vibration of the second one.
    CHECK(range(one[1]) > 1e-3 * range(both[1]));
    CHECK(largest_difference(one[0], both[0]) > 1e-4 * range(both[0]));
}

TEST_CASE("Stages without shafts have the bits of single stages", "[coupled]") {
    const LiangTrain& liang = LiangTrain::instance();
    IntegrationPlan plan = liang.plan(24, 480, dynamics::Motion::translational_torsional);
    plan.integrator = Integrator::central_difference;
    plan.grid.stage_nodes = stage_nodes(plan.integrator);
    plan.nodes = tabulate(liang.pairs, plan.grid, dynamics::mesh_damping(plan.layout));
    std::vector<dynamics::GearboxInputs> inputs;
    for (int l = 0; l < 8; ++l) {
        inputs.emplace_back(liang.inputs(20.0, 1e8 * (1.0 + 0.1 * l)));
    }
    const FaultCurves faults = liang.ring_side_cracks({0.0, 1e-3, 2e-3, 4e-3, 0.0, 3e-3, 0.0, 1e-3});
    const FullSolution full{{}, {5, 3}};
    const TileResult expected = run_tile<8>(plan, inputs, faults, full);
    const CoupledStage stages[] = {{{plan, inputs, faults}, nullptr, full.span},
                                   {{plan, inputs, faults}, nullptr, full.span, 0.37}};
    for (const TileResult& result : run_coupled_stages<8>(stages, {}, {})) {
        REQUIRE(result.records.size() == expected.records.size());
        CHECK(result.status == expected.status);
        for (std::size_t k = 0; k < expected.records.size(); ++k) {
            CHECK(result.records[k].acceleration == expected.records[k].acceleration);
            CHECK(result.records[k].te == expected.records[k].te);
        }
    }
}

}  // namespace test_coupled_stages
