// Checks the implicit integrators against a much finer integration by another method, a conserved
// energy and each other's bits.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/integrators/order.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_implicit {

using test::every;
using test::integrate_meshes;
using test::Integrated;
using test::largest_difference;
using test::LiangTrain;
using test::state_at;
using test::TianGearbox;

const std::vector<Integrator> kImplicitOnes = test::integrators(false);

IntegrationPlan liang_plan(int steps, dynamics::Motion motion, Integrator integrator) {
    return LiangTrain::instance().plan(24, steps, motion, integrator);
}

// The record of a tile of eight, recomputed from tiles of W.
template <int W, class Faults>
void check_lanes(const IntegrationPlan& plan, const std::vector<dynamics::GearboxInputs>& inputs,
                 const Faults& faults, const Solution& solution, std::size_t record,
                 const TileResult& eight) {
    for (std::size_t first = 0; first < 8; first += W) {
        const TileResult tile =
            run_tile<W>(plan, std::span(inputs).subspan(first, W), faults(first, W), solution);
        for (std::size_t l = 0; l < W; ++l) {
            const MeshRecord &a = tile.records[record], &b = eight.records[record];
            CHECK(every(W, a.acceleration, l) == every(8, b.acceleration, first + l));
            CHECK(every(W, a.te, l) == every(8, b.te, first + l));
        }
    }
}

TEST_CASE("The implicit integrators keep their order across contact transitions") {
    const auto& train = LiangTrain::instance();
    const auto in = train.inputs(20.0);
    for (const auto motion :
         {dynamics::Motion::translational_torsional, dynamics::Motion::torsional}) {
        const IntegrationPlan fine = liang_plan(9600, motion, Integrator::rk4);
        const std::vector<double> k(fine.nodes.stiffness.begin(), fine.nodes.stiffness.begin() + 8);
        const Eigen::VectorXd rest =
            dynamics::static_equilibrium(dynamics::assemble(fine.layout, in, k));
        const Integrated exact = integrate_meshes(fine, in, state_at(fine, rest), 2);
        for (const Integrator integrator : kImplicitOnes) {
            std::vector<double> motions, sensors;
            for (const int steps : {2400, 4800}) {
                const IntegrationPlan plan = liang_plan(steps, motion, integrator);
                const Integrated m = integrate_meshes(plan, in, state_at(plan, rest), 2);
                motions.push_back(largest_difference(m.state.q, exact.state.q));
                sensors.push_back(
                    largest_difference(m.record.acceleration, exact.record.acceleration));
            }
            const double order = facts(integrator).order;
            CHECK(std::log2(motions[0] / motions[1]) == Approx(order).margin(0.25));
            CHECK(std::log2(sensors[0] / sensors[1]) == Approx(order).margin(0.25));
        }
    }
}

TEST_CASE("Without nodes on the contact transitions the order of every integrator drops to 1") {
    const auto& train = LiangTrain::instance();
    const auto in = train.inputs(20.0);
    const auto motion = dynamics::Motion::torsional;
    const IntegrationPlan fine = liang_plan(9600, motion, Integrator::rk4);
    const std::vector<double> k(fine.nodes.stiffness.begin(), fine.nodes.stiffness.begin() + 8);
    const TileState start =
        state_at(fine, dynamics::static_equilibrium(dynamics::assemble(fine.layout, in, k)));
    const Integrated exact = integrate_meshes(fine, in, start, 2);
    const auto error = [&](Integrator integrator, int steps, bool nodes) {
        IntegrationPlan plan = liang_plan(steps, motion, integrator);
        if (!nodes) {
            plan.grid = make_phase_grid(24, steps, {});
            plan.grid.stage_nodes = stage_nodes(integrator);
            plan.nodes = tabulate(train.pairs, plan.grid, dynamics::mesh_damping(plan.layout));
        }
        return largest_difference(integrate_meshes(plan, in, start, 2).state.q, exact.state.q);
    };
    for (const Integrator integrator : {Integrator::rk4, Integrator::newmark, Integrator::sdirk3}) {
        // The position of a transition within its step is random: mean of three grids, over three
        // octaves.
        double coarse = 0.0, close = 0.0;
        for (const int more : {0, 24, 48}) {
            coarse += error(integrator, 2400 + more, false);
            close += error(integrator, 8 * (2400 + more), false);
        }
        INFO("integrator " << static_cast<int>(integrator));
        CHECK(std::log2(coarse / close) / 3.0 == Approx(1.0).margin(0.3));
        CHECK(close / 3.0 > 5.0 * error(integrator, 19200, true));
    }
}

