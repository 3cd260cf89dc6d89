#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_pitting {

using namespace test_pairs;

const gears::MeshGeometry kMesh(external(19), external(31));
const double kFace = kLiangSteel.face_width_m;

PitBand band_of(double depth_m, int teeth = 1) {
    return {kMesh.gear(1).pitch_radius(), 1.2e-3, depth_m, teeth};
}

// Area and inertia of a section with a notch in its top edge, fibre by fibre.
struct Notched {
    double area = 0, inertia = 0;
    Notched(double thickness, double width, double depth) {
        constexpr int kFibres = 4000;
        double moment = 0;
        const auto fibres = [&](auto&& add) {
            for (const auto& [from, to, wide] :
                 {std::array{0.0, thickness - depth, kFace},
                  std::array{thickness - depth, thickness, kFace - width}}) {
                const double h = (to - from) / kFibres;
                for (int i = 0; i < kFibres; ++i)
                    add(from + (i + 0.5) * h, wide * h);
            }
        };
        fibres([&](double y, double a) { area += a, moment += a * y; });
        fibres(
            [&](double y, double a) { inertia += a * (y - moment / area) * (y - moment / area); });
    }
};

// Additional compliance of gear 1's beam, by the midpoint rule over the band's sections below the
// contact with the notched sections above.
double extra_compliance(double tau, double width, double depth) {
    const gears::Gear& gear = kMesh.gear(1);
    const ToothProfile profile(gear, Profile::root_circle);
    const double contact_angle = kMesh.contact_angle(1, tau), contact = -contact_angle;
    const double base = gear.base_radius();
    const double arc = base / 2 * (std::pow(gear.pitch_radius() / base, 2) - 1);
    const auto angle = [&](double s) { return gear.half_base_angle() - std::sqrt(2 * s / base); };
    const double from = std::max(contact, angle(arc + 0.6e-3)), to = angle(arc - 0.6e-3);
    const double c = std::cos(contact_angle), s = std::sin(contact_angle);
    const double shear_modulus = 2.068e11 / 2.6;
    double sum = 0;
    constexpr int kPanels = 400;
    for (int i = 0; i < kPanels && from < to; ++i) {
        const ToothSection at = profile.section(from + (to - from) * (i + 0.5) / kPanels);
        const Notched notched(2 * at.half_thickness, width, depth),
            whole(2 * at.half_thickness, 0, 0);
        const double arm = base - at.axial * c, length = at.axial_slope * (to - from) / kPanels;
        const double direct = 1 / notched.area - 1 / whole.area;
        sum += length * (arm * arm / 2.068e11 * (1 / notched.inertia - 1 / whole.inertia) +
                         direct * (1.2 * c * c / shear_modulus + s * s / 2.068e11));
    }
    return sum;
}

TEST_CASE("pits reduce the contact width along their length of the profile") {
    const ToothPitting family(kMesh, kLiangSteel, Profile::root_circle, 1, band_of(0));
    const auto pits = family.at(10e-3);
    CHECK_FALSE(pits->changes_sections());
    const auto jumps = family.jumps();
    REQUIRE(jumps.size() == 2);
    // The involute's length up to a contact is R_b roll^2 / 2; its roll angle is the contact angle
    // + a2.
    const auto length = [&](double tau) {
        const double roll = kMesh.contact_angle(1, tau) + kMesh.gear(1).half_base_angle();
        return kMesh.gear(1).base_radius() * roll * roll / 2;
    };
    CHECK(length(jumps[1]) - length(jumps[0]) == Approx(1.2e-3).epsilon(1e-12));
    CHECK((length(jumps[1]) + length(jumps[0])) / 2 ==
          Approx(length(kMesh.pitch_position())).epsilon(1e-12));
    CHECK(pits->contact_width(kMesh.pitch_position()) == Approx(1 - 10 / 38.1).epsilon(1e-12));
    CHECK(pits->contact_width(jumps[0] - 1e-9) == 1);
    CHECK(pits->contact_width(jumps[1] + 1e-9) == 1);
}

