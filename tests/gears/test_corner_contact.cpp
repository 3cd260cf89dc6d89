// Checks the gap outside the path of contact against involutes that are rotated into each other
// point by point.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "gears/corner_contact.hpp"
#include "gears/gear.hpp"

namespace test_corner_contact {

using namespace gearpod::gears;
using std::numbers::pi;

namespace {

Gear gear(int teeth, bool internal = false, double shift = 0) {
    Gear g;
    g.teeth = teeth;
    g.module_m = 3.175e-3;
    g.pressure_angle_rad = 20 * pi / 180;
    g.internal = internal;
    g.profile_shift = shift;
    return g;
}

// A point as a complex number; O_1 lies at 0, the pitch point on the real axis.
using Point = std::complex<double>;

class TurnedFlanks {
  public:
    explicit TurnedFlanks(const MeshGeometry& mesh)
        : mesh_(mesh),
          angle_(mesh.working_pressure_angle()),
          sense_(mesh.internal() ? 1 : -1),
          centre_(mesh.working_pitch_radius(1) +
                  (mesh.internal() ? -1 : 1) * mesh.working_pitch_radius(2)) {}

    double gap_before(double tau) const {
        const Gear& two = mesh_.gear(2);
        const Point corner = centre_ + turned(2, sense_ * unwound(two, two.tip_radius()), tau);
        const double radius = std::abs(corner);
        const Point flank = turned(1, unwound(mesh_.gear(1), radius), tau);
        return mesh_.gear(1).base_radius() * std::arg(flank / corner);
    }
    double gap_after(double tau) const {
        const Gear& one = mesh_.gear(1);
        const Point corner = turned(1, unwound(one, one.tip_radius()), tau) - centre_;
        const Point flank = turned(2, sense_ * unwound(mesh_.gear(2), std::abs(corner)), tau);
        return -sense_ * mesh_.gear(2).base_radius() * std::arg(flank / corner);
    }

  private:
    // The flank's point at a radius, from its gear's centre, while the pair is in contact at the
    // pitch point: tangent point and free length of the string.
    Point unwound(const Gear& gear, double radius) const {
        const double base = gear.base_radius();
        const double length = std::sqrt(radius * radius - base * base);
        const double tangent = length / base - std::tan(angle_) + angle_;
        return std::polar(1.0, tangent) * Point(base, -length);
    }
    Point turned(int which, Point point, double tau) const {
        const double along = (tau - mesh_.pitch_position()) * mesh_.base_pitch();
        const double turn = -along / mesh_.gear(which).base_radius();
        return std::polar(1.0, which == 1 ? turn : sense_ * turn) * point;
    }

    const MeshGeometry& mesh_;
    double angle_, sense_, centre_;
};

}  // namespace

TEST_CASE("corner gap is zero on the path and continuous at its ends") {
    for (const MeshGeometry& mesh :
         {MeshGeometry(gear(19), gear(31)), MeshGeometry(gear(31), gear(81, true)),
          MeshGeometry(gear(17, false, 0.3), gear(43, false, 0.2))}) {
        const double end = mesh.contact_ratio();
        CHECK(corner_gap(mesh, 0) == 0);
        CHECK(corner_gap(mesh, 0.5 * end) == 0);
        CHECK(corner_gap(mesh, end) == 0);
        CHECK(corner_gap(mesh, -1e-6) == Approx(0).margin(1e-13));
        CHECK(corner_gap(mesh, end + 1e-6) == Approx(0).margin(1e-13));
        for (double x = 0.01; x < kLongestReach; x += 0.01) {
            CHECK(corner_gap(mesh, -x) > corner_gap(mesh, 0.01 - x));
            CHECK(corner_gap(mesh, end + x) > corner_gap(mesh, end + x - 0.01));
        }
    }
}

// Source: the prototype's kinematics of the 19/31 pair, 7,100 to 12,700 um at one length of the
// path.
TEST_CASE("corner gap of an external pair grows as published with the square of the distance") {
    const MeshGeometry mesh(gear(19), gear(31));
    const double length = mesh.contact_ratio();
    for (const double part : {0.02, 0.05, 0.1}) {
        const double before = corner_gap(mesh, -part * length) / (part * part);
        const double after = corner_gap(mesh, (1 + part) * length) / (part * part);
        CHECK(before == Approx(12.4e-3).epsilon(0.06));
        CHECK(after == Approx(7.2e-3).epsilon(0.05));
    }
}

// Both flanks as strings unwound from their base circles through the pitch point, rotated about
// their centres: the corner of one and the point of the other at the same radius.
TEST_CASE("corner gap equals the gap between unwound flanks") {
    for (const auto& [one, two] :
         {std::pair{gear(19), gear(31)}, std::pair{gear(31), gear(81, true)},
          std::pair{gear(23), gear(17, false, 0.4)}}) {
        const MeshGeometry mesh(one, two);
        const TurnedFlanks flanks(mesh);
        for (const double beyond : {0.01, 0.1, 0.2, 0.3}) {
            CHECK(corner_gap(mesh, -beyond) ==
                  Approx(flanks.gap_before(-beyond)).epsilon(1e-9).margin(1e-15));
            const double tau = mesh.contact_ratio() + beyond;
            CHECK(corner_gap(mesh, tau) ==
                  Approx(flanks.gap_after(tau)).epsilon(1e-9).margin(1e-15));
        }
    }
}

TEST_CASE("reach is the distance at which the corner gap has a given size") {
    for (const bool internal : {false, true}) {
        const MeshGeometry mesh(gear(31), internal ? gear(81, true) : gear(43));
        const CornerReach reach = corner_reach(mesh, 10e-6);
        CHECK(corner_gap(mesh, -reach.before) == Approx(10e-6));
        CHECK(corner_gap(mesh, mesh.contact_ratio() + reach.after) == Approx(10e-6));
        CHECK(corner_reach(mesh, 1).before == kLongestReach);
        CHECK(corner_reach(mesh, 0).after == Approx(0).margin(1e-7));
    }
}

}  // namespace test_corner_contact
