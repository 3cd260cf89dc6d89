// Checks Park's 12-DOF pair matrices against the entries that the paper prints legibly, and their
// plane reduction against the planetary model.
//
// The printed matrices are k v v^T of the vectors below, except for printing errors, as far as the
// scan is legible. y_s y_p (A1) and y_p y_r (A2) have a squared sine instead of cos^2(omega). In
// (A2), x_p z_r has cos(omega) instead of sin(omega), and the planet's y and z couple to its own
// rotations by r_r instead of r_p. As printed, rigid motion would need energy.
//
// x points from the central gear's axis to the planet's, z along the axes. phi is the pressure
// angle in the normal plane, omega the helix angle; radii are those of the pitch circles.
#include <Eigen/Dense>

#include "dynamics/helical_pair.hpp"
#include "dynamics/planetary.hpp"
#include "tests/test.hpp"

namespace gearpod::dynamics::test_helical_pair {

using PairVector = Eigen::Matrix<double, 12, 1>;
using PairMatrix = Eigen::Matrix<double, 12, 12>;

struct HelicalPair {
    double pressure_angle_rad = 0.0;
    double helix_angle_rad = 0.0;
};

// Unit normal of the tooth flank relative to the central gear: radial, tangential and axial
// components.
struct Normal {
    double x, y, z;
};

Normal normal_of(const HelicalPair& pair) {
    const double c = std::cos(pair.pressure_angle_rad);
    return {std::sin(pair.pressure_angle_rad), c * std::cos(pair.helix_angle_rad),
            c * std::sin(pair.helix_angle_rad)};
}

// Deflection over (x, y, z, alpha, beta, gamma) of the sun and then the planet (A1), or of the
// planet and then the ring (A2). Translations in m, rotations in rad.
PairVector sun_planet_deflection(const HelicalPair& pair, double sun_radius_m,
                                 double planet_radius_m) {
    const Normal n = normal_of(pair);
    const double s = sun_radius_m, p = planet_radius_m;
    PairVector v;
    v << n.x, n.y, -n.z, 0.0, s * n.z, s * n.y,  //
        -n.x, -n.y, n.z, 0.0, p * n.z, p * n.y;
    return v;
}

PairVector planet_ring_deflection(const HelicalPair& pair, double planet_radius_m,
                                  double ring_radius_m) {
    const Normal n = normal_of(pair);
    const double p = planet_radius_m, r = ring_radius_m;
    PairVector v;
    v << n.x, -n.y, -n.z, 0.0, p * n.z, -p * n.y,  //
        -n.x, n.y, n.z, 0.0, -r * n.z, r * n.y;
    return v;
}

PairMatrix pair_matrix(const PairVector& deflection, double stiffness_N_m) {
    return stiffness_N_m * PairMatrix(deflection * deflection.transpose());
}

constexpr double kPhi = 0.43, kOmega = 0.31;
constexpr double kSun = 0.112, kPlanet = 0.182, kRing = 0.476;  // Park's Table III
constexpr HelicalPair kPair{kPhi, kOmega};

const double s2 = std::sin(kPhi) * std::sin(kPhi), c2 = std::cos(kPhi) * std::cos(kPhi);
const double half_sin_2phi = std::sin(2 * kPhi) / 2, half_sin_2om = std::sin(2 * kOmega) / 2;
const double sin_om = std::sin(kOmega), cos_om = std::cos(kOmega);

void check_row(const PairMatrix& k, int row, std::initializer_list<double> printed) {
    int column = 12 - static_cast<int>(printed.size());
    for (const double value : printed) {
        INFO("row " << row << ", column " << column);
        CHECK(k(row, column) == Approx(value).margin(1e-15));
        ++column;
    }
}

// Rigid motion of both gears: translation t and rotation w about the central gear's centre; the
// other gear's centre is at (a, 0, 0).
PairVector rigid(const Eigen::Vector3d& t, const Eigen::Vector3d& w, double a, bool planet_first) {
    const Eigen::Vector3d arm(a, 0, 0);
    Eigen::Matrix<double, 6, 1> centre, planet;
    centre << t, w;
    planet << t + w.cross(arm), w;
    PairVector q;
    q << (planet_first ? planet : centre), (planet_first ? centre : planet);
    return q;
}

TEST_CASE("The sun-planet matrix has the printed rows of (A1)") {
    const PairMatrix k = pair_matrix(sun_planet_deflection(kPair, kSun, kPlanet), 1.0);
    check_row(
        k, 0,
        {s2, half_sin_2phi * cos_om, -half_sin_2phi * sin_om, 0, kSun * half_sin_2phi * sin_om,
         kSun * half_sin_2phi * cos_om, -s2, -half_sin_2phi * cos_om, half_sin_2phi * sin_om, 0,
         kPlanet * half_sin_2phi * sin_om, kPlanet * half_sin_2phi * cos_om});
    // The printed y_s y_p entry -cos^2 sin^2 is a misprint: rigid translation would cost energy.
    check_row(k, 1,
              {c2 * cos_om * cos_om, -c2 * half_sin_2om, 0, kSun * c2 * half_sin_2om,
               kSun * c2 * cos_om * cos_om, -half_sin_2phi * cos_om, -c2 * cos_om * cos_om,
               c2 * half_sin_2om, 0, kPlanet * c2 * half_sin_2om, kPlanet * c2 * cos_om * cos_om});
    check_row(k, 2,
              {c2 * sin_om * sin_om, 0, -kSun * c2 * sin_om * sin_om, -kSun * c2 * half_sin_2om,
               half_sin_2phi * sin_om, c2 * half_sin_2om, -c2 * sin_om * sin_om, 0,
               -kPlanet * c2 * sin_om * sin_om, -kPlanet * c2 * half_sin_2om});
    CHECK(k.row(3).norm() == 0);
    CHECK(k.row(9).norm() == 0);
}

TEST_CASE("The planet-ring matrix has the printed rows of (A2)") {
    const PairMatrix k = pair_matrix(planet_ring_deflection(kPair, kPlanet, kRing), 1.0);
    check_row(
        k, 0,
        {s2, -half_sin_2phi * cos_om, -half_sin_2phi * sin_om, 0, kPlanet * half_sin_2phi * sin_om,
         -kPlanet * half_sin_2phi * cos_om, -s2, half_sin_2phi * cos_om, half_sin_2phi * sin_om, 0,
         -kRing * half_sin_2phi * sin_om, kRing * half_sin_2phi * cos_om});
    check_row(k, 1,
              {c2 * cos_om * cos_om, c2 * half_sin_2om, 0, -kPlanet * c2 * half_sin_2om,
               kPlanet * c2 * cos_om * cos_om, half_sin_2phi * cos_om, -c2 * cos_om * cos_om,
               -c2 * half_sin_2om, 0, kRing * c2 * half_sin_2om, -kRing * c2 * cos_om * cos_om});
    check_row(k, 2,
              {c2 * sin_om * sin_om, 0, -kPlanet * c2 * sin_om * sin_om,
               kPlanet * c2 * half_sin_2om, half_sin_2phi * sin_om, -c2 * half_sin_2om,
               -c2 * sin_om * sin_om, 0, kRing * c2 * sin_om * sin_om, -kRing * c2 * half_sin_2om});
}

TEST_CASE("Both matrices are symmetric, of rank one, and rigid motion needs no energy") {
    const PairVector sun = sun_planet_deflection(kPair, kSun, kPlanet);
    const PairVector ring = planet_ring_deflection(kPair, kPlanet, kRing);
    for (const bool planet_first : {false, true}) {
        const PairVector& v = planet_first ? ring : sun;
        const PairMatrix k = pair_matrix(v, 3e9);
        CHECK((k - k.transpose()).norm() == 0);
        Eigen::FullPivLU<PairMatrix> lu(k);
        lu.setThreshold(1e-12);
        CHECK(lu.rank() == 1);
        const double axes = planet_first ? kRing - kPlanet : kSun + kPlanet;
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i), none = Eigen::Vector3d::Zero();
            CHECK(std::abs(v.dot(rigid(axis, none, axes, planet_first))) < 1e-15);
            CHECK(std::abs(v.dot(rigid(none, axis, axes, planet_first))) < 1e-15);
        }
        // The gears roll on each other's pitch circles.
        PairVector roll = PairVector::Zero();
        roll(5) = planet_first ? 1 / kPlanet : 1 / kSun;
        roll(11) = planet_first ? 1 / kRing : -1 / kPlanet;
        CHECK(std::abs(v.dot(roll)) < 1e-15);
    }
}

