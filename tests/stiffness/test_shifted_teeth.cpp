// Checks teeth of shifted gears: the beam's compliance from points of the flank alone, and the
// contact positions of a pair.
#include "gears/mesh_geometry.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_shifted_teeth {

constexpr double kAngle = 20 * std::numbers::pi / 180;
const Material kSteel{2.06e11, 0.3, 0.02, true};

gears::Gear gear(int teeth, double shift, double shortening = 0) {
    gears::Gear gear{std::abs(teeth), teeth < 0, 3e-3, kAngle};
    gear.profile_shift = shift;
    gear.tip_shortening = shortening;
    return gear;
}

// Shifts of sun, planet and ring at a centre distance of 31.6 modules: 27/35/99 teeth.
gears::WorkingShifts bell() {
    const gears::Gear ring = gear(-99, 0);
    return gears::working_shifts(gear(27, 0), gear(35, 0), &ring, {0.4, {}, {}, 31.6 * 3e-3});
}

// The tooth as a stack of thin slices between its root circle and the radius of the contact. Their
// half width is r sin(half angle at r) from the thickness of the flank there. Integrates the
// energies of bending, shear and compression under a unit force at the contact, normal to the
// flank.
double compliance_of_points(const gears::Gear& gear, double contact_radius, double root_radius) {
    struct Point {
        double axial, half;
    };
    const auto point = [&](double radius) -> Point {
        const double half = gear.half_angle_at(radius);
        return {radius * std::cos(half), radius * std::sin(half)};
    };
    const Point contact = point(contact_radius);
    // The force is tangent to the base circle: its moment about the gear's centre is R_b.
    const double pressure = std::acos(gear.base_radius() / contact_radius);
    const double half = gear.half_angle_at(contact_radius);
    const double lean = gear.internal ? pressure + half : pressure - half;
    const double e = kSteel.youngs_modulus_Pa, shear = e / (2 * (1 + kSteel.poisson_ratio));
    constexpr int kSlices = 40000;
    double sum = 0;
    for (int i = 0; i < kSlices; ++i) {
        const double low = root_radius + (contact_radius - root_radius) * i / kSlices;
        const double high = root_radius + (contact_radius - root_radius) * (i + 1) / kSlices;
        const Point a = point(low), b = point(high);
        const double length = std::abs(b.axial - a.axial), h = 0.5 * (a.half + b.half);
        const double area = 2 * h * kSteel.face_width_m;
        const double inertia = kSteel.face_width_m * std::pow(2 * h, 3) / 12;
        const double lever = std::abs(contact.axial - 0.5 * (a.axial + b.axial));
        const double moment = lever * std::cos(lean) - contact.half * std::sin(lean);
        sum += length * (moment * moment / (e * inertia) +
                         1.2 * std::cos(lean) * std::cos(lean) / (shear * area) +
                         std::sin(lean) * std::sin(lean) / (e * area));
    }
    return sum;
}

TEST_CASE("the compliance of a shifted tooth is that of the slices between its flanks") {
    const auto set = bell();
    const gears::MeshGeometry sun(gear(27, set.first, set.tip_shortening),
                                  gear(35, set.second, set.tip_shortening), set.centre_distance_m);
    const gears::MeshGeometry ring(gear(35, set.second, set.tip_shortening), gear(-99, set.ring),
                                   set.centre_distance_m);
    for (const gears::MeshGeometry& mesh : {sun, ring})
        for (const int which : {1, 2})
            for (const double part : {0.1, 0.5, 0.9}) {
                const gears::Gear& own = mesh.gear(which);
                // The beam has an involute outline throughout where the root lies above the base
                // circle.
                if (!own.internal && own.root_radius() < own.base_radius()) {
                    continue;
                }
                const double tau = part * mesh.contact_ratio();
                const ToothProfile profile(own, Profile::root_circle);
                CHECK(tooth_compliance(profile, kSteel, mesh.contact_angle(which, tau)).total() ==
                      Approx(compliance_of_points(own, mesh.contact_radius(which, tau),
                                                  own.root_radius()))
                          .epsilon(2e-6));
            }
}

TEST_CASE("both gears of a shifted pair are in contact at one point of the line of action") {
    const auto set = bell();
    const double a = *set.centre_distance_m;
    const gears::MeshGeometry sun(gear(27, set.first, set.tip_shortening),
                                  gear(35, set.second, set.tip_shortening), a);
    const gears::MeshGeometry ring(gear(35, set.second, set.tip_shortening), gear(-99, set.ring),
                                   a);
    const auto roll = [](const gears::MeshGeometry& mesh, int which, double tau) {
        const double r = mesh.contact_radius(which, tau), b = mesh.gear(which).base_radius();
        return std::sqrt(r * r - b * b);
    };
    for (const double tau : {0.0, 0.4, 1.1}) {
        CHECK(roll(sun, 1, tau) + roll(sun, 2, tau) ==
              Approx(a * std::sin(sun.working_pressure_angle())).epsilon(1e-12));
        CHECK(roll(ring, 2, tau) - roll(ring, 1, tau) ==
              Approx(a * std::sin(ring.working_pressure_angle())).epsilon(1e-12));
    }
    // Both are in contact on their working circles at the pitch point.
    for (const gears::MeshGeometry& mesh : {sun, ring})
        for (const int which : {1, 2}) {
            CHECK(mesh.contact_radius(which, mesh.pitch_position()) ==
                  Approx(mesh.working_pitch_radius(which)).epsilon(1e-12));
        }
}

TEST_CASE("thicker roots stiffen a pinion, and explicit zero shifts change no bit") {
    const gears::MeshGeometry plain(gear(23, 0), gear(41, 0)),
        shifted(gear(23, 0.4), gear(41, -0.4)), zero(gear(23, 0.0), gear(41, 0.0), 96e-3);
    for (const Profile profile : {Profile::base_circle, Profile::root_circle, Profile::fillet}) {
        const AdditiveMesh one(plain, kSteel, profile), two(zero, kSteel, profile);
        for (const double tau : {0.1, 0.7, 1.2}) {
            CHECK(one.tooth_pair(tau) == two.tooth_pair(tau));
        }
        const auto at_pitch = [&](const gears::MeshGeometry& mesh) {
            return tooth_compliance(ToothProfile(mesh.gear(1), profile), kSteel,
                                    mesh.contact_angle(1, mesh.pitch_position()))
                .total();
        };
        CHECK(at_pitch(shifted) < at_pitch(plain));
    }
}

}  // namespace gearpod::stiffness::test_shifted_teeth
