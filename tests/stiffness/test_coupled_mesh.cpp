#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/crack.hpp"
#include "tests/stiffness/yang_gears.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_coupled_mesh {

using namespace yang_gears;

double share_at(const MeshStiffness& mesh, double tau) {
    double share = 0;
    mesh.share({&tau, 1}, tau, {&share, 1});
    return share;
}

// A tall pair of many teeth, with up to three pairs in contact.
gears::MeshGeometry tall() {
    const auto gear = [](int teeth) {
        return gears::Gear{teeth, false, 2e-3, 20 * kDegree, 1.4, 1.65};
    };
    return {gear(60), gear(70)};
}

CoupledMeshOptions tall_options(FoundationModel foundation, Contact contact) {
    return {foundation, contact, 20e-3, 20e-3, force()};
}

TEST_CASE("without foundation and with linear contacts the tooth pairs are springs in parallel") {
    for (const Profile profile : {Profile::base_circle, Profile::root_circle, Profile::fillet})
        for (const auto& geometry : {sun_planet(), ring_planet(), tall()}) {
            const CoupledMesh mesh(geometry, kSteel, profile, {});
            const AdditiveMesh springs(geometry, kSteel, profile);
            REQUIRE(mesh.transitions() == springs.transitions());
            for (double tau = 0.013; tau < geometry.contact_ratio(); tau += 0.071) {
                CHECK(total_at(mesh, tau) == Approx(total_at(springs, tau)).epsilon(1e-10));
                CHECK(share_at(mesh, tau) == Approx(share_at(springs, tau)).epsilon(1e-9));
            }
        }
}

TEST_CASE("faulty pairs also agree with springs in parallel") {
    const auto geometry = sun_planet();
    const CoupledMesh mesh(geometry, kSteel, Profile::fillet, {});
    const AdditiveMesh springs(geometry, kSteel, Profile::fillet);
    for (const int which : {1, 2}) {
        const ToothCrack family(geometry, kSteel, Profile::fillet, which, 45 * kDegree);
        for (const double share : {0.2, 0.6, 0.9}) {
            const auto crack = family.at(share * family.largest_size());
            const auto coupled = mesh.with_fault(*crack), alone = springs.with_fault(*crack);
            REQUIRE(coupled->duration() == alone->duration());
            for (double tau = 0.007; tau < coupled->duration(); tau += 0.043)
                CHECK(total_at(*coupled, mesh.transitions(), tau) ==
                      Approx(total_at(*alone, mesh.transitions(), tau))
                          .epsilon(3e-9)
                          .margin(3e-9 * total_at(mesh, tau)));
        }
    }
}

TEST_CASE("one pair and two pairs have Yang's stiffnesses 20 to 24") {
    for (const Contact contact : {Contact::linear, Contact::load_dependent})
        for (const FoundationModel model :
             {FoundationModel::sainsot, FoundationModel::elastic_ring}) {
            const CoupledMesh mesh(sun_planet(), kSteel, Profile::fillet, options(model, contact));
            const auto hertz = [&](double force_N) {  // Eq. 19
                return contact == Contact::linear ? hertz_stiffness(kSteel)
                                                  : std::pow(2.06e11, 0.9) * std::pow(0.018, 0.8) *
                                                        std::pow(force_N, 0.1) / 1.37;
            };
            const double c = mesh.contact_ratio();
            for (const double tau : {c - 0.9, 0.8, 0.95}) {  // Eq. 23
                const double single =
                    1 / (1 / hertz(force()) + mesh.beam(1, tau) + mesh.beam(2, tau) +
                         mesh.foundation(1, tau) + mesh.foundation(2, tau));
                CHECK(total_at(mesh, tau) == Approx(single).epsilon(1e-10));
                CHECK(share_at(mesh, tau) == Approx(1).epsilon(1e-12));
            }
            for (const double tau : {0.05, 0.3, 0.6}) {  // Eqs. 21, 22, 24
                const double F_i = force() * share_at(mesh, tau),
                             F_j = force() * share_at(mesh, tau + 1);
                CHECK(F_i + F_j == Approx(force()).epsilon(1e-12));
                const auto pair = [&](double own, double other, double F_own, double F_other) {
                    const double foundation = mesh.foundation(1, own) + mesh.foundation(2, own) +
                                              mesh.coupling(other, own) * F_other / F_own;
                    return 1 /
                           (1 / hertz(F_own) + mesh.beam(1, own) + mesh.beam(2, own) + foundation);
                };
                CHECK(total_at(mesh, tau) ==
                      Approx(pair(tau, tau + 1, F_i, F_j) + pair(tau + 1, tau, F_j, F_i))
                          .epsilon(1e-10));
            }
        }
}

