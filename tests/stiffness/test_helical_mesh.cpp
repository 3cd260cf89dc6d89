// Checks helical pairs as thin slices of the spur pair against sums of separate slices, and
// properties that hold for any slices.
#include "stiffness/additive_mesh.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/helical_mesh.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_helical_mesh {

using namespace test_pairs;

const gears::MeshGeometry kPlanetRing(external(31), internal(81));

std::unique_ptr<const MeshStiffness> additive() {
    return std::make_unique<AdditiveMesh>(kPlanetRing, kLiangSteel, Profile::root_circle);
}
std::unique_ptr<const MeshStiffness> coupled() {
    CoupledMeshOptions options;
    options.foundation = FoundationModel::elastic_ring;
    options.body_radius_1_m = 0.02;
    options.body_radius_2_m = 0.155;
    return std::make_unique<CoupledMesh>(kPlanetRing, kLiangSteel, Profile::root_circle, options);
}

// Mean over so many slices at the middles of equal widths; a jump falls between two of them.
template <class OfSlice>
double by_slices(double overlap, const OfSlice& of_slice) {
    constexpr int kSlices = 20000;
    double sum = 0;
    for (int i = 0; i < kSlices; ++i)
        sum += of_slice(overlap * (i + 0.5) / kSlices);
    return sum / kSlices;
}

// Pits in the middle of the profile of the planet's teeth.
PitBand pits_at(double face_centre) {
    PitBand band;
    band.centre_radius_m = kPlanetRing.contact_radius(1, 0.5 * kPlanetRing.contact_ratio());
    band.length_m = 2e-3;
    band.face_centre = face_centre;
    return band;
}

double faulty_total(const FaultyMesh& faulty, const MeshStiffness& mesh, double tau) {
    return tau < 0 || tau > faulty.duration() ? total_at(mesh, tau)
                                              : total_at(faulty, mesh.transitions(), tau);
}

TEST_CASE("a helical pair is the sum of its slices, each a spur pair that engages later") {
    for (const auto& make : {additive, coupled}) {
        const auto spur = make();
        const double overlap = 0.37;
        const HelicalMesh mesh(make(), overlap);
        CHECK(mesh.contact_ratio() == spur->contact_ratio() + overlap);
        CHECK(mesh.pitch_position() == spur->pitch_position() + overlap / 2);
        CHECK(mean_total(mesh) == Approx(mean_total(*spur)).epsilon(1e-10));
        for (const double tau : {0.01, 0.2, 0.36, 0.5, 0.93, 0.99, 1.4})
            CHECK(total_at(mesh, tau) == Approx(by_slices(overlap, [&](double later) {
                                             return total_at(*spur, tau - later);
                                         })).epsilon(3e-5));
    }
}

TEST_CASE("the stiffness of a helical pair is constant where its overlap ratio is an integer") {
    for (const double overlap : {1.0, 2.0}) {
        const HelicalMesh mesh(coupled(), overlap);
        for (int i = 0; i < 50; ++i)
            CHECK(total_at(mesh, 0.02 * i) == Approx(mean_total(mesh.slice())).epsilon(1e-12));
    }
    // Range (largest minus smallest) for other overlap ratios: a half and three halves.
    const auto range = [](const MeshStiffness& mesh) {
        double least = INFINITY, largest = 0;
        for (int i = 0; i < 500; ++i) {
            const double k = total_at(mesh, (i + 0.5) / 500);
            least = std::min(least, k);
            largest = std::max(largest, k);
        }
        return largest - least;
    };
    const double spur = range(*coupled());
    CHECK(range(HelicalMesh(coupled(), 0.5)) < 0.6 * spur);
    CHECK(range(HelicalMesh(coupled(), 1.5)) < 0.25 * spur);
}

TEST_CASE("a nearly zero helix angle gives the spur pair") {
    const auto spur = additive();
    const HelicalMesh mesh(additive(), 1e-4);
    for (const double tau : {0.1, 0.5, 0.85, 0.97})  // off the transitions
        CHECK(total_at(mesh, tau) == Approx(total_at(*spur, tau)).epsilon(2e-4));
}

