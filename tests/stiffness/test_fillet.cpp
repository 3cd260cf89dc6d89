#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/stiffness/yang_forms.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_fillet {

using printed::check_equal;
using namespace test_pairs;

constexpr Material kSteel{2.06e11, 0.3, 0.018};

gears::Gear gear_of(int teeth) {
    return {teeth, false, 2e-3, kPressureAngle};
}

yang::Tooth printed_tooth(int teeth) {
    return {gear_of(teeth), kSteel.youngs_modulus_Pa, kSteel.face_width_m, kSteel.poisson_ratio};
}

// Direction of the flank from the section at u towards the root.
double slope(const ToothProfile& profile, double u, double step) {
    const ToothSection a = profile.section(u), b = profile.section(u + step);
    return std::atan2(b.half_thickness - a.half_thickness, b.axial - a.axial);
}

TEST_CASE("the fillet's arc solves Yang's equations 10 to 15") {
    for (const int teeth : {30, 34, 60, 120}) {
        const ToothProfile profile(gear_of(teeth), Profile::fillet);
        const yang::Tooth printed = printed_tooth(teeth);
        CHECK(-profile.involute_root() == Approx(printed.alpha_te(printed.Rte())).epsilon(1e-9));
        CHECK(profile.root_axial() == Approx(printed.x_r()).epsilon(1e-12));
        CHECK(profile.fillet_radius() == Approx(printed.rho_t()).epsilon(1e-12));
    }
}

TEST_CASE("the flank is smooth from the involute to the root circle") {
    // Yang's sun of 28 teeth, and 19 teeth, have a radial part between involute and arc.
    for (const int teeth : {19, 28, 30, 34, 96}) {
        const ToothProfile profile(gear_of(teeth), Profile::fillet);
        for (const double u : {profile.involute_root(), profile.fillet_end()}) {
            const ToothSection below = profile.section(u + 1e-9), above = profile.section(u - 1e-9);
            CHECK(std::abs(below.half_thickness - above.half_thickness) < 1e-10);
            CHECK(std::abs(below.axial - above.axial) < 1e-10);
            CHECK(slope(profile, u + 1e-5, 1e-5) ==
                  Approx(slope(profile, u - 1e-5, -1e-5) -
                         std::copysign(printed::kPi, slope(profile, u - 1e-5, -1e-5)))
                      .margin(1e-3));
        }
        // The arc ends on the root circle and tangent to it.
        CHECK(profile.root_radius() == Approx(gear_of(teeth).root_radius()).epsilon(1e-12));
        const ToothSection end = profile.section(profile.root()),
                           near = profile.section(profile.root() - 1e-6);
        CHECK(std::hypot(near.axial, near.half_thickness) - profile.root_radius() < 1e-12);
        CHECK(std::hypot(near.axial - end.axial, near.half_thickness - end.half_thickness) ==
              Approx(1e-6 * profile.fillet_radius()).epsilon(1e-3));
    }
}

TEST_CASE("a tooth with a fillet has Yang's compliances 16 to 18") {
    const gears::MeshGeometry mesh(gear_of(30), gear_of(34));
    for (const int which : {1, 2}) {
        const ToothProfile profile(mesh.gear(which), Profile::fillet);
        const yang::Tooth printed = printed_tooth(mesh.gear(which).teeth);
        for (const double share : {0.0, 0.3, 0.7, 1.0}) {
            const double a1 = mesh.contact_angle(which, share * mesh.contact_ratio());
            check_equal(tooth_compliance(profile, kSteel, a1), printed.compliance(a1), 1e-8);
        }
    }
}

TEST_CASE("a fillet reduces the root circle profile's compliance by a few percent") {
    for (const int teeth : {28, 34, 60}) {
        const gears::MeshGeometry mesh(gear_of(28), gear_of(teeth));
        const double a1 = mesh.contact_angle(2, 0.5 * mesh.contact_ratio());
        const auto of = [&](Profile profile) {
            return tooth_compliance(ToothProfile(mesh.gear(2), profile), kSteel, a1).total();
        };
        const double change = of(Profile::fillet) / of(Profile::root_circle) - 1;
        CHECK(change < -0.01);
        CHECK(change > -0.03);
    }
}

