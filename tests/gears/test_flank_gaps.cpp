// Checks the gap outside the path of contact against involutes that are rotated into each other
// point by point.
#include "gears/flank_gaps.hpp"
#include "gears/gear.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_corner_contact {

using std::numbers::pi;

Gear gear(int teeth, bool internal = false, double shift = 0) {
    Gear g{teeth, internal, 3.175e-3, 20 * pi / 180};
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

}  // namespace gearpod::gears::test_corner_contact

// Checks the wear of flanks against sliding speeds of circles that roll on each other.

namespace gearpod::gears::test_flank_wear {

using std::numbers::pi;

constexpr double kModule = 3.175e-3, kAngle = 20 * pi / 180;

Gear gear(int teeth, bool internal = false) {
    return {teeth, internal, kModule, kAngle};
}

// Gears as circles. Gear 1 turns about 0 at 1 rad/s; the pitch point lies on the real axis and the
// contact moves along the line of action, t metres after the pitch point.
class RollingCircles {
  public:
    RollingCircles(int teeth_1, int teeth_2, bool internal) {
        const double radius_1 = 0.5 * kModule * teeth_1, radius_2 = 0.5 * kModule * teeth_2;
        pitch_ = radius_1;
        centre_2_ = internal ? radius_1 - radius_2 : radius_1 + radius_2;
        speed_2_ = (internal ? 1 : -1) * radius_1 / radius_2;
        const double tip_1 = radius_1 + kModule;
        const double tip_2 = radius_2 + (internal ? -kModule : kModule);
        end_ = crossing(0, tip_1, 1);
        begin_ = crossing(centre_2_, tip_2, -1);
    }

    double length() const { return end_ - begin_; }
    // Sliding over the speed of the contact along the flank of a gear, at a distance from the start
    // of contact.
    double specific_sliding(int which, double since) const {
        const double t = begin_ + since;
        const double along[] = {flank_speed(1, 0, t), flank_speed(speed_2_, centre_2_, t)};
        return std::abs(along[0] - along[1]) / along[which - 1];
    }

  private:
    using Point = std::complex<double>;
    Point line() const { return {std::sin(kAngle), std::cos(kAngle)}; }
    Point contact(double t) const { return pitch_ + t * line(); }
    // Speed of the body's point at the contact, parallel to the flanks.
    double flank_speed(double turning, Point centre, double t) const {
        const Point velocity = turning * Point(0, 1) * (contact(t) - centre);
        return (velocity * std::conj(Point(0, 1) * line())).real();
    }
    // Where the line of action crosses a circle, before (-1) or after (1) the pitch point.
    double crossing(Point centre, double radius, int side) const {
        double inside = 0, outside = side * 10 * kModule;
        const bool grows = std::abs(contact(outside) - centre) > radius;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (inside + outside);
            ((std::abs(contact(middle) - centre) > radius) == grows ? outside : inside) = middle;
        }
        return inside;
    }

    double pitch_, centre_2_, speed_2_, begin_ = 0, end_ = 0;
};

TEST_CASE("flanks wear in proportion to the specific sliding of rolling circles") {
    for (const auto& [teeth_1, teeth_2, internal] :
         {std::tuple{19, 31, false}, {31, 81, true}, {24, 20, false}, {27, 27, false}}) {
        const MeshGeometry mesh(gear(teeth_1), gear(teeth_2, internal));
        const RollingCircles circles(teeth_1, teeth_2, internal);
        const double ratio = mesh.contact_ratio();
        CHECK(circles.length() == Approx(ratio * mesh.base_pitch()).epsilon(1e-9));
        for (const int worn : {1, 2}) {
            INFO(teeth_1 << "/" << teeth_2 << ", gear " << worn);
            const FlankWear wear(mesh, worn);
            const double largest = std::max(circles.specific_sliding(worn, 0),
                                            circles.specific_sliding(worn, circles.length()));
            for (int i = 0; i <= 50; ++i) {
                const double tau = ratio * i / 50;
                CHECK(wear.shape(tau) ==
                      Approx(circles.specific_sliding(worn, tau * mesh.base_pitch()) / largest)
                          .margin(1e-9));
                CHECK(wear.shape(tau) <= 1);
            }
            CHECK(std::max(wear.shape(0), wear.shape(ratio)) == 1);
            CHECK(wear.shape(mesh.pitch_position()) == Approx(0).margin(1e-12));
            // Outside of the path the value at its end.
            CHECK(wear.shape(-0.2) == wear.shape(0));
            CHECK(wear.shape(ratio + 0.2) == wear.shape(ratio));
        }
    }
}

// A tooth of either gear slides most where its root meets the mate's tip.
TEST_CASE("equal gears wear symmetrically, most at their roots") {
    const MeshGeometry mesh(gear(27), gear(27));
    const FlankWear first(mesh, 1), second(mesh, 2);
    const double ratio = mesh.contact_ratio();
    for (double tau = 0; tau < ratio; tau += 0.05) {
        CHECK(first.shape(tau) == Approx(second.shape(ratio - tau)).margin(1e-12));
    }
    CHECK(first.shape(0) == 1);
    CHECK(first.shape(ratio) < 0.6);
}

}  // namespace gearpod::gears::test_flank_wear
