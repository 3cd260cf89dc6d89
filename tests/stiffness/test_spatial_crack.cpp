#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/numbers.hpp"
#include "tests/stiffness/yang_gears.hpp"

namespace gearpod::stiffness::test_spatial_crack {

using namespace yang_gears;

std::vector<double> positions(double contact_ratio, int count) {
    return test::tabulated(count, [&](int i) { return contact_ratio * (i + 0.5) / count; });
}

std::vector<double> compliance_of(const ToothFault& fault, const std::vector<double>& tau) {
    std::vector<double> c(tau.size());
    fault.beam_compliance(tau, c);
    return c;
}

// Yang's sum over slices of equal width, each by the reference quadrature.
double uniform_slices(const gears::MeshGeometry& mesh, int which, const CrackSurface& surface,
                      double tau, int slices) {
    const ToothProfile profile(mesh.gear(which), Profile::fillet);
    const double angle = mesh.contact_angle(which, tau);
    double bending = 0, shear = 0, axial = 0;
    for (int i = 0; i < slices; ++i) {
        const double z = kSteel.face_width_m * (i + 0.5) / slices;
        const double q1 = surface.depth_m, q2 = surface.end_depth_m, L_c = surface.length_m;
        const double q =
            z < L_c ? std::sqrt((q2 * q2 - q1 * q1) / L_c * z + q1 * q1) : 0.0;  // Eqs. 61-62
        const double x = z / kSteel.face_width_m, rise = surface.end_height_m - surface.height_m;
        const double l = rise * x * x + surface.height_m;
        const double g = surface.angle_rad + (surface.end_angle_rad - surface.angle_rad) * x;
        const auto part = tooth_compliance(profile, kSteel, angle, {q, g, l});
        bending += 1 / part.bending / slices;
        shear += 1 / part.shear / slices;
        axial = tooth_compliance(profile, kSteel, angle).axial;
    }
    return 1 / bending + 1 / shear + axial;
}

CrackGrowth single(double q1, double q2, double L_c, double l1, double l2, double g1, double g2) {
    return {{q1}, {q2}, {L_c}, {l1}, {l2}, g1, g2};
}

TEST_CASE("the crack's surface has the limits of Yang's equations 61 to 66") {
    const double L = 0.018;
    const CrackSurface partial{1e-3, 0, 0.012, 0.5e-3, 2e-3, 0.8, 1.5, L};
    const CrackSurface full{2e-3, 1e-3, L, 0.5e-3, 2e-3, 0.8, 1.5, L};
    CHECK(partial.crack(0).depth_m == 1e-3);
    CHECK(partial.crack(1).depth_m == 0);
    CHECK(partial.z_at(1) == Approx(0.012));
    CHECK(full.crack(0).depth_m == 2e-3);
    CHECK(full.crack(1).depth_m == Approx(1e-3));
    CHECK(full.z_at(1) == Approx(L));
    CHECK(full.crack(1).height_m == Approx(2e-3));
    CHECK(full.crack(0).angle_rad == 0.8);
    CHECK(full.crack(1).angle_rad == Approx(1.5));
    for (const double t : {0.1, 0.4, 0.8}) {
        const double z = partial.z_at(t), step = 1e-6;
        CHECK(partial.crack(t).depth_m == Approx(1e-3 * std::sqrt((0.012 - z) / 0.012)));
        const double y = full.z_at(t);
        CHECK(full.crack(t).depth_m == Approx(std::sqrt((1e-6 - 4e-6) / L * y + 4e-6)));
        CHECK(full.stretching(t) ==
              Approx((full.z_at(t + step) - full.z_at(t - step)) / (2 * step)).epsilon(1e-6));
        CHECK(full.height(y) == Approx(1.5e-3 * y * y / (L * L) + 0.5e-3));
    }
}

TEST_CASE("a crack grows along its stages") {
    const CrackGrowth path = growth();
    const double L = kSteel.face_width_m;
    CHECK(path.at(3, L).depth_m == 1.5e-3);
    CHECK(path.at(3.5, L).depth_m == Approx(1.75e-3));
    CHECK(path.at(3.5, L).end_depth_m == Approx(0.5e-3));
    CHECK(path.at(0.5, L).depth_m == Approx(0.25e-3));
    CHECK(path.at(0.5, L).length_m == 6e-3);
    CHECK(path.at(9, L).end_depth_m == 2e-3);
    CHECK_FALSE(path.at(0, L).cracked());
}

TEST_CASE("a crack of one depth, angle and height equals the plane crack") {
    const auto mesh = sun_planet();
    const auto tau = positions(mesh.contact_ratio(), 60);
    for (const int which : {1, 2})
        for (const double depth : {0.3e-3, 1e-3, 2.2e-3, 4e-3}) {
            // Start at the root: also the curve of the plane crack itself.
            const ToothCrack plane(mesh, kSteel, Profile::fillet, which, 45 * kDegree);
            for (const double height : {0.0, 0.6e-3, 1.9e-3}) {
                const SpatialCrack family(
                    mesh, kSteel, Profile::fillet, which,
                    single(depth, depth, 18e-3, height, height, 45 * kDegree, 45 * kDegree));
                const auto spatial = compliance_of(*family.at(1), tau);
                const ToothProfile profile(mesh.gear(which), Profile::fillet);
                for (std::size_t i = 0; i < tau.size(); ++i) {
                    INFO(which << " " << depth << " " << height << " " << tau[i]);
                    const double expected =
                        tooth_compliance(profile, kSteel, mesh.contact_angle(which, tau[i]),
                                         {depth, 45 * kDegree, height})
                            .total();
                    if (expected < 1e-8)
                        CHECK(spatial[i] == Approx(expected).epsilon(1e-9));
                    else  // less than a tenth of the tooth's stiffness remains
                        CHECK(1 / spatial[i] == Approx(1 / expected).margin(1));
                }
                if (height == 0) {
                    const auto same = compliance_of(*plane.at(depth), tau);
                    for (std::size_t i = 0; i < tau.size(); ++i)
                        if (same[i] < 1e-8)
                            CHECK(spatial[i] == Approx(same[i]).epsilon(1e-9));
                }
            }
        }
}

TEST_CASE("a crack of zero depth leaves the healthy tooth") {
    const auto mesh = sun_planet();
    const SpatialCrack family(mesh, kSteel, Profile::fillet, 1,
                              single(0, 0, 18e-3, 0.5e-3, 2e-3, 0.8, 1.5));
    const auto fault = family.at(1);
    CHECK_FALSE(fault->changes_sections());
    const CoupledMesh coupled(mesh, kSteel, Profile::fillet,
                              options(FoundationModel::elastic_ring, Contact::load_dependent));
    const auto faulty = coupled.with_fault(*fault);
    for (const double tau : positions(mesh.contact_ratio(), 30))
        CHECK(total_at(*faulty, coupled.transitions(), tau) ==
              Approx(total_at(coupled, tau)).epsilon(2e-9));
    // A very shallow crack converges to it.
    const ToothProfile profile(mesh.gear(1), Profile::fillet);
    const SpatialCrack shallow(mesh, kSteel, Profile::fillet, 1,
                               single(1e-8, 0, 18e-3, 0.5e-3, 0.5e-3, 0.8, 1.5));
    const auto tau = positions(mesh.contact_ratio(), 20);
    const auto c = compliance_of(*shallow.at(1), tau);
    for (std::size_t i = 0; i < tau.size(); ++i)
        CHECK(c[i] ==
              Approx(tooth_compliance(profile, kSteel, mesh.contact_angle(1, tau[i])).total())
                  .epsilon(1e-4));
}

TEST_CASE("slices converge to Yang's sum over very many slices of equal width") {
    const auto mesh = sun_planet();
    const auto tau = positions(mesh.contact_ratio(), 5);
    CrackGrowth path = growth();
    for (const int stage : {2, 5}) {
        const auto expected = test::mapped(tau, [&](double at) {
            return uniform_slices(mesh, 1, path.at(stage, kSteel.face_width_m), at, 400);
        });
        for (const int slices : {16, 64}) {
            path.slices = slices;
            const SpatialCrack family(mesh, kSteel, Profile::fillet, 1, path);
            const auto c = compliance_of(*family.at(stage), tau);
            INFO("stage " << stage << ", slices " << slices);
            for (std::size_t i = 0; i < tau.size(); ++i)
                CHECK(c[i] == Approx(expected[i]).epsilon(slices == 16 ? 2e-3 : 5e-4));
        }
    }
}

TEST_CASE("slices outside the contact are left out exactly where it passes them") {
    const SliceRule rule(16);
    std::vector<double> weights(rule.points().size());
    const auto integrate = [&](double power) {
        double sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i)
            sum += weights[i] * std::pow(rule.points()[i], power);
        return sum;
    };
    rule.whole(weights);
    CHECK(integrate(5) == Approx(1.0 / 6).epsilon(1e-13));
    rule.where([](double t) { return (t - 0.21) * (0.7 - t); }, 64, weights);
    CHECK(integrate(0) == Approx(0.49).epsilon(1e-12));
    CHECK(integrate(5) == Approx((std::pow(0.7, 6) - std::pow(0.21, 6)) / 6).epsilon(1e-12));
    rule.where([](double) { return -1; }, 64, weights);
    CHECK(integrate(0) == 0);
}

