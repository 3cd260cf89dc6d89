// Checks the wear of flanks against sliding speeds of circles that roll on each other.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "gears/flank_wear.hpp"

namespace test_flank_wear {

using namespace gearpod::gears;
using std::numbers::pi;

namespace {

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

}  // namespace

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

}  // namespace test_flank_wear