TEST_CASE("In the plane the pair equals the planetary model's spur pair at the transverse angle") {
    PlanetaryLayout layout;
    layout.planets = 1;
    layout.pressure_angle_rad = kPhi;
    layout.helix_angle_rad = kOmega;
    const double angle = transverse_pressure_angle(kPhi, kOmega);
    CHECK(layout.transverse_pressure_angle() == angle);
    CHECK(std::tan(angle) * std::cos(kOmega) == Approx(std::tan(kPhi)));
    const double base = std::cos(angle);  // base over pitch radius
    const double k = 2.7e9, factor = transverse_stiffness_factor(kPhi, kOmega);
    CHECK(factor == Approx(s2 + c2 * cos_om * cos_om));

    const int plane[] = {0, 1, 5, 6, 7, 11};
    const PairMatrix sun = pair_matrix(sun_planet_deflection(kPair, kSun, kPlanet), k);
    const PairMatrix ring = pair_matrix(planet_ring_deflection(kPair, kPlanet, kRing), k);
    const Eigen::VectorXd sun_row = pair_row(layout, PairId{0}),
                          ring_row = pair_row(layout, PairId{layout.planets});
    const int s = motion_index(gearpod::dynamics::sun), p = motion_index(planet, 0),
              r = motion_index(gearpod::dynamics::ring);
    const int sun_motions[] = {s, s + 1, s + 2, p, p + 1, p + 2};
    const int ring_motions[] = {p, p + 1, p + 2, r, r + 1, r + 2};
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            // Convention: u = base radius times rotation.
            const auto scale = [&](int index, double first, double second) {
                return index == 2 ? base * first : index == 5 ? base * second : 1.0;
            };
            const double of_sun = factor * k * sun_row(sun_motions[i]) * sun_row(sun_motions[j]) *
                                  scale(i, kSun, kPlanet) * scale(j, kSun, kPlanet);
            const double of_ring = factor * k * ring_row(ring_motions[i]) *
                                   ring_row(ring_motions[j]) * scale(i, kPlanet, kRing) *
                                   scale(j, kPlanet, kRing);
            CHECK(sun(plane[i], plane[j]) == Approx(of_sun).margin(1e-6));
            CHECK(ring(plane[i], plane[j]) == Approx(of_ring).margin(1e-6));
        }
    }
    CHECK(transverse_pressure_angle(kPhi, 0.0) == kPhi);
    CHECK(transverse_stiffness_factor(kPhi, 0.0) == 1.0);
}

}  // namespace gearpod::dynamics::test_helical_pair
