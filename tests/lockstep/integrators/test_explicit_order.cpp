// Checks the explicit integrators' order on a smooth stiffness, across contact transitions with a
// node on each, and without such nodes.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/integrators/order.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_explicit_order {

using test::integrate_meshes;
using test::Integrated;
using test::largest_difference;
using test::LiangTrain;

const std::vector<Integrator> kExplicit = test::integrators(true);

double largest(const machine::AlignedVector& a) {
    return largest_difference(a, machine::AlignedVector(a.size(), 0.0));
}

// Slope of log error over log step by least squares.
double slope(const std::vector<double>& steps, const std::vector<double>& errors) {
    double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
    const double n = static_cast<double>(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        mx -= std::log(steps[i]) / n;
        my += std::log(errors[i]) / n;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double x = -std::log(steps[i]) - mx;
        xx += x * x;
        xy += x * (std::log(errors[i]) - my);
    }
    return xy / xx;
}

// Liang's train at twenty times its speed with 24 samples; optionally with no node on the
// transitions.
IntegrationPlan liang_plan(int steps, Integrator integrator, bool nodes_on_transitions) {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan =
        train.plan(24, steps, dynamics::Motion::translational_torsional, integrator);
    if (!nodes_on_transitions) {
        plan.grid = make_phase_grid(24, steps, {});
        plan.grid.stage_nodes = stage_nodes(integrator);
        plan.nodes = tabulate(train.pairs, plan.grid, dynamics::MeshDamping::ratio);
    }
    return plan;
}

TEST_CASE("Explicit integrators keep their order on a smooth stiffness") {
    const dynamics::FixedShaftInputs in = test::soft_tian();
    const IntegrationPlan fine = test::smooth_plan(12800, Integrator::rk4);
    const dynamics::GearboxInputs inputs = in;
    TileState away = equilibrium_state(fine, std::span(&inputs, 1));
    away.q[dynamics::u_1] += 2e-6;
    const Integrated exact = integrate_meshes(fine, in, away, 2);
    for (const Integrator integrator : kExplicit) {
        const int order = facts(integrator).order;
        // The order is one higher, and fewer steps reach the last digits of the state.
        const std::vector<double> counts =
            order > 4 ? std::vector{100.0, 200.0, 400.0} : std::vector{400.0, 800.0, 1600.0};
        std::vector<double> motions, sensors;
        for (const double steps : counts) {
            const Integrated m = integrate_meshes(
                test::smooth_plan(static_cast<int>(steps), integrator), in, away, 2);
            motions.push_back(largest_difference(m.state.q, exact.state.q));
            sensors.push_back(largest_difference(m.record.acceleration, exact.record.acceleration));
        }
        INFO(facts(integrator).name);
        CHECK(slope(counts, motions) > order - 0.25);
        CHECK(slope(counts, sensors) > order - 0.25);
        CHECK((order > 4 || slope(counts, motions) < order + 0.25));
        CHECK((order > 4 || slope(counts, sensors) < order + 0.25));
    }
}

TEST_CASE(
    "Explicit integrators keep their order across transitions with nodes, else have order 1") {
    const dynamics::GearboxInputs in = LiangTrain::instance().inputs(20.0);
    const IntegrationPlan fine = liang_plan(19200, Integrator::rk4, true);
    const TileState rest = equilibrium_state(fine, std::span(&in, 1));
    const Integrated exact = integrate_meshes(fine, in, rest, 2);
    for (const Integrator integrator : kExplicit) {
        for (const bool nodes : {true, false}) {
            // Several numbers of steps: without nodes the error depends on the position of a
            // transition within its step.
            std::vector<double> counts, motions, sensors;
            for (const int steps : {960, 1080, 1320, 1560, 1920, 2280, 2760, 3240, 3840}) {
                const Integrated m =
                    integrate_meshes(liang_plan(steps, integrator, nodes), in, rest, 2);
                counts.push_back(steps);
                motions.push_back(largest_difference(m.state.q, exact.state.q));
                sensors.push_back(
                    largest_difference(m.record.acceleration, exact.record.acceleration));
            }
            INFO("integrator " << static_cast<int>(integrator) << ", nodes " << nodes);
            for (const auto& errors : {motions, sensors}) {
                if (nodes) {
                    CHECK(slope(counts, errors) == Approx(facts(integrator).order).margin(0.3));
                } else {
                    CHECK(slope(counts, errors) < 1.3);
                    CHECK(slope(counts, errors) > 0.3);
                }
            }
        }
    }
}

TEST_CASE("A step of nearly zero length leaves an explicit integration unchanged") {
    const dynamics::GearboxInputs in = LiangTrain::instance().inputs(20.0);
    const TileState rest =
        equilibrium_state(liang_plan(1200, Integrator::rk4, true), std::span(&in, 1));
    for (const Integrator integrator : kExplicit) {
        const IntegrationPlan plan = liang_plan(1200, integrator, true);
        IntegrationPlan cut = plan;
        std::vector<double> transitions = contact_transitions(LiangTrain::instance().pairs);
        transitions.push_back(0.3 + 1e-11);  // just after a node
        cut.grid = make_phase_grid(24, 1200, transitions);
        cut.grid.stage_nodes = stage_nodes(integrator);
        cut.nodes = tabulate(LiangTrain::instance().pairs, cut.grid, dynamics::MeshDamping::ratio);
        REQUIRE(cut.grid.steps.size() == plan.grid.steps.size() + 1);
        for (const Precision precision :
             {Precision::double_precision, Precision::single_precision}) {
            if (precision == Precision::single_precision && !has_single_precision(integrator)) {
                continue;
            }
            IntegrationPlan whole = plan;
            whole.precision = cut.precision = precision;
            const Integrated a = integrate_meshes(whole, in, rest, 2),
                             b = integrate_meshes(cut, in, rest, 2);
            INFO(name(integrator) << (precision == Precision::single_precision ? " single" : ""));
            CHECK(largest_difference(a.state.q, b.state.q) < 1e-5 * largest(a.state.q));
            CHECK(largest_difference(a.record.acceleration, b.record.acceleration) <
                  1e-4 * largest(a.record.acceleration));
        }
    }
}

}  // namespace gearpod::lockstep::test_explicit_order
