// Checks faults of the tooth pair and of the mesh, on independent tooth pairs and on a square wave.
#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_faulty_mesh {

using namespace test_pairs;

double faulty_at(const MeshStiffness& mesh, const ToothFault& fault, double tau) {
    return total_at(*mesh.with_fault(fault), mesh.transitions(), tau);
}

// Source: Park et al. (2016), section V-A, sun-planet mesh. The contact ratio is not given there.
const SquareWaveMesh kPark(2.7e9, 4.2e9, 1.6);

TEST_CASE("a broken tooth leaves its neighbour in the double-pair zone, and nothing elsewhere") {
    const gears::MeshGeometry tian(external(19), external(48));
    const AdditiveMesh mesh(tian, kTianSteel, Profile::base_circle);
    const auto broken = BrokenTooth().at(1);
    const auto faulty = mesh.with_fault(*broken);
    const double c = mesh.contact_ratio();
    CHECK(faulty->duration() == c);
    for (int i = 1; i < 100; ++i) {
        const double tau = c * i / 100;
        const double expected = tau < c - 1 ? mesh.tooth_pair(tau + 1)
                                : tau > 1   ? mesh.tooth_pair(tau - 1)
                                            : 0.0;
        CHECK(faulty_at(mesh, *broken, tau) == expected);
    }
}

TEST_CASE("a tooth that keeps a part of its pair's stiffness contributes that part") {
    const gears::MeshGeometry geometry(external(31), internal(81));
    const AdditiveMesh mesh(geometry, kLiangSteel, Profile::root_circle);
    const auto weak = BrokenTooth().at(0.3);
    for (const double tau : {0.2, 0.97, 1.5})
        CHECK(faulty_at(mesh, *weak, tau) ==
              Approx(total_at(mesh, tau) - 0.3 * mesh.tooth_pair(tau)).epsilon(1e-9));
}

TEST_CASE("a reduction removes its part of the whole mesh during its tooth's engagement") {
    const gears::MeshGeometry geometry(external(19), external(31));
    const AdditiveMesh mesh(geometry, kLiangSteel, Profile::root_circle);
    const auto reduced = Reduction().at(0.2);
    for (const double tau : {0.2, 0.8, 1.5})
        CHECK(faulty_at(mesh, *reduced, tau) == Approx(0.8 * total_at(mesh, tau)).epsilon(1e-9));
    CHECK(faulty_at(kPark, *reduced, 0.3) == Approx(0.8 * 4.2e9));
    CHECK(faulty_at(kPark, *reduced, 0.8) == Approx(0.8 * 2.7e9));
    CHECK(faulty_at(kPark, *reduced, 1.3) == Approx(0.8 * 4.2e9));
    CHECK(kPark.with_fault(*reduced)->duration() == 1.6);
}

TEST_CASE("a square wave is high with two pairs in contact and low with one") {
    CHECK(total_at(kPark, 0.3) == 4.2e9);
    CHECK(total_at(kPark, 0.7) == 2.7e9);
    CHECK(total_at(kPark, -0.3) == 2.7e9);
    CHECK(total_at(kPark, 17.0) == 4.2e9);
    CHECK(total_at(kPark, 17.0, Limit::from_below) == 2.7e9);
    CHECK(total_at(kPark, 0.6, Limit::from_below) == 4.2e9);
    CHECK(mean_total(kPark) == Approx(2.7e9 + 0.6 * 1.5e9).epsilon(1e-13));
    CHECK(kPark.transitions() == std::vector<double>{0, kPark.contact_ratio() - 1});
    CHECK(kPark.pitch_position() == 0.8);
    CHECK(SquareWaveMesh(2.7e9, 4.2e9, 1.6, 0.9).pitch_position() == 0.9);
    const double tau[] = {0.3, 0.7, 1.7};
    double share = 0;
    kPark.share({tau, 1}, 0.3, {&share, 1});
    CHECK(share == 0.5);
    kPark.share({tau + 1, 1}, 0.7, {&share, 1});
    CHECK(share == 1);
    kPark.share({tau + 2, 1}, 1.7, {&share, 1});
    CHECK(share == 0);
}

TEST_CASE("a broken tooth removes its pair's contribution from a square wave") {
    const auto broken = BrokenTooth().at(1), weak = BrokenTooth().at(0.5);
    CHECK(faulty_at(kPark, *broken, 0.3) == 2.7e9);
    CHECK(faulty_at(kPark, *broken, 0.8) == 0);
    CHECK(faulty_at(kPark, *broken, 1.3) == 2.7e9);
    CHECK(faulty_at(kPark, *weak, 0.3) == Approx(3.45e9));
    CHECK(faulty_at(kPark, *weak, 0.8) == Approx(1.35e9));
}

TEST_CASE("a constant mesh never changes, and its one transition is between two teeth") {
    const SquareWaveMesh lumped = SquareWaveMesh::constant(5e8);
    CHECK(mean_total(lumped) == Approx(5e8).epsilon(1e-14));
    for (const double tau : {0.0, 0.25, 1.0, 7.75})
        for (const Limit limit : {Limit::from_above, Limit::from_below})
            CHECK(total_at(lumped, tau, limit) == 5e8);
    CHECK(lumped.transitions() == std::vector<double>{0});
    CHECK(faulty_at(lumped, *BrokenTooth().at(1), 0.5) == 0);
}

TEST_CASE("faults unsupported by a square wave are refused, and so are invalid square waves") {
    const gears::MeshGeometry geometry(external(19), external(31));
    const ToothCrack cracks(geometry, kLiangSteel, Profile::root_circle, 1, kCrackAngle);
    const ToothChip chips(geometry, 0.0381, 1);
    const auto crack = cracks.at(1e-3), chip = chips.at(1e-3);
    CHECK_THROWS_AS(kPark.with_fault(*crack), std::invalid_argument);
    CHECK_THROWS_AS(kPark.with_fault(*chip), std::invalid_argument);
    CHECK_THROWS_AS(SquareWaveMesh(2e9, 1e9, 1.5), std::invalid_argument);
    CHECK_THROWS_AS(SquareWaveMesh(0, 1e9, 1.5), std::invalid_argument);
    CHECK_THROWS_AS(SquareWaveMesh(1e9, 2e9, 0.9), std::invalid_argument);
    CHECK_THROWS_AS(SquareWaveMesh(1e9, 2e9, 2.1), std::invalid_argument);
}

TEST_CASE("a crack on gear 1 or 2 weakens the pair according to the curve of its gear") {
    for (const auto& gear : cracked_gears()) {
        const AdditiveMesh mesh(gear.geometry, kLiangSteel, gear.profile);
        const ToothCrack family(gear.geometry, kLiangSteel, gear.profile, gear.which, kCrackAngle);
        const auto crack = family.at(0.2 * family.largest_size());
        const ToothPairCurve one = mesh.faulty_pair(*crack);
        for (const double tau : {0.2, 0.99, 1.3}) {
            const double others = total_at(mesh, tau) - mesh.tooth_pair(tau);
            CHECK(faulty_at(mesh, *crack, tau) == Approx(others + one(tau)).epsilon(1e-12));
        }
    }
}

}  // namespace gearpod::stiffness::test_faulty_mesh
