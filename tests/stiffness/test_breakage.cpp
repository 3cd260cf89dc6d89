#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/breakage.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_breakage {

using namespace test_pairs;

const gears::MeshGeometry kTianMesh(external(19), external(48));
constexpr double kFace = kTianSteel.face_width_m, kWidth = 0.3 * kFace, kHeight = 2e-3;
const double kHertz = std::numbers::pi * 2.068e11 * kFace / (4 * (1 - 0.3 * 0.3));

double healthy_beam(int which, double tau) {
    return tooth_compliance({kTianMesh.gear(which), Profile::base_circle}, kTianSteel,
                            kTianMesh.contact_angle(which, tau))
        .total();
}

// Axial coordinate of the pinion's contact by Eq. 3.3 of Tian (2004), not through the profile.
double contact_axial(double tau) {
    const double a = kTianMesh.contact_angle(1, tau);
    const double half = kTianMesh.gear(1).half_base_angle();
    return kTianMesh.gear(1).base_radius() * ((a + half) * std::sin(a) + std::cos(a));
}

// Compliance of the pinion's sections above the plane, by the midpoint rule over the healthy tooth.
double compliance_above_plane(double tau) {
    const gears::Gear& gear = kTianMesh.gear(1);
    const ToothProfile profile(gear, Profile::base_circle);
    const double angle = kTianMesh.contact_angle(1, tau), c = std::cos(angle), s = std::sin(angle);
    const double plane = profile.angle_of_axial(gear.tip_radius() - kHeight), contact = -angle;
    const double shear_modulus = 2.068e11 / 2.6;
    constexpr int kSections = 20000;
    double sum = 0;
    for (int i = 0; i < kSections && contact < plane; ++i) {
        const ToothSection at =
            profile.section(contact + (plane - contact) * (i + 0.5) / kSections);
        const double t = 2 * at.half_thickness, arm = gear.base_radius() - at.axial * c;
        sum += at.axial_slope * (plane - contact) / kSections *
               (12 * arm * arm / (2.068e11 * t * t * t * kFace) +
                (1.2 * c * c / shear_modulus + s * s / 2.068e11) / (t * kFace));
    }
    return sum;
}

TEST_CASE("a tooth broken along its whole flank is as compliant as a narrower tooth") {
    const AdditiveMesh mesh(kTianMesh, kTianSteel, Profile::base_circle);
    const ToothBreakage family(kTianMesh, kTianSteel, Profile::base_circle, 1);
    CHECK(family.jumps().empty());
    const auto breakage = family.at(kWidth);
    const ToothPairCurve pair = mesh.faulty_pair(*breakage);
    for (int i = 0; i <= 200; ++i) {
        const double tau = mesh.contact_ratio() * i / 200;
        CHECK(breakage->contact_width(tau) == Approx(0.7));
        const double narrower = (1 / kHertz + healthy_beam(1, tau)) / 0.7;
        CHECK(pair(tau) == Approx(1 / (narrower + healthy_beam(2, tau))).epsilon(2e-9));
    }
}

TEST_CASE("a breakage weakens the contacts above its plane by the sections in between") {
    const AdditiveMesh mesh(kTianMesh, kTianSteel, Profile::base_circle);
    const ToothBreakage family(kTianMesh, kTianSteel, Profile::base_circle, 1, kHeight);
    REQUIRE(family.jumps().size() == 1);
    const double plane = family.jumps()[0];
    CHECK(kTianMesh.gear(1).tip_radius() - contact_axial(plane) == Approx(kHeight));
    const auto breakage = family.at(kWidth);
    CHECK(breakage->jumps() == family.jumps());
    const ToothPairCurve healthy = mesh.faulty_pair(*family.at(1e-12)),
                         pair = mesh.faulty_pair(*breakage);
    for (int i = 0; i <= 100; ++i) {
        const double tau = mesh.contact_ratio() * i / 100;
        INFO(tau);
        if (tau < plane) {
            CHECK(breakage->contact_width(tau) == 1);
            CHECK(pair(tau) == Approx(healthy(tau)).epsilon(1e-9));
            continue;
        }
        CHECK(breakage->contact_width(tau) == Approx(0.7));
        const double expected = 1 / kHertz / 0.7 + healthy_beam(1, tau) + healthy_beam(2, tau) +
                                0.3 / 0.7 * compliance_above_plane(tau);
        CHECK(pair(tau) == Approx(1 / expected).epsilon(1e-7));
    }
}

