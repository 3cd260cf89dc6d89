// Checks a train whose carrier drives, so that the other flanks are in contact. The model computes
// its mirror image (gears/planetary.hpp). This test assembles the real train, with springs along
// the other flanks' line of action.
#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/planetary.hpp"
#include "gears/planetary.hpp"
#include "tests/dynamics/lin_parker.hpp"
#include "tests/numbers.hpp"
#include "tests/test.hpp"

namespace gearpod::dynamics::test_mirror_image {

constexpr double kAlpha = 0.43;
const std::vector<double> kPositions{0, 2.2, 4.0};
const std::vector<double> kStiffness{5e8, 3e8, 4e8, 7e8, 6e8, 8e8};

PlanetaryInputs inputs() {
    PlanetaryInputs in = test_gearbox::lin_parker_inputs();
    in.force_N[sun] = 3000.0;
    in.force_N[carrier] = -2.0 * std::cos(kAlpha) * 3000.0;
    return in;
}

struct Coast {
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(18, 18);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(18);
    std::vector<Eigen::VectorXd> rows;  // of the pairs
};

// Planets are at -psi. The flanks' normals turn from pi/2 -+ alpha to pi/2 +- alpha, and a negative
// rotation of its central gear loads a pair.
Coast coast_flanks(const PlanetaryInputs& in) {
    Coast model;
    const auto add = [&](const Eigen::VectorXd& v, double k) {
        model.stiffness += k * v * v.transpose();
    };
    for (int body = 0; body < 3; ++body) {
        add(Eigen::VectorXd::Unit(18, 3 * body), in.bearing_stiffness_N_m[body]);
        add(Eigen::VectorXd::Unit(18, 3 * body + 1), in.bearing_stiffness_N_m[body]);
        model.force(3 * body + 2) = -in.force_N[body];
    }
    add(Eigen::VectorXd::Unit(18, 5), in.support_stiffness_N_m);
    for (int pair = 0; pair < 6; ++pair) {
        const int n = pair % 3, planet_x = 9 + 3 * n;
        const bool with_sun = pair < 3;
        const double psi = -kPositions[static_cast<std::size_t>(n)];
        const double angle = std::numbers::pi / 2 + (with_sun ? kAlpha : -kAlpha) + psi;
        Eigen::VectorXd v = Eigen::VectorXd::Zero(18);
        const int x = with_sun ? 6 : 3;
        v(x) = -std::cos(angle);
        v(x + 1) = -std::sin(angle);
        v(x + 2) = -1.0;
        v(planet_x) = std::cos(angle);
        v(planet_x + 1) = std::sin(angle);
        v(planet_x + 2) = with_sun ? -1.0 : 1.0;
        add(v, kStiffness[static_cast<std::size_t>(pair)]);
        model.rows.push_back(v);
        if (with_sun) {
            Eigen::VectorXd bx = Eigen::VectorXd::Zero(18), by = bx;
            bx(planet_x) = by(planet_x + 1) = 1.0;
            bx(0) = by(1) = -1.0;
            bx(2) = std::sin(psi);
            by(2) = -std::cos(psi);
            add(bx, in.bearing_stiffness_N_m[planet]);
            add(by, in.bearing_stiffness_N_m[planet]);
        }
    }
    return model;
}

TEST_CASE("The carrier-driven train on its real flanks is the model's mirror image") {
    PlanetaryLayout layout;
    layout.planets = 3;
    layout.pressure_angle_rad = kAlpha;
    layout.positions_rad = kPositions;
    layout.inertial_terms = false;
    const PlanetaryInputs in = inputs();
    const GearboxMatrices model = assemble(layout, in, kStiffness);
    const Coast real = coast_flanks(in);

    GearboxMatrices flanks = model;
    flanks.stiffness = real.stiffness;
    flanks.force = real.force;
    const auto ours = natural_frequencies_Hz(model);
    const auto theirs = natural_frequencies_Hz(flanks);
    REQUIRE(ours.size() == theirs.size());
    test::check_close(ours, theirs, 1e-9);
    // The reflected shape has the same x, with y and u reversed.
    const Eigen::VectorXd q = static_equilibrium(model), mirrored = static_equilibrium(flanks);
    CHECK(q.norm() > 1e-6);
    for (int i = 0; i < 18; ++i) {
        CHECK(mirrored(i) == Approx(i % 3 == 0 ? q(i) : -q(i)).margin(1e-9 * q.norm()));
    }
    // Both have the same contact forces.
    for (int pair = 0; pair < 6; ++pair) {
        const Eigen::VectorXd row = pair_row(layout, PairId{pair});
        CHECK(row.dot(q) > 0.0);
        CHECK(real.rows[static_cast<std::size_t>(pair)].dot(mirrored) ==
              Approx(row.dot(q)).epsilon(1e-9));
    }
}

// Checks Park's transmission errors over the models' degrees of freedom: rigid rotation of the
// train gives none.

TEST_CASE("The free rotation of the model gives no transmission error in any working condition") {
    const gears::PlanetaryTrain train{16, 26, 68, 3, {}};
    const double module = 14e-3, angle = 0.43;
    const double r_c = module * 42 / 2, r_r = module * 68 / 2 * std::cos(angle),
                 r_s = module * 16 / 2 * std::cos(angle);
    using gears::Member;
    const gears::PowerFlow conditions[] = {
        {Member::sun, Member::ring},    {Member::sun, Member::carrier},
        {Member::ring, Member::sun},    {Member::ring, Member::carrier},
        {Member::carrier, Member::sun}, {Member::carrier, Member::ring}};
    for (const gears::PowerFlow& flow : conditions) {
        const gears::CentralMembers w = gears::transmission_error_weights(train, flow);
        for (const auto motion : {Motion::torsional, Motion::translational_torsional}) {
            PlanetaryLayout layout;
            layout.planets = 3;
            layout.pressure_angle_rad = angle;
            layout.fixed = flow.fixed;
            layout.motion = motion;
            const Eigen::VectorXd turn = rigid_rotation(layout);
            const double seen = w.carrier / r_c * turn(layout.rotation_index(carrier)) +
                                w.ring / r_r * turn(layout.rotation_index(ring)) +
                                w.sun / r_s * turn(layout.rotation_index(sun));
            CHECK(turn.cwiseAbs().maxCoeff() >= 1.0);
            CHECK(std::abs(seen) < 1e-13 / r_s);
        }
    }
}

}  // namespace gearpod::dynamics::test_mirror_image
