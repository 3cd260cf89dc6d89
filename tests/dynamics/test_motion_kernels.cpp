// Checks the lockstep kernels' accelerations against M q'' = f - (C + G) q' - (K + K_c) q assembled
// from spring rows, and the statics of a loaded train.
#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/planetary_motion.hpp"
#include "tests/numbers.hpp"

namespace gearpod::dynamics::test_motion_kernels {

PlanetaryInputs random_inputs(std::mt19937& engine) {
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    PlanetaryInputs in;
    for (int body = 0; body < body_count; ++body) {
        in.mass_kg[body] = 2.0 * uniform(engine);
        in.inertia_over_r2_kg[body] = uniform(engine);
        in.bearing_stiffness_N_m[body] = 1e8 * uniform(engine);
        in.bearing_damping_N_s_m[body] = 1e3 * uniform(engine);
    }
    in.support_stiffness_N_m = 1e9 * uniform(engine);
    in.support_damping_N_s_m = 1e3 * uniform(engine);
    in.mesh_damping = 0.07 * uniform(engine);
    in.carrier_speed_rad_s = 100.0 * uniform(engine);
    in.mesh_period_s = 1e-3;
    std::ranges::generate(in.force_N, [&] { return 1e4 * uniform(engine); });
    for (PlanetDeviations& own : in.planet_deviations) {
        own = {1e-5 * uniform(engine), -1e-5 * uniform(engine)};
    }
    return in;
}

// Largest error of the kernel's accelerations of one lane among eight, relative to the largest.
template <class Model>
double kernel_error(PlanetaryLayout layout, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    constexpr int W = Model::kWidth;
    std::vector<PlanetaryInputs> inputs =
        test::tabulated(W, [&](int) { return random_inputs(engine); });
    const auto lanes = make_lanes<W>(layout, std::span<const PlanetaryInputs>(inputs));
    const auto degrees = static_cast<std::size_t>(layout.degrees_of_freedom());
    const auto pairs = static_cast<std::size_t>(layout.pairs());
    std::vector<double> q(degrees * W), v(degrees * W), a(degrees * W);
    typename Model::Pairs mesh{};
    std::ranges::generate(q, [&] { return 1e-5 * unit(engine); });
    std::ranges::generate(v, [&] { return 1e-2 * unit(engine); });
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        for (std::size_t l = 0; l < W; ++l) {
            mesh.k[pair * W + l] = 4e8 * (1.5 + unit(engine));
            mesh.c[pair * W + l] = mesh_damping_N_s_m(
                layout.mesh_damping, mesh_damping_factor(layout, inputs[l], PairId{pair}),
                mesh.k[pair * W + l]);
        }
    }
    Model::accelerations(lanes, q.data(), v.data(), mesh, a.data());

    double error = 0.0, scale = 0.0;
    for (std::size_t l = 0; l < W; ++l) {
        std::vector<double> stiffness =
            test::tabulated(pairs, [&](std::size_t pair) { return mesh.k[pair * W + l]; });
        const GearboxMatrices m = assemble(layout, inputs[l], stiffness);
        Eigen::VectorXd ql(degrees), vl(degrees);
        for (std::size_t d = 0; d < degrees; ++d) {
            ql(static_cast<Eigen::Index>(d)) = q[d * W + l];
            vl(static_cast<Eigen::Index>(d)) = v[d * W + l];
        }
        const Eigen::VectorXd expected =
            inverse(m.mass) *
            (m.force - (m.damping + m.gyroscopic) * vl - (m.stiffness + m.centrifugal) * ql);
        for (std::size_t d = 0; d < degrees; ++d) {
            const double e = expected(static_cast<Eigen::Index>(d));
            error = std::max(error, std::abs(a[d * W + l] - e));
            scale = std::max(scale, std::abs(e));
        }
    }
    return error / scale;
}

PlanetaryLayout layout_of(int planets, Motion motion, bool inertial, MeshDamping damping) {
    PlanetaryLayout layout;
    layout.planets = planets;
    layout.pressure_angle_rad = 20 * std::numbers::pi / 180;
    layout.carrier_radius_m = 0.0794;
    layout.motion = motion;
    layout.inertial_terms = inertial;
    layout.mesh_damping = damping;
    return layout;
}

// Profile shift gives each mesh its own working pressure angle.
PlanetaryLayout shifted(PlanetaryLayout layout) {
    layout.sun_working_angle_rad = 25 * std::numbers::pi / 180;
    layout.ring_working_angle_rad = 17 * std::numbers::pi / 180;
    return layout;
}

TEST_CASE("Lockstep accelerations equal the assembled equations of motion for 2 to 8 planets") {
    for (int n = 2; n <= 8; ++n) {
        for (const auto damping : {MeshDamping::ratio, MeshDamping::proportional}) {
            const auto seed = static_cast<unsigned>(n);
            using Inertial = TranslationalMotion<WithInertialTerms, LinearMesh, 8>;
            using Still = TranslationalMotion<WithoutInertialTerms, LinearMesh, 8>;
            const auto full = Motion::translational_torsional;
            CHECK(kernel_error<Inertial>(layout_of(n, full, true, damping), seed) < 1e-13);
            CHECK(kernel_error<Still>(layout_of(n, full, false, damping), seed) < 1e-13);
            CHECK(kernel_error<TorsionalMotion<LinearMesh, 8>>(
                      layout_of(n, Motion::torsional, false, damping), seed) < 1e-13);
            CHECK(kernel_error<Still>(shifted(layout_of(n, full, false, damping)), seed) < 1e-13);
            CHECK(kernel_error<TorsionalMotion<LinearMesh, 8>>(
                      shifted(layout_of(n, Motion::torsional, false, damping)), seed) < 1e-13);
        }
    }
}

