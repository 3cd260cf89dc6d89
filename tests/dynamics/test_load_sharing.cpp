// Checks how planets share the load where one pin has a position error, against the closed form for
// planets on stiff paths with a floating and with a fixed sun.
// Planet n carries F_n at both meshes. With a fixed ring and carrier, 1/K = 1/k_s + 1/k_r + 4 cos^2
// a / k_p and a pin ahead by e,
// F_n / K = s + (sun's motion along its mesh) - 2 e_n cos a.
// A floating sun on three planets moves so that all carry the same load. On four planets a quarter
// of the pin error's effect remains on every planet, with alternating signs. A fixed sun leaves all
// of it except the mean.
#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/planetary.hpp"
#include "tests/test.hpp"

namespace gearpod::dynamics::test_load_sharing {

constexpr double kAngle = 20 * std::numbers::pi / 180;
constexpr double kSunMesh = 4e8, kRingMesh = 6e8, kRigid = 1e16;

// Loads of the planets at the sun and at the ring, N; 1000 N each on average.
struct Loads {
    std::vector<double> sun, ring;
};
Loads loads(int planets, double sun_bearing, double planet_bearing, double tangential_m,
            double radial_m) {
    PlanetaryLayout layout;
    layout.planets = planets;
    layout.pressure_angle_rad = kAngle;
    layout.inertial_terms = false;
    PlanetaryInputs in;
    for (int body = 0; body < body_count; ++body) {
        in.mass_kg[body] = in.inertia_over_r2_kg[body] = 1.0;
        in.bearing_stiffness_N_m[body] = kRigid;
    }
    in.bearing_stiffness_N_m[sun] = sun_bearing;
    in.bearing_stiffness_N_m[planet] = planet_bearing;
    in.support_stiffness_N_m = kRigid;
    in.force_N[sun] = 1000.0 * planets;
    in.force_N[carrier] = -2.0 * std::cos(kAngle) * in.force_N[sun];
    // The pin of planet 2.
    const double psi = layout.planet_angle(1);
    in.planet_deviations[1].pin_x_m = radial_m * std::cos(psi) - tangential_m * std::sin(psi);
    in.planet_deviations[1].pin_y_m = radial_m * std::sin(psi) + tangential_m * std::cos(psi);
    std::vector<double> k(static_cast<std::size_t>(planets), kSunMesh);
    k.resize(2 * k.size(), kRingMesh);
    const Eigen::VectorXd q = static_equilibrium(assemble(layout, in, k));
    Loads found;
    for (int n = 0; n < planets; ++n) {
        found.sun.push_back(kSunMesh * pair_row(layout, PairId{n}).dot(q));
        found.ring.push_back(kRingMesh * pair_row(layout, PairId{planets + n}).dot(q));
    }
    return found;
}

double path_stiffness(double planet_bearing) {
    return 1.0 / (1.0 / kSunMesh + 1.0 / kRingMesh +
                  4.0 * std::cos(kAngle) * std::cos(kAngle) / planet_bearing);
}

TEST_CASE("A floating sun on three planets equalizes the load for any pin position") {
    for (const double bearing : {1e8, 1e12}) {
        const Loads found = loads(3, 1.0, bearing, 20e-6, 10e-6);
        for (const double load : found.sun) {
            CHECK(load == Approx(1000.0).epsilon(1e-4));
        }
        for (const double load : found.ring) {
            CHECK(load == Approx(1000.0).epsilon(1e-4));
        }
    }
}

TEST_CASE("On four planets a floating sun leaves a quarter of a pin's error on each") {
    for (const double bearing : {1e8, 1e12}) {
        for (const double tangential : {3e-6, -3e-6}) {
            const Loads found = loads(4, 1.0, bearing, tangential, 0.0);
            const double moved =
                path_stiffness(bearing) * 2.0 * tangential * std::cos(kAngle) / 4.0;
            for (int n = 0; n < 4; ++n) {
                INFO("bearing " << bearing << ", planet " << n + 1);
                // A pin that is ahead carries less load; the opposite planet does, too.
                const double expected = 1000.0 + (n % 2 == 1 ? -moved : moved);
                CHECK(found.sun[static_cast<std::size_t>(n)] == Approx(expected).epsilon(1e-4));
                CHECK(found.ring[static_cast<std::size_t>(n)] == Approx(expected).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("A fixed sun leaves a pin's error on its planet, except the mean") {
    for (const int planets : {3, 4, 5}) {
        const double tangential = 2e-6;
        const Loads found = loads(planets, kRigid, 1e9, tangential, 0.0);
        const double all = path_stiffness(1e9) * 2.0 * tangential * std::cos(kAngle);
        for (int n = 0; n < planets; ++n) {
            const double expected = 1000.0 + all / planets - (n == 1 ? all : 0.0);
            CHECK(found.sun[static_cast<std::size_t>(n)] == Approx(expected).epsilon(1e-4));
        }
    }
}

TEST_CASE("A radial pin error transfers no load between planets") {
    const Loads found = loads(4, kRigid, 1e8, 0.0, 50e-6);
    for (const double load : found.sun) {
        CHECK(load == Approx(1000.0).epsilon(1e-4));
    }
}

}  // namespace gearpod::dynamics::test_load_sharing