TEST_CASE("a tooth broken over its whole face carries no load above the plane") {
    const AdditiveMesh mesh(kTianMesh, kTianSteel, Profile::base_circle);
    const ToothBreakage family(kTianMesh, kTianSteel, Profile::base_circle, 1, kHeight);
    CHECK(family.largest_size() == kFace);
    const ToothPairCurve pair = mesh.faulty_pair(*family.at(kFace));
    const double plane = family.jumps()[0];
    CHECK(pair(0.5 * (plane + mesh.contact_ratio())) == 0);
    CHECK(pair(0.5 * plane) > 0);
}

TEST_CASE("breakages on either gear, external or internal, lie at its tip") {
    for (const auto& gear : cracked_gears()) {
        INFO(gear.name);
        const ToothBreakage family(gear.geometry, kLiangSteel, gear.profile, gear.which, 1e-3);
        const double width = 4e-3;
        const auto breakage = family.at(width);
        CHECK(family.problems(width).empty());
        CHECK(family.jumps().size() == 1);
        // Contact reaches the tip of gear 1 last, that of gear 2 first.
        const double tip = gear.which == 1 ? gear.geometry.contact_ratio() : 0;
        const double other = gear.geometry.contact_ratio() - tip;
        CHECK(breakage->contact_width(tip) == Approx(1 - width / kLiangSteel.face_width_m));
        CHECK(breakage->contact_width(other) == 1);
        const ToothBreakage flank(gear.geometry, kLiangSteel, gear.profile, gear.which);
        CHECK(flank.flank_height() > 1e-3);
        CHECK(flank.at(width)->contact_width(other) < 1);
    }
}

TEST_CASE("a breakage lies at the end of the face that the study names") {
    const auto face = [](FaceEnd end) {
        return ToothBreakage(kTianMesh, kTianSteel, Profile::base_circle, 1, kHeight, end)
            .at(kWidth)
            ->face();
    };
    CHECK(face(FaceEnd::first).end == Approx(0.3));
    CHECK(face(FaceEnd::last).begin == Approx(0.7));
}

TEST_CASE("a breakage larger than its tooth is reported as such") {
    const ToothBreakage family(kTianMesh, kTianSteel, Profile::base_circle, 1, kHeight);
    CHECK(family.problems(kFace).empty());
    CHECK(family.problems(1.1 * kFace).size() == 1);
    const ToothBreakage high(kTianMesh, kTianSteel, Profile::base_circle, 1, 20e-3);
    CHECK(high.problems(kWidth).size() == 1);
    CHECK(high.problems(1.1 * kFace).size() == 2);
}

constexpr double kLength = 8e-3, kDepth = 2e-3;  // Tian (2004), below Eq. 3.4: z and b

// Distance d_c of Eq. 3.3.
double distance(double tau) {
    const gears::Gear& pinion = kTianMesh.gear(1);
    return contact_axial(tau) - pinion.base_radius() * std::cos(pinion.half_base_angle());
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
    for (int i = 0; i <= 200; ++i) {
        const double tau = mesh.contact_ratio() * i / 200;
        const double expected =
            1 / kHertz / chip->contact_width(tau) + healthy_beam(1, tau) + healthy_beam(2, tau);
        CHECK(pair(tau) == Approx(1 / expected).epsilon(2e-9));
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

}  // namespace gearpod::stiffness::test_breakage
