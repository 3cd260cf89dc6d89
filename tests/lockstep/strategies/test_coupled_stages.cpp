// Checks coupled stages: without shafts they have the bits of single stages; with a shaft they
// agree with an independent integration of the equations of both, and converge with order 2.
#include <Eigen/Dense>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/strategies/coupled_stages.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_coupled_stages {

using test::LiangTrain;
using test::TianGearbox;

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
        layout.mesh_damping = dynamics::MeshDamping::proportional;
        for (const auto gear : {dynamics::pinion, dynamics::gear}) {
            in.bearing_damping_N_s_m[gear] = 2e3;
            in.coupling_damping_N_m_s_rad[gear] = 1.0;
        }
        in.mesh_damping = 1e3 / mean;
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
        p.nodes.stiffness = test::mapped(p.grid.steps, [&](const Step& step) {
            return stiffness(step.phase + 0.5 * step.length);
        });
        p.nodes.damping_shape = p.nodes.stiffness;
        return p;
    }
};

// Stages in a row: the load of each drives the next one. `meshes`: recorded ones of each stage.
struct Train {
    static constexpr double kStiffness_N_m_rad = 3e4, kDamping_N_m_s_rad = 2.0;
    static constexpr int kRunIns = 20;  // length of the run-in, in recorded lengths
    std::vector<Stage> stages;
    std::vector<int> meshes;

    double period(std::size_t stage) const { return double(meshes[0]) / meshes[stage]; }

    // Transmission error of every stage at the samples of its last mesh periods.
    std::vector<std::vector<double>> integrated(int steps) const {
        std::vector<IntegrationPlan> plans;
        for (std::size_t s = 0; s < stages.size(); ++s) {
            plans.push_back(stages[s].plan(steps * meshes[0] / meshes[s]));
        }
        std::vector<CoupledStage> coupled;
        std::vector<CouplingShaft> shafts;
        for (std::size_t s = 0; s < stages.size(); ++s) {
            coupled.push_back({{plans[s], stages[s].lanes, stages[s].no_fault},
                               nullptr,
                               {meshes[s], kRunIns * meshes[s]},
                               period(s)});
            if (s > 0) {
                CouplingShaft& shaft = shafts.emplace_back();
                shaft.stage[0] = s - 1;
                shaft.stage[1] = s;
                shaft.end[0] = {dynamics::u_b, 1.0 / stages[s - 1].layout.base_radius_m[1]};
                shaft.end[1] = {dynamics::u_m, 1.0 / stages[s].layout.base_radius_m[0]};
                shaft.stiffness_N_m_rad = {kStiffness_N_m_rad};
                shaft.damping_N_m_s_rad = {kDamping_N_m_s_rad};
            }
        }
        std::vector<std::vector<double>> te;
        for (const TileResult& result : run_coupled_stages<1>(coupled, shafts, {})) {
            te.emplace_back();
            for (const int content : result.content) {
                const MeshRecord& record = result.records[static_cast<std::size_t>(content)];
                te.back().insert(te.back().end(), record.te.begin(), record.te.end());
            }
        }
        return te;
    }
};

Train two_stages() {
    return {{{1.0 / 570.0, 2e8, 0.2}, {48.0 / 19.0 / 570.0, 3e8, 0.3}}, {48, 19}};
}
Train three_stages() {
    return {{{1.0 / 570.0, 2e8, 0.2}, {2.0 / 570.0, 3e8, 0.3}, {3.0 / 570.0, 1e8, 0.3}},
            {48, 24, 16}};
}

// Integrates the equations of all stages and their shafts as one system by the classical
// Runge-Kutta method.
class WholeTrain {
  public:
    explicit WholeTrain(const Train& train) : train_(train) {
        const auto size = static_cast<Eigen::Index>(train.stages.size()) * kOne;
        mass_ = damping_ = stiffness_ = Eigen::MatrixXd::Zero(size, size);
        force_ = Eigen::VectorXd::Zero(size);
        for (std::size_t s = 0; s < train.stages.size(); ++s) {
            const Stage& stage = train.stages[s];
            const auto m = dynamics::assemble(stage.layout, stage.in, {0.0});
            const auto at = static_cast<Eigen::Index>(s) * kOne;
            mesh_.push_back(Eigen::VectorXd::Zero(size));
            mesh_[s].segment(at, kOne) = dynamics::mesh_row(stage.layout);
            mass_.block(at, at, kOne, kOne) = m.mass;
            damping_.block(at, at, kOne, kOne) = m.damping;
            stiffness_.block(at, at, kOne, kOne) = m.stiffness;
            force_.segment(at, kOne) = m.force;
            if (s > 0) {
                Eigen::VectorXd twist = Eigen::VectorXd::Zero(size);
                twist(at - kOne + dynamics::u_b) =
                    1.0 / train.stages[s - 1].layout.base_radius_m[dynamics::gear];
                twist(at + dynamics::u_m) = -1.0 / stage.layout.base_radius_m[dynamics::pinion];
                stiffness_ += Train::kStiffness_N_m_rad * twist * twist.transpose();
                damping_ += Train::kDamping_N_m_s_rad * twist * twist.transpose();
            }
        }
    }