TEST_CASE(
    "the mesh stiffness lost to Yang's cases increases from 1 to 5, and 1 and 2 lose little") {
    const auto mesh = sun_planet();
    struct Model {
        FoundationModel foundation;
        Contact contact;
        double mean_loss[5];  // measured values of this test
    };
    const Model models[] = {
        {FoundationModel::none, Contact::linear, {0.0056, 0.0306, 0.0747, 0.1321, 0.1995}},
        {FoundationModel::sainsot,
         Contact::load_dependent,
         {0.0020, 0.0115, 0.0311, 0.0612, 0.1031}},
        {FoundationModel::elastic_ring,
         Contact::load_dependent,
         {0.0017, 0.0096, 0.0259, 0.0508, 0.0853}}};
    for (const auto& [foundation, contact, expected] : models) {
        const CoupledMesh healthy(mesh, kSteel, Profile::fillet, options(foundation, contact));
        const SpatialCrack family(mesh, kSteel, Profile::fillet, 1, growth(), healthy.body(1));
        double last = 0;
        for (int stage = 1; stage <= 5; ++stage) {
            const auto crack = family.at(stage);
            const auto faulty = healthy.with_fault(*crack);
            double loss = 0;
            const auto tau = positions(mesh.contact_ratio(), 200);
            for (const double at : tau)
                loss += (1 - total_at(*faulty, healthy.transitions(), at) / total_at(healthy, at)) /
                        static_cast<double>(tau.size());
            CHECK(loss > 1.5 * last);
            CHECK(loss == Approx(expected[stage - 1]).margin(1e-4));
            if (foundation != FoundationModel::none && stage <= 2)
                CHECK(loss < 0.012);  // "very limited"
            last = loss;
        }
    }
}