TEST_CASE("the tooth pairs of a helical pair share its load") {
    const HelicalMesh mesh(coupled(), 0.73);
    for (int i = 0; i < 100; ++i) {
        const double phase = (i + 0.5) / 100;
        double sum = 0;
        for (double tau = phase; tau < mesh.contact_ratio(); ++tau) {
            double share = 0;
            mesh.share({&tau, 1}, tau, {&share, 1});
            CHECK(share >= 0);
            sum += share;
        }
        CHECK(sum == Approx(1).epsilon(1e-9));
    }
    // Positions from one end of the flank to the other, symmetric from both.
    CHECK(mesh.flank_position(0) == -0.5);
    CHECK(mesh.flank_position(mesh.contact_ratio()) == 0.5);
    for (const double tau : {0.1, 0.8, 1.2})
        CHECK(mesh.flank_position(tau) ==
              Approx(-mesh.flank_position(mesh.contact_ratio() - tau)).margin(1e-15));
}

TEST_CASE("a fault passes a helical pair slice by slice") {
    const ToothCrack cracks(kPlanetRing, kLiangSteel, Profile::root_circle, 1, kCrackAngle);
    const auto crack = cracks.at(2e-3);
    for (const auto& make : {additive, coupled}) {
        const auto spur = make();
        const auto spur_faulty = spur->with_fault(*crack);
        const double overlap = 0.61;
        const HelicalMesh mesh(make(), overlap);
        const auto faulty = mesh.with_fault(*crack);
        CHECK(faulty->duration() == Approx(mesh.contact_ratio()));
        for (const double tau : {0.05, 0.4, 0.7, 1.3, 1.95, 2.4}) {
            CHECK(total_at(*faulty, mesh.transitions(), tau) ==
                  Approx(by_slices(overlap, [&](double later) {
                      return faulty_total(*spur_faulty, *spur, tau - later);
                  })).epsilon(1e-5));
            CHECK(total_at(*faulty, mesh.transitions(), tau) < total_at(mesh, tau));
            double sum = 0;
            for (int tooth = -2; tooth <= 2; ++tooth) {
                double one = 0;
                faulty->tooth_pair(tooth, {&tau, 1}, tau, {&one, 1});
                sum += one;
            }
            CHECK(sum == Approx(total_at(*faulty, mesh.transitions(), tau)).epsilon(1e-8));
        }
    }
}

// The slices with a fault lose as much as the spur tooth over their part of the width; the others
// nothing.
TEST_CASE("chips and pits act at their position along the face width") {
    const double face = kLiangSteel.face_width_m, overlap = 0.61;
    const ToothChip first(kPlanetRing, face, 1), last(kPlanetRing, face, 1, {}, FaceEnd::last);
    const ToothPitting pits(kPlanetRing, kLiangSteel, Profile::root_circle, 1, pits_at(0.3));
    struct Placed {
        std::unique_ptr<const ToothFault> fault;
        double begin, end;
    };
    const Placed placed[] = {{first.at(0.1 * face), 0, 0.1},
                             {last.at(0.1 * face), 0.9, 1},
                             {pits.at(0.4 * face), 0.1, 0.5}};
    for (const auto& make : {additive, coupled})
        for (const Placed& p : placed) {
            const auto spur = make();
            const auto spur_faulty = spur->with_fault(*p.fault);
            const HelicalMesh mesh(make(), overlap);
            const auto faulty = mesh.with_fault(*p.fault);
            const auto spur_lost = [&](double tau) {
                return total_at(*spur, tau) - faulty_total(*spur_faulty, *spur, tau);
            };
            double lost = 0, lost_in_all = 0;
            for (int i = 0; i < 60; ++i) {
                const double tau = (i + 0.5) / 60 * faulty->duration();
                const double here =
                    total_at(mesh, tau) - total_at(*faulty, mesh.transitions(), tau);
                CHECK(here ==
                      Approx(by_slices(overlap * (p.end - p.begin),
                                       [&](double later) {
                                           return spur_lost(tau - overlap * p.begin - later);
                                       }))
                          .epsilon(1e-3)
                          .margin(1e-6 * mean_total(mesh)));
                lost += here / 60 * faulty->duration();
            }
            for (int i = 0; i < 4000; ++i)
                lost_in_all += spur_lost((i + 0.5) / 4000 * spur_faulty->duration()) / 4000 *
                               spur_faulty->duration();
            CHECK(lost_in_all > 0);
            CHECK(lost == Approx(lost_in_all).epsilon(0.05));
        }
}

