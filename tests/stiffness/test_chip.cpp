#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_chip {

using namespace test_pairs;

const gears::MeshGeometry kTianMesh(external(19), external(48));
constexpr double kFace = kTianSteel.face_width_m;
constexpr double kLength = 8e-3, kDepth = 2e-3;  // Tian (2004), below Eq. 3.4: z and b

// Distance d_c of Eq. 3.3 with the contact's own angle, not through the profile.
double distance(double tau) {
    const double a = kTianMesh.contact_angle(1, tau);
    const double base = kTianMesh.gear(1).base_radius();
    const double half = kTianMesh.gear(1).half_base_angle();
    return base * ((a + half) * std::sin(a) + std::cos(a) - std::cos(half));
}

TEST_CASE("contact with Tian's chip of 8 mm begins when the pinion has turned 22.4 degrees") {
    const ToothChip family(kTianMesh, kFace, 1);
    const auto chip = family.at(kLength);
    REQUIRE(chip->breaks().size() == 2);
    const double begin = chip->breaks()[0];
    CHECK(begin * 360 / 19 == Approx(22.4).margin(0.05));
    // Source: section 4.4, one shaft turn later at t = 0.0354 s; the pinion speed is 30 Hz.
    CHECK((1 + begin / 19) / 30 == Approx(0.0354).margin(0.00005));
    CHECK(chip->contact_width(begin - 1e-9) == 1);
    CHECK(chip->contact_width(begin + 1e-9) == Approx(1).epsilon(1e-6));
}

TEST_CASE("the chip's edge is the hyperbola through Tian's two points") {
    const ToothChip family(kTianMesh, kFace, 1);
    const auto chip = family.at(kLength);
    const double height = family.tooth_height();
    // Hyperbola L_c d_c = A + B d_c through (L, d_h - b) and (L - z, d_h).
    const double b = ((kFace - kLength) * height - kFace * (height - kDepth)) / kDepth;
    const double a = (kFace - b) * (height - kDepth);
    double before = 1;
    for (int i = 1; i < 100; ++i) {
        const double tau = chip->breaks()[0] + (chip->breaks()[1] - chip->breaks()[0]) * i / 100;
        const double width = chip->contact_width(tau);
        CHECK(width * kFace == Approx(a / distance(tau) + b).epsilon(1e-10));
        CHECK(width < before);
        before = width;
    }
    CHECK(distance(chip->breaks()[0]) == Approx(height - kDepth).epsilon(1e-10));
    CHECK(distance(chip->breaks()[1]) == Approx(height).epsilon(1e-10));
    CHECK(chip->contact_width(kTianMesh.contact_ratio()) ==
          Approx((kFace - kLength) / kFace).epsilon(1e-12));
}

TEST_CASE("a chip lowers only the Hertz stiffness of its own pair, in proportion to the width") {
    const AdditiveMesh mesh(kTianMesh, kTianSteel, Profile::base_circle);
    const ToothChip family(kTianMesh, kFace, 1);
    const auto chip = family.at(kLength);
    const ToothPairCurve pair = mesh.faulty_pair(*chip);
    const double hertz = std::numbers::pi * 2.068e11 * kFace / (4 * (1 - 0.3 * 0.3));
    for (int i = 0; i <= 200; ++i) {
        const double tau = mesh.contact_ratio() * i / 200;
        double beams = 0;
        for (const int which : {1, 2})
            beams += tooth_compliance({kTianMesh.gear(which), Profile::base_circle}, kTianSteel,
                                      kTianMesh.contact_angle(which, tau))
                         .total();
        const double expected = 1 / (1 / (hertz * chip->contact_width(tau)) + beams);
        CHECK(pair(tau) == Approx(expected).epsilon(2e-9));
    }
}

TEST_CASE("chips on either gear, external or internal, lie at its tip") {
    for (const auto& gear : cracked_gears()) {
        INFO(gear.name);
        const ToothChip family(gear.geometry, 0.0381, gear.which);
        const double length = 4e-3;
        const auto chip = family.at(length);
        CHECK(family.problems(length).empty());
        // Contact reaches the tip of gear 1 last, that of gear 2 first.
        const double tip = gear.which == 1 ? gear.geometry.contact_ratio() : 0;
        const double other = gear.geometry.contact_ratio() - tip;
        CHECK(chip->contact_width(tip) < 1 - 0.8 * length / 0.0381);
        CHECK(chip->contact_width(tip) >= 1 - length / 0.0381 - 1e-12);
        CHECK(chip->contact_width(other) == 1);
    }
}

TEST_CASE("a chip larger than its tooth is reported as such") {
    const ToothChip family(kTianMesh, kFace, 1);
    CHECK(family.problems(kLength).empty());
    CHECK(family.problems(17e-3).size() == 1);
    CHECK(family.problems(25e-3).size() == 2);
    CHECK(family.largest_size() == kFace);
    const double end = kTianMesh.contact_ratio();
    CHECK(family.at(1)->contact_width(end) == family.at(kFace)->contact_width(end));
    CHECK(family.at(kFace)->contact_width(end) == Approx(0).margin(1e-12));
}

}  // namespace gearpod::stiffness::test_chip
