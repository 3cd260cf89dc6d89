#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/numbers.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/stiffness/printed_forms.hpp"

namespace gearpod::stiffness::test_tooth_compliance {

using printed::check_equal;
using namespace test_pairs;

printed::Tooth printed_tooth(int teeth, bool is_internal = false) {
    return {teeth,
            kPressureAngle,
            kLiangSteel.youngs_modulus_Pa,
            kLiangSteel.face_width_m,
            kLiangSteel.poisson_ratio,
            kModule,
            is_internal};
}

// Contact angles from the lower part of the tooth to its tip.
std::vector<double> contact_angles(const gears::MeshGeometry& mesh, int which) {
    return test::tabulated(
        7, [&](int i) { return mesh.contact_angle(which, mesh.contact_ratio() * i / 6); });
}

TEST_CASE(
    "a tooth has Tian's compliances from the base circle, and Liang's 3.2.13 to 3.2.15 from a root "
    "circle inside it") {
    const gears::MeshGeometry tian(external(19), external(48)), liang(external(19), external(31));
    for (const int which : {1, 2}) {
        const ToothProfile base(tian.gear(which), Profile::base_circle),
            root(liang.gear(which), Profile::root_circle);
        for (const double a1 : contact_angles(tian, which))
            check_equal(tooth_compliance(base, kLiangSteel, a1),
                        printed_tooth(tian.gear(which).teeth).base_circle(a1));
        for (const double a1 : contact_angles(liang, which))
            check_equal(tooth_compliance(root, kLiangSteel, a1),
                        printed_tooth(liang.gear(which).teeth).root_circle(a1));
    }
}

TEST_CASE(
    "a tooth from a root circle outside the base circle has Liang's compliances 3.2.18 to 3.2.20") {
    const gears::MeshGeometry mesh(external(19), external(48));
    const ToothProfile profile(mesh.gear(2), Profile::root_circle);
    for (const double a1 : contact_angles(mesh, 2))
        check_equal(tooth_compliance(profile, kLiangSteel, a1),
                    printed_tooth(48).root_on_involute(a1));
}

TEST_CASE("an internal tooth has Liang's compliances 2.2.25 to 2.2.27") {
    for (const int teeth : {60, 81, 200}) {  // beta_2 positive and negative
        const gears::MeshGeometry mesh(external(31), internal(teeth));
        const ToothProfile profile(mesh.gear(2), Profile::root_circle);
        for (const double b1 : contact_angles(mesh, 2))
            check_equal(tooth_compliance(profile, kLiangSteel, b1),
                        printed_tooth(teeth, true).internal_tooth(b1));
    }
}

TEST_CASE("a cracked tooth has Liang's compliances in conditions 1 to 3, as corrected") {
    // Eqs. 3.5.5-3.5.14 for 31 teeth, root inside base; Eqs. 3.5.18-3.5.23 for 48 teeth, root
    // outside base.
    for (const int teeth : {31, 48}) {
        const gears::MeshGeometry mesh(external(19), external(teeth));
        const ToothProfile profile(mesh.gear(2), Profile::root_circle);
        const double max_depth = max_crack_depth(profile, kCrackAngle);
        for (const double fraction : {0.01, 0.1, 0.25, 0.4, 0.499, 0.5, 0.55, 0.7, 0.9, 0.99}) {
            const Crack crack{fraction * max_depth, kCrackAngle};
            const printed::CrackedTooth expected{printed_tooth(teeth), crack.depth_m,
                                                 crack.angle_rad};
            for (const double a1 : contact_angles(mesh, 2)) {
                INFO(teeth << " teeth, depth " << fraction << ", alpha_1 " << a1);
                const bool condition_4 = fraction > 0.5 && -a1 <= expected.boundary();
                if (condition_4)
                    CHECK(std::isinf(tooth_compliance(profile, kLiangSteel, a1, crack).total()));
                else
                    check_equal(tooth_compliance(profile, kLiangSteel, a1, crack),
                                expected.compliance(a1));
            }
        }
    }
}

TEST_CASE("Tian's crack in a tooth from the base circle has his compliances 3.12 to 3.15") {
    const gears::MeshGeometry mesh(external(19), external(48));
    const ToothProfile profile(mesh.gear(1), Profile::base_circle);
    const printed::Tooth tooth = printed_tooth(19);
    const double q = 3.1e-3;  // his example
    const double height = std::sin(tooth.a2()) - q / tooth.Rb() * std::sin(kCrackAngle);
    const printed::CrackedTooth crack{tooth, q, kCrackAngle};
    REQUIRE(height == Approx(crack.height()));  // the base and the root chord have the same length
    for (const double a1 : contact_angles(mesh, 1)) {
        const double g = std::clamp(crack.boundary(), -a1, tooth.a2());
        const auto healthy = tooth.base_circle(a1);
        check_equal(
            tooth_compliance(profile, kLiangSteel, a1, {q, kCrackAngle}),
            {tooth.bending(g, tooth.a2(), a1, height, true) + tooth.bending(-a1, g, a1, 0, false),
             tooth.shear(g, tooth.a2(), a1, height, true) + tooth.shear(-a1, g, a1, 0, false),
             healthy.axial});
    }
}

TEST_CASE("a crack in an internal tooth follows the same section law, without lengthening") {
    const gears::MeshGeometry mesh(external(31), internal(81));
    const ToothProfile profile(mesh.gear(2), Profile::root_circle);
    const printed::Tooth tooth = printed_tooth(81, true);
    const double phi = tooth.a2() + std::tan(std::acos(81 * std::cos(kPressureAngle) / 83.5));
    for (const double fraction : {0.1, 0.3, 0.5, 0.6}) {
        const Crack crack{fraction * max_crack_depth(profile, kCrackAngle), kCrackAngle};
        const double height = tooth.involute(phi) * (1 - 2 * fraction);
        const auto excess = [&](double a) { return tooth.involute(a) - std::abs(height); };
        // Thinner than any section of the tooth: the law changes beyond the tip.
        double law_ends = 0;
        if (excess(0.0) < 0)
            law_ends = boost::math::tools::bisect(excess, 0.0, phi,
                                                  boost::math::tools::eps_tolerance<double>(52))
                           .first;
        for (const double b1 : contact_angles(mesh, 2)) {
            if (fraction > 0.5 && b1 <= law_ends) {
                CHECK(std::isinf(tooth_compliance(profile, kLiangSteel, b1, crack).total()));
                continue;
            }
            const double g = std::max(law_ends, b1);
            const auto healthy = tooth.internal_tooth(b1);
            check_equal(
                tooth_compliance(profile, kLiangSteel, b1, crack),
                {tooth.bending(phi, g, b1, height, true) + tooth.bending(g, b1, b1, 0, false),
                 tooth.shear(phi, g, b1, height, true) + tooth.shear(g, b1, b1, 0, false),
                 healthy.axial});
        }
    }
}

TEST_CASE("the beam of a cracked external tooth lengthens down to the crack tip") {
    const ToothProfile profile(external(19), Profile::root_circle);
    const double max_depth = max_crack_depth(profile, kCrackAngle);
    const auto below = [&](double depth) {
        return CrackedSections(profile, {depth, kCrackAngle}).lengthening();
    };
    CHECK(below(0.2 * max_depth) == Approx(0.2 * max_depth * std::cos(kCrackAngle)));
    CHECK(below(0.8 * max_depth) == Approx(0.2 * max_depth * std::cos(kCrackAngle)));
    CHECK(below(0) == 0);
}

TEST_CASE(
    "Liang's condition 4 diverges: compliance grows as the inverse square of the remaining "
    "section") {
    const ToothProfile profile(external(19), Profile::root_circle);
    const Crack crack{0.75 * max_crack_depth(profile, kCrackAngle), kCrackAngle};
    const CrackedSections sections(profile, crack);
    const auto bending = [&](double thickness) {
        const double u = profile.angle_of_half_thickness(-sections.tip_height() + thickness);
        return tooth_compliance(profile, kLiangSteel, -u, crack).bending;
    };
    CHECK(bending(1e-7) / bending(2e-7) == Approx(4).epsilon(0.01));
    CHECK(bending(1e-8) / bending(2e-8) == Approx(4).epsilon(0.001));
}

TEST_CASE(
    "crack lengths to the centre line are Liang's 3.90 mm in the sun and 4.30 mm in a planet") {
    // Source: Tables 3.2 and 3.3, 50 % level at 45 degrees.
    const ToothProfile sun(external(19), Profile::root_circle);
    const ToothProfile planet(external(31), Profile::root_circle);
    CHECK(max_crack_depth(sun, kCrackAngle) / 2 == Approx(3.90e-3).margin(0.01e-3));
    CHECK(max_crack_depth(planet, kCrackAngle) / 2 == Approx(4.30e-3).margin(0.02e-3));
}

TEST_CASE("a shallow crack removes only the involute's bulge on one side") {
    for (const auto& gear : cracked_gears()) {
        const ToothProfile profile(gear.geometry.gear(gear.which), gear.profile);
        for (const double angle : contact_angles(gear.geometry, gear.which)) {
            const double healthy = tooth_compliance(profile, kLiangSteel, angle).total();
            const double first =
                tooth_compliance(profile, kLiangSteel, angle, {1e-12, 0.8}).total();
            CHECK(first / healthy >= 1 - 1e-12);
            CHECK(first / healthy < 1 + 1e-3);
        }
    }
}

}  // namespace gearpod::stiffness::test_tooth_compliance
