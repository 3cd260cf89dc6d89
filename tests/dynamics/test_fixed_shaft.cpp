// Checks the fixed-shaft gearbox of Tian (2004): its matrices, its lockstep accelerations and its
// statics.
#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/gearbox.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "tests/numbers.hpp"

namespace gearpod::dynamics::test_fixed_shaft {

FixedShaftLayout layout_of(MeshDamping damping) {
    FixedShaftLayout layout;
    layout.base_radius_m[pinion] = 0.02834;
    layout.base_radius_m[gear] = 0.0716;
    layout.mesh_damping = damping;
    return layout;
}

FixedShaftInputs random_inputs(std::mt19937& engine) {
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    FixedShaftInputs in;
    for (const auto g : {pinion, gear}) {
        in.mass_kg[g] = 2.0 * uniform(engine);
        in.inertia_kg_m2[g] = 2e-3 * uniform(engine);
        in.bearing_stiffness_N_m[g] = 6e7 * uniform(engine);
        in.bearing_damping_N_s_m[g] = 1e3 * uniform(engine);
        in.coupling_stiffness_N_m_rad[g] = 4e4 * uniform(engine);
        in.coupling_damping_N_m_s_rad[g] = 5.0 * uniform(engine);
    }
    in.motor_inertia_kg_m2 = 2e-3 * uniform(engine);
    in.load_inertia_kg_m2 = 1e-2 * uniform(engine);
    in.motor_torque_N_m = 12.0 * uniform(engine);
    in.load_torque_N_m = 30.0 * uniform(engine);
    in.mesh_damping = 0.05 * uniform(engine);
    in.mesh_period_s = 1e-3;
    return in;
}

// Tian's Eqs. 4.1-4.8 as printed, except the mesh force on the gear (Eq. 4.4), which must oppose
// that on the pinion. Accelerations of x1 y1 x2 y2 and of the angles of motor, pinion, gear, load.
Eigen::VectorXd printed_equations(const FixedShaftLayout& layout, const FixedShaftInputs& in,
                                  double k_t, double c_t, const Eigen::VectorXd& q,
                                  const Eigen::VectorXd& v) {
    const double r1 = layout.base_radius_m[pinion], r2 = layout.base_radius_m[gear];
    const double mesh =
        k_t * (r1 * q(5) - r2 * q(6) - q(1) + q(3)) + c_t * (r1 * v(5) - r2 * v(6) - v(1) + v(3));
    const double* k = in.bearing_stiffness_N_m;
    const double* c = in.bearing_damping_N_s_m;
    const double input = in.coupling_stiffness_N_m_rad[pinion] * (q(4) - q(5)) +
                         in.coupling_damping_N_m_s_rad[pinion] * (v(4) - v(5));
    const double output = in.coupling_stiffness_N_m_rad[gear] * (q(6) - q(7)) +
                          in.coupling_damping_N_m_s_rad[gear] * (v(6) - v(7));
    Eigen::VectorXd a(8);
    a << (-k[0] * q(0) - c[0] * v(0)) / in.mass_kg[pinion],
        (-k[0] * q(1) - c[0] * v(1) + mesh) / in.mass_kg[pinion],
        (-k[1] * q(2) - c[1] * v(2)) / in.mass_kg[gear],
        (-k[1] * q(3) - c[1] * v(3) - mesh) / in.mass_kg[gear],
        (in.motor_torque_N_m - input) / in.motor_inertia_kg_m2,
        (input - r1 * mesh) / in.inertia_kg_m2[pinion],
        (r2 * mesh - output) / in.inertia_kg_m2[gear],
        (output - in.load_torque_N_m) / in.load_inertia_kg_m2;
    return a;
}

TEST_CASE(
    "The fixed-shaft matrices and lanes are Tian's equations minus the acceleration of the whole "
    "train") {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const auto damping : {MeshDamping::ratio, MeshDamping::proportional}) {
        const FixedShaftLayout layout = layout_of(damping);
        std::vector<FixedShaftInputs> inputs =
            test::tabulated(8, [&](int) { return random_inputs(engine); });
        const auto lanes = make_lanes<8>(layout, std::span<const FixedShaftInputs>(inputs));
        std::vector<double> q(64), v(64), a(64);
        FixedShaftMotions<LinearMesh, 8>::Pairs mesh;
        for (std::size_t i = 0; i < 64; ++i) {
            q[i] = 1e-5 * unit(engine);
            v[i] = 1e-2 * unit(engine);
        }
        for (std::size_t l = 0; l < 8; ++l) {
            mesh.k[l] = 4e8 * (1.5 + unit(engine));
            mesh.c[l] = mesh_damping_N_s_m(
                damping, mesh_damping_factor(layout, inputs[l], PairId{0}), mesh.k[l]);
        }
        FixedShaftMotions<LinearMesh, 8>::accelerations(lanes, q.data(), v.data(), mesh, a.data());
        const double radius[] = {1, 1, 1, 1, 0.02834, 0.02834, 0.0716, 0.0716};
        for (std::size_t l = 0; l < 8; ++l) {
            Eigen::VectorXd ql(8), vl(8), al(8), angles(8), rates(8);
            for (int d = 0; d < 8; ++d) {
                const std::size_t at = static_cast<std::size_t>(d) * 8 + l;
                ql(d) = q[at];
                vl(d) = v[at];
                al(d) = a[at];
                angles(d) = q[at] / radius[d];
                rates(d) = v[at] / radius[d];
            }
            const GearboxMatrices m = assemble(layout, inputs[l], {mesh.k[l]});
            const Eigen::VectorXd assembled =
                inverse(m.mass) * (m.force - m.damping * vl - m.stiffness * ql);
            CHECK((al - assembled).norm() < 1e-13 * assembled.norm());

            Eigen::VectorXd printed =
                printed_equations(layout, inputs[l], mesh.k[l], mesh.c[l], angles, rates);
            for (int d = 0; d < 8; ++d) {
                printed(d) *= radius[d];
            }
            // The difference is the same acceleration of all four rotations.
            const Eigen::VectorXd rest = printed - al;
            CHECK(rest.head<4>().norm() < 1e-12 * printed.norm());
            for (int d = 5; d < 8; ++d) {
                CHECK(std::abs(rest(d) - rest(4)) < 1e-12 * printed.norm());
            }
        }
    }
}

