// Checks a start far from equilibrium: a linear train has one periodic orbit, to which every start
// converges.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_far_start {

// Record of the mesh period that follows `meshes` others, from displacements `q` and velocities
// `v`, without velocity of the rigid rotation.
MeshRecord from_afar(const IntegrationPlan& plan, const dynamics::GearboxInputs& in,
                     const machine::AlignedVector& q, const machine::AlignedVector& v, int meshes) {
    const auto degrees = dynamics::degrees_of_freedom(plan.layout);
    const auto mass =
        dynamics::assemble(plan.layout, in,
                           std::vector<double>(static_cast<std::size_t>(plan.nodes.pairs), 0.0))
            .mass;
    const Eigen::VectorXd turn = dynamics::rigid_rotation(plan.layout);
    const Eigen::VectorXd weight = mass * turn / turn.dot(mass * turn);
    TileState state;
    const auto remove_rotation = [&](machine::AlignedVector& motion) {
        Eigen::Map<Eigen::VectorXd> all(motion.data(), degrees);
        all -= (weight.dot(all) * turn).eval();
    };
    state.q = q;
    state.v = v;
    remove_rotation(state.q);
    remove_rotation(state.v);
    state.filter.assign(static_cast<std::size_t>(plan.channels() * kFilterStates), 0.0);
    const auto mesh_integrator = make_mesh_integrator<1>(plan, std::span(&in, 1));
    MeshRecord record = make_record(plan, 1, true);
    for (int mesh = 0; mesh <= meshes; ++mesh) {
        (*mesh_integrator)({}, state, record);
        remove_rotation(state.q);
        remove_rotation(state.v);
    }
    return record;
}

void check_same(const machine::AlignedVector& a, const machine::AlignedVector& b,
                double tolerance) {
    REQUIRE(a.size() == b.size());
    double size = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        size = std::max(size, std::abs(a[i]));
        difference = std::max(difference, std::abs(a[i] - b[i]));
    }
    CHECK(difference <= tolerance * size);
}

TEST_CASE(
    "From a tenth of a millimetre away, Liang's train converges to the tile's periodic orbit") {
    const auto& train = test::LiangTrain::instance();
    const IntegrationPlan plan =
        train.plan(24, 1200, dynamics::Motion::translational_torsional,
                   GENERATE(Integrator::rk4, Integrator::central_difference));
    const std::vector<dynamics::GearboxInputs> inputs{train.inputs(10.0)};
    const PeriodicSolution solution{.with_motion = true};
    const TileResult tile = run_tile<1>(plan, inputs, train.no_fault(1), solution);
    REQUIRE(tile.status[0] == LaneStatus::ok);
    machine::AlignedVector q, v;
    for (int d = 0; d < 21; ++d) {
        q.push_back(1e-4 * (d % 3 - 1));
        v.push_back(d % 2 == 0 ? 0.1 : -0.1);
    }
    const MeshRecord record = from_afar(plan, inputs[0], q, v, 200);
    check_same(tile.records[0].motion, record.motion, 1e-8);
    check_same(tile.records[0].acceleration, record.acceleration, 1e-7);
}

TEST_CASE("Tian's stiff gearbox converges from a far start with an L-stable method") {
    const auto& gearbox = test::TianGearbox::instance();
    const IntegrationPlan plan = gearbox.plan(24, 240, Integrator::sdirk3);
    const std::vector<dynamics::GearboxInputs> inputs{gearbox.inputs()};
    const PeriodicSolution solution{.with_motion = true};
    const TileResult tile = run_tile<1>(plan, inputs, gearbox.no_fault(1), solution);
    REQUIRE(tile.status[0] == LaneStatus::ok);
    // Initial mesh deflection is increased by 20 um and bearing displacements by 10 um. The
    // couplings keep their twist: they relax at k / c = 0.09 1/s, 6000 mesh periods for a factor of
    // e.
    const auto& motion = tile.records[0].motion;
    machine::AlignedVector q(motion.begin(), motion.begin() + dynamics::fixed_shaft_motions);
    const machine::AlignedVector v(q.size(), 0.0);
    for (std::size_t d = 0; d < q.size(); ++d) {
        q[d] += d == dynamics::u_2 || d == dynamics::u_b ? -1e-5 : 1e-5;
    }
    const MeshRecord record = from_afar(plan, inputs[0], q, v, 200);
    check_same(tile.records[0].motion, record.motion, 1e-6);
}

}  // namespace gearpod::lockstep::test_far_start
