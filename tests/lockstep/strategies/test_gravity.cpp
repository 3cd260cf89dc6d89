// Checks weight against statics: the bearings carry all of it in any rotation.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/strategies/solution.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_gravity {

using std::numbers::pi;

constexpr double kGravity = 9.80665;

// Force of the three central bearings' springs along an axis at a sample, in N.
double bearing_force(const MeshRecord& record, const dynamics::PlanetaryInputs& in, int degrees,
                     std::size_t sample, int axis) {
    double sum = 0.0;
    for (const int body : {dynamics::carrier, dynamics::ring, dynamics::sun}) {
        sum += in.bearing_stiffness_N_m[body] *
               record.motion[sample * static_cast<std::size_t>(degrees) +
                             static_cast<std::size_t>(3 * body + axis)];
    }
    return sum;
}

double weight(const dynamics::PlanetaryInputs& in) {
    return kGravity * (in.mass_kg[dynamics::carrier] + in.mass_kg[dynamics::ring] +
                       in.mass_kg[dynamics::sun] + 4.0 * in.mass_kg[dynamics::planet]);
}

TEST_CASE("the bearings of a rotating train carry its weight, which rotates backwards",
          "[gravity][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    const IntegrationPlan plan =
        train.plan(10, 10, dynamics::Motion::translational_torsional, false);
    const auto in = train.inputs();
    const std::vector<dynamics::GearboxInputs> inputs{in};
    const VaryingForces weights{.torque = {}, .gravity = Gravity{kGravity, -pi / 2, 1.0 / 81.0}};
    const FaultCurves healthy = train.no_fault(1);
    const TileResult tile = run_tile<1>(
        plan, inputs, healthy,
        QuasiStaticSolution{StaticSpan{.meshes = 81, .motion_meshes = 81, .forces = &weights}});
    REQUIRE(tile.content.size() == 81);
    double worst = 0.0;
    for (std::size_t k = 0; k < 81; ++k) {
        const MeshRecord& record = tile.records[static_cast<std::size_t>(tile.content[k])];
        for (std::size_t s = 0; s < 10; ++s) {
            // Vertical direction of the housing in the carrier's frame.
            const double angle =
                -pi / 2 -
                2.0 * pi * (static_cast<double>(k) + static_cast<double>(s) / 10.0) / 81.0;
            worst = std::max(
                {worst,
                 std::abs(bearing_force(record, in, 21, s, 0) - weight(in) * std::cos(angle)),
                 std::abs(bearing_force(record, in, 21, s, 1) - weight(in) * std::sin(angle))});
        }
    }
    CHECK(worst < 1e-6 * weight(in));
}

TEST_CASE("in time integration, too, the bearings of a train carry its weight",
          "[gravity][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    const auto [integrator, steps] =
        GENERATE(std::pair(Integrator::rk4, 450), std::pair(Integrator::sdirk3, 200));
    IntegrationPlan plan =
        train.plan(50, steps, dynamics::Motion::translational_torsional, integrator, false);
    auto in = train.inputs(12.0);
    std::ranges::fill(in.bearing_damping_N_s_m, 5e3);
    const std::vector<dynamics::GearboxInputs> inputs{in};
    Excitation excitation;
    excitation.gravity = Gravity{kGravity, -pi / 2, 1.0 / 81.0};
    const FaultCurves healthy = train.no_fault(1);
    const TileResult tile = run_tile<1>(
        plan, inputs, healthy,
        FullSolution{.convergence = {1e-6, 400},
                     .span = {.meshes = 81, .run_in_meshes = 100, .options = {.motion_meshes = 81}},
                     .excitation = &excitation});
    REQUIRE(tile.status[0] == LaneStatus::ok);
    // The mean spring force over a mesh period is the weight, apart from the change of momentum.
    double worst = 0.0;
    for (std::size_t k = 0; k < 81; ++k) {
        const MeshRecord& record = tile.records[static_cast<std::size_t>(tile.content[k])];
        double x = 0.0, y = 0.0;
        for (std::size_t s = 0; s < 50; ++s) {
            x += bearing_force(record, in, 21, s, 0) / 50.0;
            y += bearing_force(record, in, 21, s, 1) / 50.0;
        }
        const double angle = -pi / 2 - 2.0 * pi * (static_cast<double>(k) + 0.49) / 81.0;
        worst = std::max({worst, std::abs(x - weight(in) * std::cos(angle)),
                          std::abs(y - weight(in) * std::sin(angle))});
    }
    CHECK(worst < 0.01 * weight(in));
}