TEST_CASE("The implicit integrators keep their order on a smooth stiffness") {
    const dynamics::FixedShaftInputs in = test::soft_tian();
    const IntegrationPlan fine = test::smooth_plan(3200, Integrator::rk4);
    Eigen::VectorXd away = dynamics::static_equilibrium(dynamics::assemble(fine.layout, in, {8e8}));
    away(dynamics::u_1) += 2e-6;
    const Integrated exact = integrate_meshes(fine, in, state_at(fine, away), 3);
    for (const Integrator integrator : kImplicitOnes) {
        std::vector<double> errors;
        for (const int steps : {200, 400, 800}) {
            const IntegrationPlan plan = test::smooth_plan(steps, integrator);
            errors.push_back(largest_difference(
                integrate_meshes(plan, in, state_at(plan, away), 3).state.q, exact.state.q));
        }
        const double order = facts(integrator).order;
        CHECK(std::log2(errors[0] / errors[1]) == Approx(order).margin(0.25));
        CHECK(std::log2(errors[1] / errors[2]) == Approx(order).margin(0.15));
    }
}

double energy(const dynamics::GearboxMatrices& m, const TileState& s) {
    const Eigen::Map<const Eigen::VectorXd> q(s.q.data(), m.mass.rows());
    const Eigen::Map<const Eigen::VectorXd> v(s.v.data(), m.mass.rows());
    return 0.5 * v.dot(m.mass * v) + 0.5 * q.dot(m.stiffness * q);
}

// Tian's stage without damping and load.
dynamics::FixedShaftInputs undamped_stage() {
    dynamics::FixedShaftInputs in = TianGearbox::instance().inputs();
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.bearing_damping_N_s_m[g] = in.coupling_damping_N_m_s_rad[g] = 0.0;
    }
    in.mesh_damping = in.motor_torque_N_m = in.load_torque_N_m = 0.0;
    return in;
}

TEST_CASE("Newmark conserves the energy of an undamped, unloaded gearbox of constant stiffness") {
    dynamics::PlanetaryInputs train = LiangTrain::instance().inputs(20.0);
    std::fill(std::begin(train.bearing_damping_N_s_m), std::end(train.bearing_damping_N_s_m), 0.0);
    std::fill(std::begin(train.force_N), std::end(train.force_N), 0.0);
    train.support_damping_N_s_m = train.mesh_damping = 0.0;

    IntegrationPlan planetary =
        liang_plan(1200, dynamics::Motion::translational_torsional, Integrator::newmark);
    std::get<dynamics::PlanetaryLayout>(planetary.layout).inertial_terms = false;
    const IntegrationPlan torsional =
        liang_plan(1200, dynamics::Motion::torsional, Integrator::newmark);
    const IntegrationPlan fixed_shaft = TianGearbox::instance().plan(20, 200, Integrator::newmark);
    const std::vector<std::pair<IntegrationPlan, dynamics::GearboxInputs>> scenes{
        {planetary, train}, {torsional, train}, {fixed_shaft, undamped_stage()}};
    for (auto [plan, in] : scenes) {
        std::fill(plan.nodes.stiffness.begin(), plan.nodes.stiffness.end(), 6e8);
        const std::vector<double> k(static_cast<std::size_t>(plan.nodes.pairs), 6e8);
        const auto matrices = dynamics::assemble(plan.layout, in, k);
        Eigen::VectorXd away = 1e-6 * Eigen::VectorXd::LinSpaced(matrices.mass.rows(), -1.0, 2.0);
        const TileState start = state_at(plan, away);
        const Integrated m = integrate_meshes(plan, in, start, 20);
        CHECK(energy(matrices, m.state) == Approx(energy(matrices, start)).epsilon(1e-10));
        CHECK(largest_difference(m.state.q, start.q) > 1e-7);  // the state did change
    }
}

TEST_CASE("Sdirk3 damps modes that its steps cannot resolve") {
    // An undamped stage a million times stiffer than Tian's, in 60 steps of many periods each.
    // Newmark's method conserves its energy.
    dynamics::FixedShaftInputs in = undamped_stage();
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.bearing_stiffness_N_m[g] *= 1e6;
        in.coupling_stiffness_N_m_rad[g] *= 1e6;
    }
    for (const auto integrator : {Integrator::sdirk3, Integrator::newmark}) {
        IntegrationPlan plan = TianGearbox::instance().plan(20, 60, integrator);
        plan.grid = make_phase_grid(20, 60, {});
        plan.grid.stage_nodes = stage_nodes(integrator);
        plan.nodes.stiffness.assign(180, 8e14);
        plan.nodes.damping_shape = plan.nodes.stiffness;
        const auto m = dynamics::assemble(plan.layout, in, {8e14});
        const TileState start = state_at(plan, 1e-6 * Eigen::VectorXd::LinSpaced(8, -1.0, 2.0));
        const double left =
            energy(m, integrate_meshes(plan, in, start, 1).state) / energy(m, start);
        if (integrator == Integrator::newmark) {
            CHECK(left == Approx(1.0).epsilon(1e-6));
        } else {
            CHECK(left < 1e-5);
        }
    }
}

