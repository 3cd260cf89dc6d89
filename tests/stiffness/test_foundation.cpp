#include "stiffness/foundation/elastic_ring.hpp"
#include "stiffness/foundation/foundation_models.hpp"
#include "tests/stiffness/yang_gears.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_foundation {

using namespace yang_gears;

TEST_CASE(
    "an annulus under uniform pressure and uniform shear matches Lame's and the torsion solution") {
    const double nu = 0.3, E = 1;
    for (const double held : {0.2, 0.7, 1.3, 4.0}) {
        const HarmonicCompliance mean = Annulus(held, nu).harmonic(0);
        // Lame's solution in plane strain: u = (1 + nu) / E [(1 - 2 nu) A r - B / r], sigma = A + B
        // / r^2, with u = 0 on the fixed circle and the traction 1 on the other.
        const double square = held * held;
        const double A = 1 / (1 + (1 - 2 * nu) * square);
        const double u = (1 + nu) / E * (1 - 2 * nu) * A * (1 - square);
        CHECK(mean.rr == Approx(held < 1 ? u : -u).epsilon(1e-12));
        // Torsion: tau = t / r^2 rotates each ring by (t / 2 G) (1 / held^2 - 1) relative to the
        // fixed one.
        const double twist = (1 + nu) / E * std::abs(1 / square - 1);
        CHECK(mean.tt == Approx(twist).epsilon(1e-12));
    }
}

TEST_CASE("a thin annulus fixed on one face deflects like a layer under pressure and shear") {
    // Layer of thickness t, load waves much longer than t: u = p t / (lambda + 2 G), v = q t / G.
    const double nu = 0.3, t = 1e-3, G = 1 / 2.6, stiff = 2 * G * (1 - nu) / (1 - 2 * nu);
    for (const double held : {1 - t, 1 + t})
        for (const int n : {1, 2, 5}) {
            const HarmonicCompliance c = Annulus(held, nu).harmonic(n);
            CHECK(c.rr == Approx(t / stiff).epsilon(0.01));
            CHECK(c.tt == Approx(t / G).epsilon(0.01));
        }
}

TEST_CASE("short waves do not reach the fixed circle; their deflection is that of a half-plane") {
    // Half-plane under p cos kx: u = 2 (1 - nu^2) / (E k) p, and tangentially (1 - 2 nu) (1 + nu) /
    // (E k) p (plane strain).
    const double nu = 0.3;
    for (const double held : {0.5, 2.0}) {
        const HarmonicCompliance c = Annulus(held, nu).harmonic(400);
        CHECK(c.rr == Approx(2 * (1 - nu * nu) / 400).epsilon(0.005));
        CHECK(c.tt == Approx(2 * (1 - nu * nu) / 400).epsilon(0.005));
        CHECK(std::abs(c.rt) == Approx((1 - 2 * nu) * (1 + nu) / 400).epsilon(0.02));
    }
    // The two formulas agree where the code changes from one to the other.
    for (const double held : {0.3, 0.9, 1.5}) {
        const Annulus body(held, nu);
        for (int n = 2; n < 400; ++n) {
            const double step = body.harmonic(n + 1).rr * (n + 1) / (body.harmonic(n).rr * n);
            REQUIRE(step == Approx(1).margin(1.5 / n));
        }
    }
}

TEST_CASE("the elastic ring's own compliance agrees with Sainsot's formula in his range") {
    // Contacts from the middle of the flank to the tip. The difference is within 10 % where the
    // bore is at half the root radius or less, within 16 % where it is larger.
    double worst = 0, worst_thin = 0, sum = 0;
    int count = 0;
    for (const int teeth : {28, 34, 60})
        for (const double radii : {1.4, 2.0, 3.0, 4.0, 5.0})
            for (const double angle : {0.1, 0.2, 0.35, 0.5}) {
                const ToothProfile tooth(gear(teeth), Profile::fillet);
                const double bore = tooth.root_radius() / radii;
                REQUIRE(foundation_warnings(gear(teeth), Profile::fillet, FoundationModel::sainsot,
                                            bore)
                            .empty());
                const double ratio =
                    ElasticRing(tooth, teeth, kSteel, bore).self(angle).total() /
                        SainsotFoundation(tooth, kSteel, bore).self(angle).total() -
                    1;
                (radii < 2 ? worst_thin : worst) =
                    std::max(radii < 2 ? worst_thin : worst, std::abs(ratio));
                sum += std::abs(ratio);
                ++count;
            }
    INFO("largest " << worst << ", near bores " << worst_thin << ", mean " << sum / count);
    CHECK(worst < 0.10);
    CHECK(worst_thin < 0.17);
    CHECK(sum / count < 0.06);
}