TEST_CASE("constant weight keeps the periodic orbit and the passage of a fault",
          "[gravity][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    const IntegrationPlan plan =
        train.plan(50, 450, dynamics::Motion::translational_torsional, false);
    auto in = train.inputs(12.0);
    std::ranges::fill(in.bearing_damping_N_s_m, 5e3);
    const std::vector<dynamics::GearboxInputs> inputs{in};
    const FaultCurves cracked = train.ring_side_cracks({3e-3});
    Excitation excitation;
    excitation.gravity = Gravity{kGravity, -pi / 2, 0.0};
    const Convergence convergence{1e-9, 400};
    const TileResult reused =
        run_tile<1>(plan, inputs, cracked, PeriodicSolution{convergence, true, excitation.gravity});
    const TileResult all =
        run_tile<1>(plan, inputs, cracked,
                    FullSolution{.convergence = convergence,
                                 .span = {.meshes = 62, .options = {.motion_meshes = 62}},
                                 .excitation = &excitation});
    REQUIRE(reused.status[0] == LaneStatus::ok);
    REQUIRE(reused.records.size() < all.records.size());
    for (std::size_t k = 31; k < 62; ++k) {
        const auto& a =
            reused.records[static_cast<std::size_t>(reused.content[k % reused.content.size()])];
        const auto& b = all.records[static_cast<std::size_t>(all.content[k])];
        for (std::size_t i = 0; i < a.motion.size(); i += 21) {
            // The carrier is displaced and the transmission error is unchanged.
            CHECK(a.motion[i + 1] == Approx(b.motion[i + 1]).epsilon(1e-5));
            CHECK(a.te[i / 21] == Approx(b.te[i / 21]).epsilon(1e-6));
        }
    }
    double sag = 0.0;
    for (std::size_t s = 0; s < 50; ++s) {
        sag += bearing_force(reused.records[0], in, 21, s, 1) / 50.0;
    }
    CHECK(sag == Approx(-weight(in)).epsilon(1e-4));
}

TEST_CASE("the displacement of a shaft's gear is its weight over its bearing's stiffness",
          "[gravity][lockstep]") {
    dynamics::FixedShaftLayout layout;
    layout.base_radius_m[dynamics::pinion] = 0.03;
    layout.base_radius_m[dynamics::gear] = 0.06;
    IntegrationPlan plan;
    plan.layout = layout;
    plan.grid = make_phase_grid(4, 4, {});
    plan.nodes.pairs = 1;
    plan.nodes.stiffness.assign(12, 3e8);
    plan.nodes.damping_shape.assign(12, 0.0);
    plan.te_weight.assign(8, 0.0);
    dynamics::FixedShaftInputs in;
    in.mass_kg[dynamics::pinion] = 1.5;
    in.mass_kg[dynamics::gear] = 4.0;
    in.bearing_stiffness_N_m[dynamics::pinion] = 1e8;
    in.bearing_stiffness_N_m[dynamics::gear] = 2e8;
    for (const int g : {dynamics::pinion, dynamics::gear}) {
        in.inertia_kg_m2[g] = 1e-3;
        in.coupling_stiffness_N_m_rad[g] = 1e4;
    }
    in.motor_inertia_kg_m2 = in.load_inertia_kg_m2 = 1e-3;
    in.mesh_period_s = 1e-3;
    const std::vector<dynamics::GearboxInputs> inputs{in};
    const double down = GENERATE(-pi / 2, -2.0);
    PairSet pairs;
    const FaultCurves healthy{&pairs, {}, {}};
    const StaticPattern pattern{.with_motion = true, .gravity = ConstantGravity{kGravity, down}};
    const TileResult tile = run_tile<1>(plan, inputs, healthy, QuasiStaticSolution{pattern});
    const auto& q = tile.records[0].motion;
    const double x = std::cos(down) * kGravity, y = std::sin(down) * kGravity;
    CHECK(q[dynamics::x_1] == Approx(1.5 * x / 1e8).margin(1e-16));
    CHECK(q[dynamics::x_2] == Approx(4.0 * x / 2e8).margin(1e-16));
    // No torque acts, so the mesh force is zero and each bearing carries its own gear.
    CHECK(q[dynamics::y_1] == Approx(1.5 * y / 1e8));
    CHECK(q[dynamics::y_2] == Approx(4.0 * y / 2e8));
}

}  // namespace gearpod::lockstep::test_gravity
