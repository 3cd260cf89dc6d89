#include "stiffness/additive_mesh.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_additive_mesh {

using namespace test_pairs;

// Change of the mesh stiffness from base circle to root circle, averaged over [from, to] of a mesh
// period.
double root_circle_change(const gears::MeshGeometry& mesh, double from, double to) {
    const AdditiveMesh root(mesh, kLiangSteel, Profile::root_circle);
    const AdditiveMesh base(mesh, kLiangSteel, Profile::base_circle);
    double sum_root = 0, sum_base = 0;
    constexpr int kSamples = 2000;
    for (int i = 0; i < kSamples; ++i) {
        const double phase = from + (to - from) * (i + 0.5) / kSamples;
        sum_root += total_at(root, phase);
        sum_base += total_at(base, phase);
    }
    return sum_root / sum_base - 1;
}

TEST_CASE("Tian's mean mesh stiffness is 8.854e8 N/m and its damping coefficient 3.99e-6 s") {
    const AdditiveMesh pair(gears::MeshGeometry(external(19), external(48)), kTianSteel,
                            Profile::base_circle);
    CHECK(mean_total(pair) == Approx(8.854e8).epsilon(0.002));
    // Source: Tian (2004), below Eq. 4.25, mu = c_m / k_m with c_m = 3.533e3 Ns/m.
    CHECK(3.533e3 / mean_total(pair) == Approx(3.99e-6).epsilon(0.002));
}

TEST_CASE("the mean is the mesh stiffness averaged over a period") {
    const AdditiveMesh pair(gears::MeshGeometry(external(31), internal(81)), kLiangSteel,
                            Profile::root_circle);
    // Simpson's rule on each side of the transition, with one-sided limits at the jumps.
    double sum = 0;
    const double cut = pair.transitions().at(1);
    const std::pair<double, double> stretches[] = {{0, cut}, {cut, 1}};
    for (const auto& [from, to] : stretches) {
        constexpr int kPanels = 200;
        const double h = (to - from) / kPanels;
        for (int i = 0; i < kPanels; ++i)
            sum += h / 6 *
                   (total_at(pair, from + i * h, Limit::from_above) +
                    4 * total_at(pair, from + (i + 0.5) * h) +
                    total_at(pair, from + (i + 1) * h, Limit::from_below));
    }
    CHECK(sum == Approx(mean_total(pair)).epsilon(1e-9));
}

TEST_CASE("starting teeth at the root circle reduces Liang's sun-planet mesh stiffness by 40 %") {
    const gears::MeshGeometry mesh(external(19), external(31));
    const double c = mesh.contact_ratio();
    // Source: Liang (2016), section 3.2.3, about 40 %; an independent quadrature gives -40.3 % on
    // average.
    CHECK(root_circle_change(mesh, 0, 1) == Approx(-0.403).margin(0.0005));
    CHECK(root_circle_change(mesh, 0, c - 1) == Approx(-0.4006).margin(0.0005));
    CHECK(root_circle_change(mesh, c - 1, 1) == Approx(-0.4098).margin(0.0005));
}

TEST_CASE(
    "starting the planet's teeth at the root circle reduces the ring-planet mesh stiffness by 13.7 "
    "and 13.4 %") {
    // Liang (2016), section 3.3, states about -17 % with two pairs and -23 % with one. His printed
    // formulas do not give this at any phase: -11.3 to -15.2 % with two pairs, -13.2 to -13.7 %
    // with one. Module and rounding have no influence (stiffness per face width is independent of
    // scale; radii 45.2 / 46.2 give -13.71 %).
    // An independent script tried some 6,000 combinations, double / single: dedendum 1.375 m
    // -18.9 / -18.8 %, 1.5 m -24.0 / -24.2 %; no shear -15.6 / -14.2 %. Others were shear or
    // bending of the straight part doubled or fourfold, a rigid ring, inv a0 with the wrong sign in
    // beta_2, wrong direction or rate of the ring's rotation, and contact on the planet starting at
    // the tip. Any change of the planet's tooth lowers both zones equally, so none comes near a
    // difference of 6 points without two or three gross errors at once. One pair is in contact
    // during 6 % of the period only (contact ratio 1.94), a narrow notch in his Fig. 3.6, from
    // which the two numbers were presumably read. No single error explains them; the row keeps the
    // result of the formulas. Finite-element teeth with the same simplifications drop by 16.4
    // and 16.6 % (test_finite_element_gears.cpp).
    const gears::MeshGeometry mesh(external(31), internal(81));
    const double c = mesh.contact_ratio();
    CHECK(root_circle_change(mesh, 0, c - 1) == Approx(-0.1371).margin(0.0005));
    CHECK(root_circle_change(mesh, c - 1, 1) == Approx(-0.1344).margin(0.0005));
}