    // `steps`: per mesh period of the first stage.
    std::vector<std::vector<double>> te(int steps) const {
        const double h = train_.stages[0].period_s / steps;
        Eigen::VectorXd q = Eigen::VectorXd::Zero(force_.size()), v = q;
        std::vector<std::vector<double>> te(train_.stages.size());
        const long recorded = long{train_.meshes[0]} * steps, first = Train::kRunIns * recorded;
        for (long i = 0; i < first + recorded; ++i) {
            for (std::size_t s = 0; s < te.size() && i >= first; ++s) {
                if ((i - first) % (recorded / train_.meshes[s] / 8) == 0) {
                    te[s].push_back(te_of(q, static_cast<Eigen::Index>(s)));
                }
            }
            const double t = static_cast<double>(i) * h;
            const Eigen::VectorXd a1 = acceleration(t, q, v), v2 = v + h / 2 * a1;
            const Eigen::VectorXd a2 = acceleration(t + h / 2, q + h / 2 * v, v2),
                                  v3 = v + h / 2 * a2;
            const Eigen::VectorXd a3 = acceleration(t + h / 2, q + h / 2 * v2, v3), v4 = v + h * a3;
            const Eigen::VectorXd a4 = acceleration(t + h, q + h * v3, v4);
            q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        return te;
    }

  private:
    static constexpr Eigen::Index kOne = dynamics::fixed_shaft_motions;

    Eigen::VectorXd acceleration(double t, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& v) const {
        Eigen::VectorXd f = force_ - damping_ * v - stiffness_ * q;
        for (std::size_t s = 0; s < mesh_.size(); ++s) {
            const Stage& stage = train_.stages[s];
            f -= stage.stiffness(t / stage.period_s) * mesh_[s].dot(q + stage.in.mesh_damping * v) *
                 mesh_[s];
        }
        return mass_.diagonal().cwiseInverse().asDiagonal() * f;
    }
    static double te_of(const Eigen::VectorXd& q, Eigen::Index s) {
        const double radius = TianGearbox::instance().pinion.base_radius();
        return (q(s * kOne + dynamics::u_1) - q(s * kOne + dynamics::u_2)) / radius;
    }

    const Train& train_;
    Eigen::MatrixXd mass_, damping_, stiffness_;
    Eigen::VectorXd force_;
    std::vector<Eigen::VectorXd> mesh_;
};

double range(const std::vector<double>& a) {
    return std::ranges::max(a) - std::ranges::min(a);
}

TEST_CASE("A coupled train agrees with one integration of all its equations", "[coupled]") {
    for (const Train& train : {two_stages(), three_stages()}) {
        const int steps = train.stages.size() == 2 ? 19 * 8 * 4 : 600;
        const auto exact = WholeTrain(train).te(5 * steps);
        const auto coarse = train.integrated(steps), fine = train.integrated(2 * steps);
        for (std::size_t stage = 0; stage < train.stages.size(); ++stage) {
            INFO(train.stages.size() << " stages, stage " << stage);
            const double size = range(exact[stage]);
            const double error = test::largest_difference(fine[stage], exact[stage]) / size;
            CHECK(error < 2e-4);
            CHECK(test::largest_difference(coarse[stage], exact[stage]) / size > 3.0 * error);
        }
    }
}

TEST_CASE("A shaft carries the vibration of a stage to the other one", "[coupled]") {
    const Train train = two_stages();
    Train alone = train;
    alone.stages[1].variation = 0.0;
    const auto both = train.integrated(19 * 8 * 4), one = alone.integrated(19 * 8 * 4);
    // The second stage vibrates although its own stiffness is constant; the first one differs by
    // the vibration of the second one.
    CHECK(range(one[1]) > 1e-3 * range(both[1]));
    CHECK(test::largest_difference(one[0], both[0]) > 1e-4 * range(both[0]));
}

TEST_CASE("Stages without shafts have the bits of single stages", "[coupled]") {
    const LiangTrain& liang = LiangTrain::instance();
    const IntegrationPlan plan = liang.plan(24, 480, dynamics::Motion::translational_torsional,
                                            Integrator::central_difference);
    const auto inputs = test::tabulated(8, [&](int l) -> dynamics::GearboxInputs {
        return liang.inputs(20.0, 1e8 * (1.0 + 0.1 * l));
    });
    const FaultCurves faults =
        liang.ring_side_cracks({0.0, 1e-3, 2e-3, 4e-3, 0.0, 3e-3, 0.0, 1e-3});
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

}  // namespace gearpod::lockstep::test_coupled_stages