TEST_CASE("pits soften the beam as notched sections do") {
    for (const double width : {8e-3, 25e-3, 38.1e-3}) {
        const double depth = 0.5e-3;
        const ToothPitting family(kMesh, kLiangSteel, Profile::root_circle, 1, band_of(depth));
        const auto pits = family.at(width);
        REQUIRE(pits->changes_sections());
        const ToothProfile profile(kMesh.gear(1), Profile::root_circle);
        // Positions before, within and beyond the band.
        for (const double tau : {0.2, kMesh.pitch_position(), 1.2, 1.55}) {
            double compliance = 0;
            pits->beam_compliance({&tau, 1}, {&compliance, 1});
            const double healthy =
                tooth_compliance(profile, kLiangSteel, kMesh.contact_angle(1, tau)).total();
            const double extra = extra_compliance(tau, width, depth);
            CHECK(compliance - healthy == Approx(extra).epsilon(2e-5).margin(1e-11 * healthy));
        }
    }
}

TEST_CASE(
    "a mesh with pitted teeth jumps at the band's ends and is healthy before contact with a pit") {
    const AdditiveMesh mesh(kMesh, kLiangSteel, Profile::root_circle);
    const ToothPitting family(kMesh, kLiangSteel, Profile::root_circle, 1, band_of(0.3e-3, 3));
    const auto pits = family.at(20e-3);
    const auto faulty = mesh.with_fault(*pits);
    CHECK(faulty->duration() == Approx(2 + mesh.contact_ratio()));
    CHECK(faulty->jumps().size() == 6);
    const ToothPairCurve one = mesh.faulty_pair(*pits);
    const double jump = family.jumps()[0];
    const auto at = [&](double tau, Limit limit) {
        return total_at(*faulty, mesh.transitions(), tau, limit);
    };
    for (const double tau : {0.05, 0.3, 0.49})  // the first pitted tooth and a healthy one
        CHECK(at(tau, Limit::from_above) ==
              Approx(one(tau) + mesh.tooth_pair(tau + 1)).epsilon(1e-9));
    for (const double tau : {1.1, 1.4, 2.2, 2.5})  // pitted ones only
        CHECK(at(tau, Limit::from_above) ==
              Approx(one(tau - std::floor(tau)) + one(tau - std::floor(tau) + 1)).epsilon(1e-9));
    for (const double tau : {3.1, 3.3})  // the last pitted tooth and a healthy one
        CHECK(at(tau, Limit::from_above) ==
              Approx(one(tau - 2) + mesh.tooth_pair(tau - 3)).epsilon(1e-9));
    for (int tooth = 0; tooth < 3; ++tooth) {
        const double before = at(tooth + jump, Limit::from_below);
        const double after = at(tooth + jump, Limit::from_above);
        CHECK(before == Approx(at(tooth + jump - 1e-7, Limit::from_above)).epsilon(1e-6));
        CHECK(after == Approx(at(tooth + jump + 1e-7, Limit::from_above)).epsilon(1e-6));
        CHECK(after < 0.99 * before);
    }
    const double untouched = 0.5 * jump;
    CHECK(one(untouched) == Approx(mesh.tooth_pair(untouched)).epsilon(1e-9));
}

TEST_CASE("pits over the whole face carry no load in contact") {
    const AdditiveMesh mesh(kMesh, kLiangSteel, Profile::root_circle);
    const ToothPitting family(kMesh, kLiangSteel, Profile::root_circle, 1, band_of(0));
    const auto pits = family.at(family.largest_size());
    const ToothPairCurve one = mesh.faulty_pair(*pits);
    CHECK(one(kMesh.pitch_position()) == 0);
    CHECK(one(0.1) == Approx(mesh.tooth_pair(0.1)).epsilon(1e-9));
}

TEST_CASE("pits that do not fit on the flank are reported as such") {
    const auto problems = [](PitBand band, double width) {
        return ToothPitting(kMesh, kLiangSteel, Profile::root_circle, 1, band).problems(width);
    };
    CHECK(problems(band_of(0.5e-3), 10e-3).empty());
    CHECK(problems(band_of(0.5e-3), 40e-3).size() == 1);
    CHECK(problems(band_of(50e-3), 10e-3).size() == 1);
    CHECK(problems(band_of(0.5e-3, 0), 10e-3).size() == 1);
    CHECK(problems(band_of(0.5e-3, 17), 10e-3).size() == 1);
    CHECK(problems({kMesh.gear(1).tip_radius(), 1e-3, 0, 1}, 10e-3).size() == 1);
    CHECK(problems({kMesh.gear(1).pitch_radius(), 0, 0, 1}, 10e-3).size() == 1);
}

}  // namespace gearpod::stiffness::test_pitting