TEST_CASE("a tooth pair is a Hertz contact and two beams in series") {
    for (const auto& gear : cracked_gears()) {
        const AdditiveMesh pair(gear.geometry, kLiangSteel, gear.profile);
        const ToothProfile first(gear.geometry.gear(1), gear.profile);
        const ToothProfile second(gear.geometry.gear(2), gear.profile);
        for (int i = 0; i <= 50; ++i) {
            const double tau = pair.contact_ratio() * i / 50;
            const double compliance =
                4 * (1 - 0.3 * 0.3) / (std::numbers::pi * 2.068e11 * 0.0381) +
                tooth_compliance(first, kLiangSteel, gear.geometry.contact_angle(1, tau)).total() +
                tooth_compliance(second, kLiangSteel, gear.geometry.contact_angle(2, tau)).total();
            CHECK(pair.tooth_pair(tau) == Approx(1 / compliance).epsilon(1e-11));
        }
    }
}

TEST_CASE("two pairs are in contact until the contact ratio's fraction, then one") {
    const AdditiveMesh pair(gears::MeshGeometry(external(19), external(31)), kLiangSteel,
                            Profile::root_circle);
    const double c = pair.contact_ratio();
    REQUIRE(pair.transitions().size() == 2);
    CHECK(pair.transitions()[0] == 0);
    CHECK(pair.transitions()[1] == Approx(c - 1));
    CHECK(pair.tooth_pair(-1e-6) == 0);
    CHECK(pair.tooth_pair(c + 1e-6) == 0);
    CHECK(total_at(pair, 0.3) == pair.tooth_pair(0.3) + pair.tooth_pair(1.3));
    CHECK(total_at(pair, 0.8) == pair.tooth_pair(0.8));
    CHECK(total_at(pair, 0, Limit::from_below) == pair.tooth_pair(1));
    CHECK(total_at(pair, 0, Limit::from_above) == pair.tooth_pair(0) + pair.tooth_pair(1));
    const double cut = pair.transitions()[1];
    CHECK(total_at(pair, cut, Limit::from_below) ==
          Approx(pair.tooth_pair(cut) + pair.tooth_pair(c)));
    CHECK(total_at(pair, cut, Limit::from_above) == pair.tooth_pair(cut));
    // Limits at large and at negative phases.
    CHECK(total_at(pair, 2511 + cut, Limit::from_below) ==
          Approx(total_at(pair, cut - 1e-7)).epsilon(1e-6));
    CHECK(total_at(pair, -3, Limit::from_above) == total_at(pair, 0, Limit::from_above));
}

TEST_CASE("each pair carries the load in proportion to its stiffness") {
    const AdditiveMesh mesh(gears::MeshGeometry(external(19), external(31)), kLiangSteel,
                            Profile::root_circle);
    const double tau[] = {0.1, 0.2, 0.3}, later[] = {1.1, 1.2, 1.3};
    double first[3], second[3];
    mesh.share(tau, 0.2, first);
    mesh.share(later, 1.2, second);
    for (int i = 0; i < 3; ++i) {
        CHECK(first[i] + second[i] == Approx(1).epsilon(1e-14));
        CHECK(first[i] / second[i] ==
              Approx(mesh.tooth_pair(tau[i]) / mesh.tooth_pair(later[i])).epsilon(1e-14));
    }
    const double alone[] = {0.9};
    mesh.share(alone, 0.9, {first, 1});
    CHECK(first[0] == 1);
    const double gone[] = {1.9};
    mesh.share(gone, 1.9, {first, 1});
    CHECK(first[0] == 0);
}

}  // namespace gearpod::stiffness::test_additive_mesh