TEST_CASE("shares add up to one, also with three pairs in contact") {
    const auto geometry = tall();
    REQUIRE(geometry.contact_ratio() > 2.1);
    for (const FoundationModel model : {FoundationModel::none, FoundationModel::elastic_ring}) {
        const CoupledMesh mesh(geometry, kSteel, Profile::fillet,
                               tall_options(model, Contact::load_dependent));
        for (double phase = 0.011; phase < 1; phase += 0.037) {
            double sum = 0;
            for (double tau = phase; tau < geometry.contact_ratio(); tau += 1) {
                CHECK(share_at(mesh, tau) > 0);
                sum += share_at(mesh, tau);
            }
            CHECK(sum == Approx(1).epsilon(1e-11));
        }
        CHECK(share_at(mesh, geometry.contact_ratio() + 0.01) == 0);
    }
}

TEST_CASE("twice the load makes the contact 2^0.1 times as stiff and the mesh stiffer") {
    const HertzContact contact(kSteel, Contact::load_dependent);
    CHECK(contact.compliance(500) / contact.compliance(1000) ==
          Approx(std::pow(2, 0.1)).epsilon(1e-14));
    CHECK(contact.compliance(500, 0.5) / contact.compliance(500) ==
          Approx(std::pow(2, 0.8)).epsilon(1e-14));
    auto at = options(FoundationModel::sainsot, Contact::load_dependent);
    const CoupledMesh light(sun_planet(), kSteel, Profile::fillet, at);
    at.force_N *= 2;
    const CoupledMesh heavy(sun_planet(), kSteel, Profile::fillet, at);
    for (double phase = 0.02; phase < 1; phase += 0.1)
        CHECK(total_at(heavy, phase) > total_at(light, phase));
    const double tau = 0.8, hertz = contact.compliance(force());
    CHECK(1 / total_at(heavy, tau) - 1 / total_at(light, tau) ==
          Approx(hertz * (std::pow(2, -0.1) - 1)).epsilon(1e-9));
}

TEST_CASE("the bodies soften the mesh, and coupled teeth more than single teeth") {
    const auto with = [&](FoundationModel model) {
        return mean_total(CoupledMesh(sun_planet(), kSteel, Profile::fillet,
                                      options(model, Contact::load_dependent)));
    };
    CHECK(with(FoundationModel::sainsot) < with(FoundationModel::none));
    CHECK(with(FoundationModel::elastic_ring) < with(FoundationModel::sainsot));
}

TEST_CASE("a tooth without load leaves the load to the others") {
    const auto geometry = tall();
    const CoupledMesh mesh(geometry, kSteel, Profile::fillet,
                           tall_options(FoundationModel::elastic_ring, Contact::load_dependent));
    const CoupledMesh yang(sun_planet(), kSteel, Profile::fillet,
                           options(FoundationModel::elastic_ring, Contact::load_dependent));
    const auto broken = BrokenTooth().at(1);
    const auto gap = yang.with_fault(*broken);
    CHECK(total_at(*gap, yang.transitions(), 0.8) == 0);  // the only pair in contact
    // Stiffness of the other pair alone.
    const double tau = 0.3;
    const HertzContact contact(kSteel, Contact::load_dependent);
    const double alone =
        1 / (contact.compliance(force()) + yang.beam(1, tau + 1) + yang.beam(2, tau + 1) +
             yang.foundation(1, tau + 1) + yang.foundation(2, tau + 1));
    CHECK(total_at(*gap, yang.transitions(), tau) == Approx(alone).epsilon(1e-8));
    const auto tall_gap = mesh.with_fault(*broken);
    for (double at = 0.03; at < tall_gap->duration(); at += 0.1) {
        CHECK(total_at(*tall_gap, mesh.transitions(), at) > 0);
        CHECK(total_at(*tall_gap, mesh.transitions(), at) < total_at(mesh, at));
    }
}

TEST_CASE("load-dependent contacts require a load") {
    CHECK_THROWS_AS(CoupledMesh(sun_planet(), kSteel, Profile::fillet,
                                {FoundationModel::none, Contact::load_dependent}),
                    std::invalid_argument);
}

TEST_CASE("Coupled tooth pairs with a fault: a broken one carries no load, the others all of it") {
    const auto geometry = sun_planet();
    const CoupledMesh mesh(geometry, kSteel, Profile::fillet,
                           options(FoundationModel::elastic_ring, Contact::linear));
    const auto broken = BrokenTooth().at(1);
    const auto faulty = mesh.with_fault(*broken);
    const auto transitions = mesh.transitions();
    for (const double tau : {0.2, 0.4, 1.3, 1.5}) {
        double own = -1, other = -1;
        const int neighbour = tau < 1 ? -1 : 1;
        faulty->tooth_pair(0, {&tau, 1}, tau, {&own, 1});
        faulty->tooth_pair(neighbour, {&tau, 1}, tau, {&other, 1});
        CHECK(own == Approx(0.0).margin(1.0));
        CHECK(other == Approx(total_at(*faulty, transitions, tau)).epsilon(1e-8));
        // A single pair is stiffer than one whose neighbour also loads the bodies.
        const double healthy = total_at(mesh, tau) * share_at(mesh, tau - neighbour);
        CHECK(other > 1.01 * healthy);
    }
}

}  // namespace gearpod::stiffness::test_coupled_mesh