TEST_CASE("Implicit integrators converge to the periodic orbit of Runge-Kutta") {
    const auto& train = LiangTrain::instance();
    const std::vector<dynamics::GearboxInputs> one{train.inputs(10.0)};
    const auto full = dynamics::Motion::translational_torsional;
    const TileResult exact = run_tile<1>(liang_plan(4800, full, Integrator::rk4), one,
                                         train.no_fault(1), PeriodicSolution{});
    const double largest = test::largest_magnitude(exact.records[0].acceleration);
    for (const Integrator integrator : kImplicitOnes) {
        const TileResult tile = run_tile<1>(liang_plan(4800, full, integrator), one,
                                            train.no_fault(1), PeriodicSolution{});
        REQUIRE(tile.status[0] == LaneStatus::ok);
        CHECK(largest_difference(tile.records[0].acceleration, exact.records[0].acceleration) <
              2e-3 * largest);
    }
}

TEST_CASE(
    "Implicit integration gives the same bits for eight lanes, four and one, on every instruction "
    "set") {
    const auto& train = LiangTrain::instance();
    const std::vector<double> depths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4.28e-3, 6e-3, 8.5e-3};
    const auto inputs = test::tabulated(8, [&](int l) {
        return dynamics::GearboxInputs(train.inputs(10.0 + l, 1e8 * (0.8 + 0.05 * l)));
    });
    const FullSolution solution{.convergence = {.max_meshes = 4}, .span = {.meshes = 6}};
    for (const Integrator integrator : kImplicitOnes) {
        const IntegrationPlan plan =
            liang_plan(240, dynamics::Motion::translational_torsional, integrator);
        const auto cracks = [&](std::size_t first, std::ptrdiff_t count) {
            const auto depth = depths.begin() + static_cast<std::ptrdiff_t>(first);
            return train.ring_side_cracks({depth, depth + count});
        };
        const auto faults = cracks(0, 8);
        const TileResult wide = run_tile<8>(plan, inputs, faults, solution);
        check_lanes<4>(plan, inputs, cracks, solution, 5, wide);
        check_lanes<1>(plan, inputs, cracks, solution, 5, wide);
        test::for_each_instruction_set([&] {
            const TileResult other = run_tile<8>(plan, inputs, faults, solution);
            check_lanes<4>(plan, inputs, cracks, solution, 5, wide);
            CHECK(other.records[5].acceleration == wide.records[5].acceleration);
            CHECK(other.records[5].te == wide.records[5].te);
        });
    }
}