TEST_CASE("without a lever arm, both foundations have the same compliance to 2 %") {
    // The ring's shear stress there is Sainsot's, which does not balance the moment elsewhere.
    const ToothProfile tooth(gear(60), Profile::fillet);
    REQUIRE(tooth.base_radius() < tooth.root_radius());
    const double angle = std::acos(tooth.base_radius() / tooth.root_radius());
    for (const double radii : {2.5, 3.0, 5.0}) {
        const double bore = tooth.root_radius() / radii;
        CHECK(ElasticRing(tooth, 60, kSteel, bore).self(angle).total() ==
              Approx(SainsotFoundation(tooth, kSteel, bore).self(angle).total()).epsilon(0.02));
    }
}

TEST_CASE("the ring's compliances match an independent script with ten times the harmonics") {
    // Source: numpy, 40,000 harmonics from the four fields without closed tails, sums by running
    // means, the neighbour's work by direct integration over its arc; in units of 1 / E L.
    const ToothProfile sun(gear(28), Profile::fillet);
    const ElasticRing ring(sun, 28, kSteel, kSunBore);
    const double unit = kSteel.youngs_modulus_Pa * kSteel.face_width_m;
    CHECK(unit * ring.self(0.1).total() == Approx(3.910109).epsilon(2e-6));
    CHECK(unit * ring.self(0.35).total() == Approx(5.434573).epsilon(2e-6));
    CHECK(unit * ring.coupling(0.1, 0.35, 1) == Approx(2.376969).epsilon(1e-6));
}

TEST_CASE("coupling through the body is mutual and fades with the distance") {
    const ToothProfile sun(gear(28), Profile::fillet), rim(gear(96, true), Profile::fillet);
    const ElasticRing solid(sun, 28, kSteel, 5e-3), thin(sun, 28, kSteel, 20e-3),
        ring(rim, 96, kSteel, kRingOuter);
    for (const ElasticRing* body : {&solid, &thin, &ring})
        for (const double i : {0.05, 0.2, 0.4})
            for (const double j : {0.1, 0.35}) {
                for (const int apart : {1, 2, 3})
                    CHECK(body->coupling(i, j, apart) ==
                          Approx(body->coupling(j, i, -apart)).epsilon(1e-12));
                CHECK(std::abs(body->coupling(i, j, 1)) < body->self(i).total());
                CHECK(std::abs(body->coupling(i, j, 4)) < 0.75 * body->self(i).total());
                if (body != &solid)
                    continue;
                CHECK(body->coupling(i, j, 1) > body->coupling(i, j, 2));
                CHECK(body->coupling(i, j, 2) > body->coupling(i, j, 3));
            }
    // A thinner ring transmits less.
    CHECK(thin.coupling(0.2, 0.2, 2) / thin.self(0.2).total() <
          0.5 * solid.coupling(0.2, 0.2, 2) / solid.self(0.2).total());
}

TEST_CASE("a foundation out of range is reported, an impossible one is refused") {
    const auto warnings = foundation_warnings(gear(28), Profile::fillet, FoundationModel::sainsot,
                                              gear(28).root_radius() / 1.2);
    REQUIRE(warnings.size() == 1);
    CHECK(test::contains(warnings[0], "1.2"));
    CHECK(foundation_warnings(gear(12), Profile::fillet, FoundationModel::sainsot, 3e-3).size() ==
          1);
    CHECK(foundation_warnings(gear(28), Profile::fillet, FoundationModel::elastic_ring, 24e-3)
              .empty());
    CHECK_THROWS_AS(
        make_foundation(gear(28), kSteel, Profile::fillet, FoundationModel::sainsot, 30e-3),
        std::invalid_argument);
    CHECK_THROWS_AS(make_foundation(gear(96, true), kSteel, Profile::fillet,
                                    FoundationModel::elastic_ring, 90e-3),
                    std::invalid_argument);
    CHECK(make_foundation(gear(96, true), kSteel, Profile::fillet, FoundationModel::sainsot,
                          kRingOuter) == nullptr);
}

}  // namespace gearpod::stiffness::test_foundation
