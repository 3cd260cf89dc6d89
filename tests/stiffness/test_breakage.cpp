#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/breakage.hpp"
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

}  // namespace gearpod::stiffness::test_breakage