TEST_CASE("Implicit and explicit integration of separating meshes agree") {
    // A light load on Tian's gearbox with soft dampers: a large transmission error makes the teeth
    // bounce, also against their back flanks.
    const auto& gearbox = TianGearbox::instance();
    dynamics::FixedShaftInputs in = gearbox.inputs();
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.coupling_damping_N_m_s_rad[g] = 5.0;
        in.bearing_damping_N_s_m[g] = 1.8e3;
    }
    in.motor_torque_N_m = 1.0;
    in.load_torque_N_m = 48.0 / 19.0;
    const auto plan_of = [&](int steps, Integrator integrator, double error_m,
                             dynamics::MeshLaw law) {
        IntegrationPlan plan = gearbox.plan(40, steps, integrator);
        plan.mesh_law = law;
        for (const Step& step : plan.grid.steps) {
            for (const double node : plan.grid.stage_nodes) {
                const double angle = 2 * std::numbers::pi * (step.phase + node * step.length);
                plan.nodes.error.push_back(error_m * std::sin(angle));
                plan.nodes.error_rate.push_back(2 * std::numbers::pi * error_m * std::cos(angle));
            }
        }
        return plan;
    };
    const auto run = [&](const IntegrationPlan& plan, double backlash_m, int meshes) {
        in.backlash_m = backlash_m;
        const Eigen::VectorXd rest = dynamics::static_equilibrium(
            dynamics::assemble(plan.layout, in, {plan.nodes.stiffness[0]}));
        return integrate_meshes(plan, in, state_at(plan, rest), meshes).state.q;
    };
    using dynamics::MeshLaw;
    for (const double backlash_m : {dynamics::kNoBackContact, 3e-6}) {
        const auto exact =
            run(plan_of(12800, Integrator::rk4, 5e-6, MeshLaw::separating), backlash_m, 2);
        const auto linear =
            run(plan_of(12800, Integrator::rk4, 5e-6, MeshLaw::with_error), backlash_m, 2);
        const double scale = test::largest_magnitude(exact);
        CHECK(largest_difference(exact, linear) > 0.1 * scale);  // the teeth lost contact
        for (const Integrator integrator : kImplicitOnes) {
            const auto separating =
                run(plan_of(6400, integrator, 5e-6, MeshLaw::separating), backlash_m, 2);
            CHECK(largest_difference(separating, exact) < 2e-3 * scale);
            const auto with_error =
                run(plan_of(6400, integrator, 5e-6, MeshLaw::with_error), backlash_m, 2);
            CHECK(largest_difference(with_error, linear) < 1e-4 * scale);
        }
    }
    // Contact is never lost under full load and a small error: the motion equals the linear mesh's.
    in = gearbox.inputs();
    for (const Integrator integrator : kImplicitOnes) {
        const auto separating = run(plan_of(400, integrator, 1e-7, MeshLaw::separating), 1e-4, 2);
        const auto linear = run(plan_of(400, integrator, 1e-7, MeshLaw::with_error), 1e-4, 2);
        CHECK(separating == linear);
    }

    // Lanes lose and regain contact in different iterations, and keep their bits.
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.coupling_damping_N_m_s_rad[g] = 5.0;
    }
    std::vector<dynamics::GearboxInputs> lanes;
    for (int l = 0; l < 8; ++l) {
        in.motor_torque_N_m = 0.5 * l;
        in.load_torque_N_m = in.motor_torque_N_m * 48.0 / 19.0;
        in.backlash_m = 1e-6 * (1 + l);
        lanes.push_back(in);
    }
    for (const Integrator integrator : kImplicitOnes) {
        const IntegrationPlan plan = plan_of(800, integrator, 5e-6, MeshLaw::separating);
        const FullSolution solution{.convergence = {.max_meshes = 1}, .span = {.meshes = 3}};
        const TileResult wide = run_tile<8>(plan, lanes, gearbox.no_fault(8), solution);
        const auto healthy = [&](std::size_t, int count) { return gearbox.no_fault(count); };
        check_lanes<4>(plan, lanes, healthy, solution, 2, wide);
        check_lanes<1>(plan, lanes, healthy, solution, 2, wide);
    }
}

// Checks sparse factors against the dense solver of Eigen.

// Arrow matrix: `spokes` blocks of two that couple only with the last three rows; not symmetric.
Eigen::MatrixXd arrow(int spokes, std::mt19937& engine) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const int n = 2 * spokes + 3;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const bool hub = i >= 2 * spokes || j >= 2 * spokes;
            if (hub || i / 2 == j / 2) {
                m(i, j) = uniform(engine) + (i == j ? 2.0 * n : 0.0);
            }
        }
    }
    return m;
}

// Solves A x = g with the algorithm of the lockstep stage.
Eigen::VectorXd solve(const SparseLu& lu, const Eigen::MatrixXd& f, Eigen::VectorXd x) {
    const auto substitute = [&](const SparseEntries& entries) {
        for (std::size_t e = 0; e < entries.to.size(); ++e) {
            x(entries.to[e]) -= f(entries.to[e], entries.from[e]) * x(entries.from[e]);
        }
    };
    substitute(lu.lower);
    x.array() /= f.diagonal().array();
    substitute(lu.upper);
    return x;
}

TEST_CASE("Sparse factors give the dense solution for any order of the rows") {
    std::mt19937 engine(1);
    for (const int spokes : {1, 4, 8}) {
        const Eigen::MatrixXd tidy = arrow(spokes, engine);
        Eigen::PermutationMatrix<Eigen::Dynamic> mix(tidy.rows());
        mix.setIdentity();
        std::shuffle(mix.indices().begin(), mix.indices().end(), engine);
        const Eigen::MatrixXd m = mix * tidy * mix.transpose();
        const SparseLu lu = eliminate(m);
        const Eigen::VectorXd g = Eigen::VectorXd::LinSpaced(m.rows(), -1.0, 2.0);
        const Eigen::VectorXd exact = m.partialPivLu().solve(g);
        CHECK((solve(lu, factors(lu, m), g) - exact).norm() < 1e-13 * exact.norm());
        // Elimination of an arrow from its spokes causes no fill-in: the factors have its entries.
        const int entries = static_cast<int>((m.array() != 0.0).count());
        CHECK(lu.lower.size() + lu.upper.size() + m.rows() == entries);
    }
}

TEST_CASE("Entries are the nonzero elements, column by column") {
    Eigen::MatrixXd m(2, 2);
    m << 1.0, 0.0, 3.0, -4.0;
    const SparseEntries entries = nonzero_entries(m);
    CHECK(entries.to == std::vector<int>{0, 1, 1});
    CHECK(entries.from == std::vector<int>{0, 0, 1});
}

}  // namespace gearpod::lockstep::test_implicit