TEST_CASE("at a nearly zero helix angle a pit has the same effect as on a spur tooth") {
    PitBand band = pits_at(0.8);
    band.depth_m = 0.5e-3;
    const ToothPitting pits(kPlanetRing, kLiangSteel, Profile::root_circle, 1, band);
    const auto pit = pits.at(0.2 * kLiangSteel.face_width_m);
    const auto spur = additive();
    const HelicalMesh mesh(additive(), 1e-4);
    const auto spur_faulty = spur->with_fault(*pit), faulty = mesh.with_fault(*pit);
    for (const double tau : {0.3, 0.97, 1.4})
        CHECK(total_at(*faulty, mesh.transitions(), tau) ==
              Approx(total_at(*spur_faulty, spur->transitions(), tau)).epsilon(2e-4));
}

TEST_CASE("pits that reach beyond the end of the face are refused") {
    const double face = kLiangSteel.face_width_m;
    const ToothPitting pits(kPlanetRing, kLiangSteel, Profile::root_circle, 1, pits_at(0.2));
    CHECK(pits.problems(0.4 * face).empty());
    const auto problems = pits.problems(0.41 * face);
    REQUIRE(problems.size() == 1);
    CHECK_THAT(problems[0], Catch::Contains("from the end of the face reach beyond it"));
}

TEST_CASE("deeper cracks soften a helical pair more, and a broken tooth removes its own pair") {
    const HelicalMesh mesh(additive(), 1.2);
    const ToothCrack cracks(kPlanetRing, kLiangSteel, Profile::root_circle, 1, kCrackAngle);
    double before = INFINITY;
    for (const double depth_mm : {0.5, 1.0, 2.0, 3.0, 4.0}) {
        const auto crack = cracks.at(1e-3 * depth_mm);
        const double k = total_at(*mesh.with_fault(*crack), mesh.transitions(), 1.5);
        CHECK(k < before);
        before = k;
    }
    const auto broken = BrokenTooth().at(1);
    const auto faulty = mesh.with_fault(*broken);
    for (double tau : {0.3, 1.5, 2.7}) {
        double one = 1;
        faulty->tooth_pair(0, {&tau, 1}, tau, {&one, 1});
        CHECK(std::abs(one) < 1e-7 * mean_total(mesh));
    }
}

// A cantilever of the normal section, as long as the tooth and loaded along the normal, represents
// a slice of the tooth: its bending in the transverse plane is the transverse section's over cos^4.
TEST_CASE("the factors of helical teeth are those of the inclined section") {
    const double helix = 0.3, normal_angle = 0.35;
    Material leaning = kLiangSteel;
    set_helix(helix, normal_angle, leaning);
    const double c = std::cos(helix);
    // Width b, thickness t, arm a in the transverse plane; force f in that plane.
    const double t = 5e-3, a = 4e-3, f = 100, b = kLiangSteel.face_width_m;
    const double length = b / c, thin = t * c, moment = f * a / c;
    const double energy = moment * moment * a /
                          (2 * kLiangSteel.youngs_modulus_Pa * thin * thin * thin * length / 12);
    const double upright =
        f * f * a * a * a / (2 * kLiangSteel.youngs_modulus_Pa * t * t * t * b / 12);
    CHECK(upright / energy == Approx(leaning.bending_factor).epsilon(1e-14));
    const double base = std::asin(std::sin(helix) * std::cos(normal_angle));
    CHECK(hertz_stiffness(leaning) ==
          Approx(std::cos(base) * hertz_stiffness(kLiangSteel)).epsilon(1e-14));
    Material spur = kLiangSteel;
    set_helix(0, normal_angle, spur);
    CHECK(hertz_stiffness(spur) == hertz_stiffness(kLiangSteel));
}

TEST_CASE("an overlap ratio must be positive") {
    CHECK_THROWS_WITH(HelicalMesh(additive(), 0), Catch::Contains("must be positive"));
}

}  // namespace gearpod::stiffness::test_helical_mesh