TEST_CASE("the crack's part below the root softens the foundation, the part above does not") {
    const auto mesh = sun_planet();
    const CoupledMesh healthy(mesh, kSteel, Profile::fillet,
                              options(FoundationModel::sainsot, Contact::linear));
    const std::vector<double> tau{0.9};
    const auto extra = [&](double depth, double height, double angle) {
        const auto path = single(depth, depth, 18e-3, height, height, angle, angle);
        const SpatialCrack with(mesh, kSteel, Profile::fillet, 1, path, healthy.body(1)),
            without(mesh, kSteel, Profile::fillet, 1, path);
        return compliance_of(*with.at(1), tau)[0] - compliance_of(*without.at(1), tau)[0];
    };
    CHECK(extra(1e-3, 1.5e-3, 45 * kDegree) == Approx(0).margin(1e-20));
    CHECK(extra(1e-3, 0, 45 * kDegree) > 0);
    // Sainsot's formula with the root narrowed by q sin g.
    const ToothProfile profile(mesh.gear(1), Profile::fillet);
    const double left = 1 - 1e-3 * std::sin(45 * kDegree) / (2 * profile.root_half_thickness());
    const auto whole = healthy.body(1)->self(mesh.contact_angle(1, 0.9));
    CHECK(extra(1e-3, 0, 45 * kDegree) ==
          Approx(whole.squared * (1 / (left * left) - 1) + whole.linear * (1 / left - 1))
              .epsilon(1e-8));
}

TEST_CASE("an invalid crack is refused with all reasons") {
    CrackGrowth path = growth();
    path.length_m[1] = 19e-3;
    path.end_depth_m.pop_back();
    path.end_angle_rad = 2;
    CHECK(growth_problems(path, kSteel.face_width_m).size() == 3);
    CHECK_THROWS_AS(SpatialCrack(sun_planet(), kSteel, Profile::fillet, 1, path),
                    std::invalid_argument);
    CHECK_THROWS_AS(SpatialCrack(sun_planet(), kSteel, Profile::fillet, 3, growth()),
                    std::invalid_argument);
}

}  // namespace gearpod::stiffness::test_spatial_crack