TEST_CASE("without shear energy a tooth keeps its bending and its axial compliance") {
    Material rigid = kSteel;
    rigid.shear_energy = false;
    const ToothProfile profile(gear_of(28), Profile::fillet);
    const auto with = tooth_compliance(profile, kSteel, 0.3),
               without = tooth_compliance(profile, rigid, 0.3);
    CHECK(without.bending == with.bending);
    CHECK(without.axial == with.axial);
    CHECK(without.shear == 0);
    CrackedSections healthy(profile, {});
    SectionSweep sweep(profile, healthy);
    sweep.advance(profile.involute_angle(0.3));
    CHECK(compliance(sweep.moments(), profile, rigid, 0.3) ==
          Approx(without.total()).epsilon(1e-12));
}

TEST_CASE("cracks on the fillet and on the involute have Yang's compliances 30 to 58") {
    const gears::MeshGeometry mesh(gear_of(30), gear_of(34));
    const ToothProfile profile(mesh.gear(2), Profile::fillet);
    const yang::Tooth printed = printed_tooth(34);
    const double mm = 1e-3, degree = printed::kPi / 180;
    struct Condition {
        const char* name;
        yang::Tooth::Crack crack;
    };
    // The conditions of the names are those of a contact near the tip.
    const Condition conditions[] = {
        {"fillet, case 1, tip below h_te", {1.5 * mm, 45 * degree, 0.2 * mm}},
        {"fillet, case 1, tip above h_te", {0.15 * mm, 45 * degree, 0.05 * mm}},
        {"fillet, case 2, tip below h_te", {0.6 * mm, 70 * degree, 0.45 * mm}},
        {"fillet, case 2, tip above h_te", {0.1 * mm, 60 * degree, 0.1 * mm}},
        {"fillet, case 2, tip below h_a", {1.6 * mm, 85 * degree, 0.5 * mm}},
        {"from the root circle", {1 * mm, 45 * degree, 0}},
        {"involute, case 1", {1.9 * mm, 30 * degree, 1.4 * mm}},
        {"involute, case 2", {1.0 * mm, 45 * degree, 1.4 * mm}},
        {"involute, case 3", {0.5 * mm, 75 * degree, 2.2 * mm}},
        {"involute, case 3, tip below h_a", {1.6 * mm, 90 * degree, 2.2 * mm}},
    };
    for (const auto& [name, crack] : conditions)
        for (const double share : {0.0, 0.2, 0.5, 0.8, 1.0}) {
            INFO(name << ", contact at " << share);
            const double a1 = mesh.contact_angle(2, share * mesh.contact_ratio());
            const Crack same{crack.q, crack.gamma, crack.l};
            const auto expected = printed.compliance(a1, crack);
            check_equal(tooth_compliance(profile, kSteel, a1, same), expected, 1e-8);
            const CrackedSections sections(profile, same), whole(profile, {});
            const double u = profile.involute_angle(a1);
            SectionSweep sweep(profile, sections.affects(u) ? sections : whole);
            sweep.advance(u);
            CHECK(compliance(sweep.moments(), profile, kSteel, a1) ==
                  Approx(expected.total()).epsilon(1e-8));
        }
}

TEST_CASE("a crack has no effect on a contact below its start") {
    const ToothProfile profile(gear_of(34), Profile::fillet);
    const Crack crack{2e-3, 1.2, 3e-3};
    const CrackedSections sections(profile, crack);
    const auto ratio = [&](double u) {
        return tooth_compliance(profile, kSteel, -u, crack).total() /
               tooth_compliance(profile, kSteel, -u).total();
    };
    CHECK(ratio(sections.start() + 1e-9) == 1);
    CHECK(ratio(sections.start() - 1e-3) > 1);
}

TEST_CASE("a tooth breaks where the crack reaches the other flank") {
    for (const Profile kind : {Profile::root_circle, Profile::fillet})
        for (const double height : {0.0, 0.4e-3, 1.5e-3, 3e-3})
            for (const double angle : {0.5, 0.8, 1.5}) {
                const ToothProfile profile(gear_of(34), kind);
                const double depth = max_crack_depth(profile, angle, height);
                const double tip = profile.involute_angle(0.4);
                CHECK(std::isinf(
                    tooth_compliance(profile, kSteel, 0.4, {depth, angle, height}).total()));
                CHECK(CrackedSections(profile, {depth * (1 - 1e-9), angle, height}).broken() ==
                      false);
                // Sections below the boundary are positive just before breakage.
                const CrackedSections sections(profile, {depth * (1 - 1e-6), angle, height});
                for (double u = std::max(tip, sections.boundary()) + 1e-9; u < sections.lower_end();
                     u += 0.01)
                    REQUIRE(sections.cracked_thickness(profile.half_thickness(u)) > 0);
            }
}

}  // namespace gearpod::stiffness::test_fillet