TEST_CASE("At rest every planet carries the same share and the fixed ring takes its reaction") {
    // Base radii and centre distance of Z_s/Z_p/Z_r = 19/31/81 at module 3.175 mm.
    PlanetaryLayout layout =
        layout_of(4, Motion::translational_torsional, false, MeshDamping::ratio);
    std::mt19937 engine(1);
    PlanetaryInputs in = random_inputs(engine);
    std::fill(std::begin(in.planet_deviations), std::end(in.planet_deviations), PlanetDeviations{});
    const double cos_a = std::cos(layout.pressure_angle_rad);
    const double m = 3.175e-3, torque = 429.0;
    const double r_s = 19 * m / 2 * cos_a, r_c = 25 * m;
    in.force_N[sun] = torque / r_s;
    in.force_N[ring] = 0.0;
    in.force_N[carrier] = -torque * (1 + 81.0 / 19) / r_c;
    const std::vector<double> k(8, 5e8);
    const GearboxMatrices matrices = assemble(layout, in, k);
    const Eigen::VectorXd q = static_equilibrium(matrices);
    CHECK((matrices.stiffness * q - matrices.force).norm() < 1e-9 * matrices.force.norm());
    for (int n = 0; n < 4; ++n) {
        CHECK(5e8 * pair_row(layout, PairId{n}).dot(q) == Approx(torque / r_s / 4).epsilon(1e-9));
        CHECK(5e8 * pair_row(layout, PairId{4 + n}).dot(q) ==
              Approx(torque / r_s / 4).epsilon(1e-9));
    }
    const double reaction = in.support_stiffness_N_m * q(motion_index(ring) + 2);
    CHECK(reaction == Approx(-torque / r_s).epsilon(1e-9));
}

// The base radii of 27/35/99 teeth add up to the centre distance times the cosines of both working
// angles.
TEST_CASE("Shifted gears balance the carrier's torque at their own working angles") {
    for (const Motion motion : {Motion::translational_torsional, Motion::torsional}) {
        PlanetaryLayout layout = layout_of(4, motion, false, MeshDamping::ratio);
        const double m = 3.175e-3, cos_0 = std::cos(layout.pressure_angle_rad);
        const double r_s = 27 * m / 2 * cos_0, r_p = 35 * m / 2 * cos_0, r_r = 99 * m / 2 * cos_0;
        const double r_c = 31.6 * m;
        layout.sun_working_angle_rad = std::acos((r_s + r_p) / r_c);
        layout.ring_working_angle_rad = std::acos((r_r - r_p) / r_c);
        layout.positions_rad = {0, 32 * 2 * std::numbers::pi / 126, std::numbers::pi,
                                95 * 2 * std::numbers::pi / 126};
        std::mt19937 engine(3);
        PlanetaryInputs in = random_inputs(engine);
        std::fill(std::begin(in.planet_deviations), std::end(in.planet_deviations),
                  PlanetDeviations{});
        const double torque = 300.0;
        in.force_N[sun] = torque / r_s;
        in.force_N[ring] = 0.0;
        in.force_N[carrier] = -torque * (1 + 99.0 / 27) / r_c;
        const std::vector<double> k(8, 5e8);
        const GearboxMatrices matrices = assemble(layout, in, k);
        const Eigen::VectorXd q = motions_from_degrees(layout) * static_equilibrium(matrices);
        for (int n = 0; n < 4; ++n) {
            CHECK(5e8 * pair_row(layout, PairId{n}).dot(q) ==
                  Approx(torque / r_s / 4).epsilon(1e-9));
            CHECK(5e8 * pair_row(layout, PairId{4 + n}).dot(q) ==
                  Approx(torque / r_s / 4).epsilon(1e-9));
        }
    }
}

TEST_CASE("A free train rotates past its fixed member without deflecting a spring") {
    std::mt19937 engine(2);
    using gearpod::gears::Member;
    for (const auto fixed : {Member::ring, Member::sun, Member::carrier}) {
        for (const auto motion : {Motion::translational_torsional, Motion::torsional}) {
            PlanetaryLayout layout = layout_of(5, motion, false, MeshDamping::ratio);
            layout.fixed = fixed;
            const GearboxMatrices m =
                assemble(layout, random_inputs(engine), std::vector<double>(10, 5e8));
            const Eigen::VectorXd turn = rigid_rotation(layout);
            CHECK(turn.norm() > 1.0);
            CHECK((m.stiffness * turn).norm() < 1e-12 * m.stiffness.norm());
            CHECK((m.damping * turn).norm() < 1e-12 * m.damping.norm());
        }
    }
}

}  // namespace gearpod::dynamics::test_motion_kernels