TEST_CASE("Stiffness and damping of every gearbox kind are symmetric and zero for rigid rotation") {
    std::mt19937 engine(3);
    PlanetaryLayout planetary;
    planetary.planets = 4;
    planetary.pressure_angle_rad = 0.35;
    PlanetaryInputs train;
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    for (int body = 0; body < body_count; ++body) {
        train.mass_kg[body] = uniform(engine);
        train.inertia_over_r2_kg[body] = uniform(engine);
        train.bearing_stiffness_N_m[body] = 1e8 * uniform(engine);
        train.bearing_damping_N_s_m[body] = 1e3 * uniform(engine);
    }
    train.support_stiffness_N_m = 1e9;
    train.mesh_damping = 0.07;
    PlanetaryLayout torsional = planetary;
    torsional.motion = Motion::torsional;
    const std::vector<std::pair<GearboxLayout, GearboxInputs>> kinds{
        {planetary, train},
        {torsional, train},
        {layout_of(MeshDamping::proportional), random_inputs(engine)}};
    for (const auto& [layout, inputs] : kinds) {
        std::vector<double> k =
            test::tabulated(pairs(layout), [&](int) { return 5e8 * uniform(engine); });
        const GearboxMatrices m = assemble(layout, inputs, k);
        const Eigen::VectorXd turn = rigid_rotation(layout);
        const double largest = m.stiffness.norm();
        CHECK((m.stiffness - m.stiffness.transpose()).norm() < 1e-15 * largest);
        CHECK((m.damping - m.damping.transpose()).norm() < 1e-15 * m.damping.norm());
        CHECK((m.stiffness * turn).norm() < 1e-14 * largest);
        CHECK((m.damping * turn).norm() < 1e-14 * m.damping.norm());
        const Eigen::VectorXd energy =
            modes(m.stiffness, Eigen::MatrixXd::Identity(m.mass.rows(), m.mass.rows())).squares;
        CHECK(energy.minCoeff() > -1e-14 * largest);
        CHECK(energy(1) > 1e-9 * largest);  // no other motion is free

        // The springs by name give the same matrices; mesh rows are those of the pairs.
        GearboxMatrices sum = zero_matrices(degrees_of_freedom(layout));
        for (const SpringDamper& spring : spring_dampers(layout, inputs, k)) {
            add(sum, spring);
        }
        CHECK((sum.stiffness - m.stiffness).norm() < 1e-14 * largest);
        std::vector<double> stiffer = k;
        stiffer.back() += 1e8;
        const Eigen::VectorXd row = mesh_row(layout, PairId{pairs(layout) - 1});
        CHECK((assemble(layout, inputs, stiffer).stiffness - m.stiffness -
               1e8 * row * row.transpose())
                  .norm() < 1e-12 * largest);
    }
}

TEST_CASE("Unbalanced torques load the mesh with the inertia force of the driven side") {
    // Torques of Tian's Table 4.1: 11.9 N m drive, 48.8 N m brake. Motor and pinion slow down
    // together with the acceleration s of the pitch line; the mesh carries the remaining motor
    // force.
    const FixedShaftLayout layout = layout_of(MeshDamping::proportional);
    std::mt19937 engine(4);
    FixedShaftInputs in = random_inputs(engine);
    in.motor_torque_N_m = 11.9;
    in.load_torque_N_m = 48.8;
    const double r1 = layout.base_radius_m[pinion], r2 = layout.base_radius_m[gear];
    const double front = (in.motor_inertia_kg_m2 + in.inertia_kg_m2[pinion]) / (r1 * r1);
    const double back = (in.load_inertia_kg_m2 + in.inertia_kg_m2[gear]) / (r2 * r2);
    const double s = (11.9 / r1 - 48.8 / r2) / (front + back);
    const double mesh = 11.9 / r1 - front * s;

    const double k = 8e8;
    const GearboxMatrices m = assemble(layout, in, {k});
    const Eigen::VectorXd q = static_equilibrium(m);
    CHECK(k * mesh_row(layout).dot(q) == Approx(mesh).epsilon(1e-9));
    CHECK(q(y_1) * in.bearing_stiffness_N_m[pinion] == Approx(mesh).epsilon(1e-9));
    CHECK(q(y_2) * in.bearing_stiffness_N_m[gear] == Approx(-mesh).epsilon(1e-9));
    CHECK((m.stiffness * q - m.force).norm() < 1e-9 * m.force.norm());
    CHECK(std::abs(m.force.dot(rigid_rotation(layout))) < 1e-12 * m.force.norm());
}

}  // namespace gearpod::dynamics::test_fixed_shaft
