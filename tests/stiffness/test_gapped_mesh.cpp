// Checks tooth pairs with gaps: relief, crowning and contact beyond the nominal path.
#include "gears/flank_gaps.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/gapped_mesh.hpp"
#include "stiffness/helical_mesh.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_gapped_mesh {

using namespace test_pairs;

const gears::MeshGeometry kSunPlanet(external(19), external(31));
const gears::MeshGeometry kRingPlanet(external(31), internal(81));
constexpr double kForce = 3.8e3;
constexpr double kReach = 60e-6;

std::unique_ptr<const MeshStiffness> rigid(const gears::MeshGeometry& geometry) {
    return std::make_unique<AdditiveMesh>(geometry, kLiangSteel, Profile::root_circle);
}

std::unique_ptr<const MeshStiffness> elastic(const gears::MeshGeometry& geometry) {
    CoupledMeshOptions options;
    options.foundation = FoundationModel::elastic_ring;
    options.body_radius_1_m = geometry.internal() ? 0.020 : 0.013;
    options.body_radius_2_m = geometry.internal()                                ? 0.155
                              : geometry.gear(1).teeth == geometry.gear(2).teeth ? 0.013
                                                                                 : 0.020;
    options.force_N = kForce;
    return std::make_unique<CoupledMesh>(geometry, kLiangSteel, Profile::root_circle, options);
}

GappedMesh extended(const gears::MeshGeometry& geometry, bool bodies, double force = kForce) {
    return {bodies ? elastic(geometry) : rigid(geometry), 0, {geometry, {}, {}, kReach}, force, 1};
}

double at(const MeshStiffness& mesh, double tau) {
    double k = 0;
    mesh.slice_stiffness(0, {&tau, 1}, tau, {&k, 1});
    return k;
}

double secant(const MeshStiffness& mesh, double tau) {
    double k = 0;
    mesh.total({&tau, 1}, tau, {&k, 1});
    return k;
}

TEST_CASE("without gaps each tooth pair keeps its stiffness") {
    for (const bool bodies : {false, true}) {
        const GappedMesh mesh(bodies ? elastic(kSunPlanet) : rigid(kSunPlanet), 0,
                              {kSunPlanet, {}, {}, 0}, kForce, 1);
        const auto plain = bodies ? elastic(kSunPlanet) : rigid(kSunPlanet);
        CHECK(mesh.contact_ratio() == plain->contact_ratio());
        CHECK(mesh.transitions() == plain->transitions());
        for (double tau = 0.013; tau < mesh.contact_ratio(); tau += 0.07) {
            CHECK(at(mesh, tau) == Approx(at(*plain, tau)).epsilon(1e-8));
            CHECK(secant(mesh, tau) == Approx(secant(*plain, tau)).epsilon(1e-8));
        }
    }
}

// Equilibrium: the springs in contact together carry the force.
TEST_CASE("load shares of an extended contact add up to the force") {
    for (const bool bodies : {false, true}) {
        const GappedMesh mesh = extended(kRingPlanet, bodies);
        for (double phase = 0.003; phase < 1; phase += 0.037) {
            double sum = 0;
            for (double tau = phase; tau < mesh.contact_ratio(); ++tau) {
                double share = 0;
                mesh.share({&tau, 1}, tau, {&share, 1});
                CHECK(share >= 0);
                sum += share;
            }
            CHECK(sum == Approx(1).epsilon(1e-9));
        }
    }
}

// The approach jumps with an abrupt contact; with an extended one it changes continuously.
TEST_CASE("an extended contact has no step at the ends of the path") {
    for (const bool bodies : {false, true}) {
        for (const auto& geometry : {kSunPlanet, kRingPlanet}) {
            const GappedMesh mesh = extended(geometry, bodies);
            const LoadedMesh loaded(mesh, kForce);
            const auto plain = bodies ? elastic(geometry) : rigid(geometry);
            const double jump = kForce / secant(*plain, plain->transitions().back() + 1e-6) -
                                kForce / secant(*plain, plain->transitions().back() - 1e-6);
            REQUIRE(std::abs(jump) > 0.3e-6);
            double last = loaded.approach(0, 1e-6), steepest = 0;
            constexpr int kPoints = 20'000;
            for (int i = 1; i <= kPoints; ++i) {
                const double tau = static_cast<double>(i) / kPoints;
                const double d = loaded.approach(tau, tau - 1e-6);
                steepest = std::max(steepest, std::abs(d - last));
                last = d;
            }
            CHECK(steepest < 0.005 * std::abs(jump));
        }
    }
}

// Stiffer teeth close smaller corner gaps: contact beyond the path then takes a share of the mesh
// period that decreases with the square root of the approach. Outside it nothing changes.
TEST_CASE("the extended contact converges to the abrupt one as the load decreases") {
    double last = 1;
    for (const double force : {4e3, 4e2, 4e1, 4.0}) {
        const GappedMesh mesh = extended(kSunPlanet, false, force);
        const auto plain = rigid(kSunPlanet);
        int different = 0;
        constexpr int kPoints = 4000;
        for (int i = 0; i < kPoints; ++i) {
            const double tau = (i + 0.5) / kPoints;
            const double k = secant(*plain, tau);
            if (std::abs(secant(mesh, mesh.path_begin() + tau) - k) > 1e-6 * k)
                ++different;
        }
        const double share = static_cast<double>(different) / kPoints;
        CHECK(share < 0.4 * last);
        CHECK(share > 0);
        last = share;
    }
}

// The laws of mesh damping use the stiffness of the teeth on their paths, for any gaps.
TEST_CASE("the sum over the paths is the total of a mesh without gaps") {
    const gears::FlankRelief ground{20e-6, 2e-3};
    const auto plain = elastic(kRingPlanet);
    const GappedMesh mesh(elastic(kRingPlanet), 0, {kRingPlanet, ground, ground, kReach}, kForce,
                          1);
    for (double tau = 0.013; tau < 1; tau += 0.07) {
        const double at = mesh.path_begin() + tau;
        double paths = 0, faulty = 0;
        mesh.path_total({&at, 1}, at, {&paths, 1});
        CHECK(paths == Approx(secant(*plain, tau)).epsilon(1e-9));
        const auto half = Reduction().at(0.5);
        mesh.with_fault(*half)->path_total({&at, 1}, at, {&faulty, 1});
        CHECK(faulty == Approx(0.5 * paths).epsilon(1e-6));
    }
}

// Contact beyond the path: the pair's own corner gap and its stiffness at the path's end.
TEST_CASE("teeth on rigid bodies keep their stiffness beyond the path") {
    const GappedMesh mesh = extended(kSunPlanet, false);
    const double begin = mesh.path_begin(), end = mesh.path_end();
    const auto plain = rigid(kSunPlanet);
    for (const double beyond : {0.01, 0.05, 0.08}) {
        CHECK(at(mesh, begin - beyond) == Approx(at(*plain, 1e-9)).epsilon(1e-6));
        CHECK(mesh.slice_gap(0, begin - beyond) ==
              Approx(gears::corner_gap(kSunPlanet, -beyond)).epsilon(1e-9));
        CHECK(mesh.slice_gap(0, end + beyond) ==
              Approx(gears::corner_gap(kSunPlanet, kSunPlanet.contact_ratio() + beyond))
                  .epsilon(1e-9));
    }
    CHECK(mesh.slice_gap(0, 0.5 * (begin + end)) == 0);
    CHECK(at(mesh, mesh.contact_ratio() + 0.01) == 0);
    CHECK(mesh.slice_flank_position(0, 0.5 * begin) == -0.5);
}

// A pair of equal gears is symmetrical from both ends of its path.
TEST_CASE("a pair of equal gears is symmetrical about its pitch point") {
    const gears::MeshGeometry equal(external(27), external(27));
    for (const bool bodies : {false, true}) {
        const GappedMesh mesh = extended(equal, bodies);
        const double ratio = mesh.contact_ratio();
        for (double tau = 0.01; tau < ratio; tau += 0.05) {
            CHECK(at(mesh, tau) == Approx(at(mesh, ratio - tau)).epsilon(1e-6));
            CHECK(mesh.slice_gap(0, tau) == Approx(mesh.slice_gap(0, ratio - tau)).margin(1e-12));
        }
    }
}

// Slices over the face, compared with a sum over many of them.
TEST_CASE("slices of crowned, relieved helical teeth converge") {
    const gears::FlankRelief ground{8e-6, 2e-3, 5e-6};
    const double overlap = 0.8;
    const auto approach = [&](int slices, double phase) {
        const GappedMesh mesh(rigid(kSunPlanet), overlap, {kSunPlanet, ground, ground, kReach},
                              kForce, slices);
        return LoadedMesh(mesh, kForce).approach(phase, phase);
    };
    for (const double phase : {0.11, 0.52, 0.93}) {
        const double converged = approach(400, phase);
        CHECK(approach(8, phase) == Approx(converged).epsilon(1e-2));
        CHECK(approach(16, phase) == Approx(converged).epsilon(2e-3));
        CHECK(approach(64, phase) == Approx(converged).epsilon(5e-4));
    }
}

// Without crowning, relief and corner contact, any number of slices adds up to the helical pair,
// also with a fault.
TEST_CASE("slices without gaps add up to the helical pair") {
    constexpr double kOverlap = 0.8;
    const HelicalMesh helical(rigid(kSunPlanet), kOverlap);
    const auto half = Reduction().at(0.5);
    const auto faulty_helical = helical.with_fault(*half);
    for (const int slices : {1, 5, 8}) {
        const GappedMesh mesh(rigid(kSunPlanet), kOverlap, {kSunPlanet, {}, {}, 0}, kForce, slices);
        CHECK(mesh.contact_ratio() == Approx(helical.contact_ratio()));
        CHECK(mesh.pitch_position() == Approx(helical.pitch_position()));
        const auto faulty = mesh.with_fault(*half);
        for (double tau = 0.017; tau < 1; tau += 0.09) {
            double paths = 0, own = 0, expected = 0;
            CHECK(secant(mesh, tau) == Approx(secant(helical, tau)).epsilon(1e-7));
            mesh.path_total({&tau, 1}, tau, {&paths, 1});
            CHECK(paths == Approx(secant(helical, tau)).epsilon(1e-9));
            faulty->total({&tau, 1}, tau, {&own, 1});
            faulty_helical->total({&tau, 1}, tau, {&expected, 1});
            CHECK(own == Approx(expected).epsilon(1e-6));
        }
    }
}

// Integral of the spur pair's forces over the face, by sums over 20,000 positions; flanks are worn
// by `wear`, m.
double force_over_face(const GappedMesh& spur, double overlap, double phase, double approach,
                       double wear = 0) {
    constexpr int kParts = 20'000;
    double force = 0;
    for (int i = 0; i < kParts; ++i) {
        const double late = overlap * (i + 0.5) / kParts;
        for (double tau = phase; tau < spur.contact_ratio() + overlap; ++tau) {
            if (const double own = tau - late; own > 0 && own < spur.contact_ratio()) {
                const double gap = spur.slice_gap(0, own) + wear * spur.slice_wear(0, own);
                force += at(spur, own) * std::max(0.0, approach - gap) / kParts;
            }
        }
    }
    return force;
}

// Sum of the forces of a mesh's slices at an approach, with flanks worn by `wear`, m.
double force_of_slices(const GappedMesh& mesh, double phase, double approach, double wear) {
    double force = 0;
    for (double tau = phase; tau < mesh.contact_ratio(); ++tau) {
        for (int slice = 0; slice < mesh.slices(); ++slice) {
            double k = 0;
            mesh.slice_stiffness(slice, {&tau, 1}, tau, {&k, 1});
            const double gap = mesh.slice_gap(slice, tau) + wear * mesh.slice_wear(slice, tau);
            force += k * std::max(0.0, approach - gap);
        }
    }
    return force;
}

// Force and derivative are exact at the nominal approach, and near it up to the square of the
// distance.
TEST_CASE("slices of helical teeth carry the force of the whole face") {
    constexpr double kOverlap = 1.03;
    const GappedMesh spur = extended(kSunPlanet, false);
    for (const int slices : {1, 3}) {
        const GappedMesh mesh(rigid(kSunPlanet), kOverlap, {kSunPlanet, {}, {}, kReach}, kForce,
                              slices);
        for (const double phase : {0.04, 0.41, 0.77}) {
            std::vector<ContactSpring> springs;
            add_springs(mesh, phase, phase, springs);
            const double nominal = LoadedMesh(mesh, kForce).approach(phase, phase);
            for (const auto& [factor, error] : {std::pair{1.0, 1e-4}, {0.7, 5e-3}, {1.5, 5e-3}}) {
                double force = 0;
                for (const ContactSpring& spring : springs) {
                    force += spring.stiffness * std::max(0.0, factor * nominal - spring.gap);
                }
                INFO(slices << " slices, phase " << phase << ", factor " << factor);
                CHECK(force == Approx(force_over_face(spur, kOverlap, phase, factor * nominal))
                                   .epsilon(error));
            }
        }
    }
}

// Gaps of the corner contact and of wear add up. Parts of the path resolve wear that lifts a piece
// of the contact line off; crowned teeth have fewer of them.
TEST_CASE("slices of worn helical teeth carry the force of the whole face") {
    constexpr double kOverlap = 1.03;
    const bool bodies = GENERATE(false, true);
    const int worn = GENERATE(1, 2);
    const auto make = [&](double overlap, int slices) {
        FlankGaps gaps{kSunPlanet, {}, {}, kReach};
        gaps.wear.emplace(kSunPlanet, worn);
        return GappedMesh(bodies ? elastic(kSunPlanet) : rigid(kSunPlanet), overlap, gaps, kForce,
                          slices);
    };
    const GappedMesh spur = make(0, 1);
    for (const int slices : {1, 3}) {
        const GappedMesh mesh = make(kOverlap, slices);
        CHECK(mesh.slices() ==
              GappedMesh(rigid(kSunPlanet), kOverlap, {kSunPlanet, {}, {}, kReach}, kForce, slices)
                  .slices());
        for (const double phase : {0.04, 0.41, 0.77}) {
            const double nominal = LoadedMesh(mesh, kForce).approach(phase, phase);
            for (const auto& [wear, approach, error] : {std::tuple{0.0, 1.0, 2e-4},
                                                        {0.0, 0.7, 2e-4},
                                                        {0.0, 1.5, 2e-4},
                                                        {0.5, 1.15, 2e-4},
                                                        {1.0, 1.3, 2e-4},
                                                        {3.0, 1.9, slices == 1 ? 1.5e-2 : 4e-2}}) {
                INFO(slices << " slices, gear " << worn << ", phase " << phase << ", wear " << wear
                            << ", approach " << approach);
                const double d = approach * nominal, depth = wear * nominal;
                CHECK(force_of_slices(mesh, phase, d, depth) ==
                      Approx(force_over_face(spur, kOverlap, phase, d, depth)).epsilon(error));
            }
        }
    }
}

// Relief of the same shape gives the same gap, also where it is scaled beyond the path.
TEST_CASE("the gap by wear is continuous, and scaled as relief beyond the path") {
    for (const bool bodies : {false, true}) {
        FlankGaps gaps{kRingPlanet, {}, {}, kReach};
        gaps.wear.emplace(kRingPlanet, 1);
        const GappedMesh mesh(bodies ? elastic(kRingPlanet) : rigid(kRingPlanet), 0, gaps, kForce,
                              1);
        for (const double end : {mesh.path_begin(), mesh.path_end()}) {
            CHECK(mesh.slice_wear(0, end - 1e-9) ==
                  Approx(mesh.slice_wear(0, end + 1e-9)).epsilon(1e-4));
        }
        // A constant relief of the whole flank: its gap beyond the path without the corner gap.
        const gears::FlankRelief flat{1e-6, 1e9};
        const GappedMesh relieved(bodies ? elastic(kRingPlanet) : rigid(kRingPlanet), 0,
                                  {kRingPlanet, flat, {}, kReach}, kForce, 1);
        for (const double tau :
             {0.3 * mesh.path_begin(), 0.5 * (mesh.path_end() + mesh.contact_ratio())}) {
            const double scale = (relieved.slice_gap(0, tau) - mesh.slice_gap(0, tau)) / 1e-6;
            const double shape = gaps.wear->shape(tau - mesh.path_begin());
            CHECK(mesh.slice_wear(0, tau) == Approx(scale * shape).epsilon(1e-6));
            CHECK((scale > 1.01) == bodies);
        }
        CHECK(mesh.slice_wear(0, mesh.pitch_position()) == Approx(0).margin(1e-9));
        const double phase = mesh.pitch_position() - std::floor(mesh.pitch_position());
        CHECK(std::ranges::any_of(mesh.transitions(), [&](double transition) {
            return std::abs(transition - phase) < 1e-9;
        }));
    }
}

// The transmission error of teeth whose overlap ratio is a whole number would be constant. One wave
// per slice would be an error of the slices.
TEST_CASE("slices add no ripple to the transmission error of helical teeth") {
    for (const bool bodies : {false, true}) {
        for (const int slices : {1, 4}) {
            const GappedMesh mesh(bodies ? elastic(kSunPlanet) : rigid(kSunPlanet), 1.0,
                                  {kSunPlanet, {}, {}, kReach}, kForce, slices);
            const auto range = LoadedMesh(mesh, kForce).range();
            CHECK(range.peak_to_peak() < 2e-3 * range.mean);
        }
    }
}

TEST_CASE("a fault softens its own tooth pair over the whole extended contact") {
    for (const bool bodies : {false, true}) {
        const GappedMesh mesh = extended(kRingPlanet, bodies);
        const auto fault = Reduction().at(0.5);
        const auto faulty = mesh.with_fault(*fault);
        CHECK(faulty->duration() == Approx(mesh.contact_ratio()));
        for (double tau = 0.02; tau < mesh.contact_ratio(); tau += 0.09) {
            double own = 0, total = 0;
            faulty->tooth_pair(0, {&tau, 1}, tau, {&own, 1});
            faulty->total({&tau, 1}, tau, {&total, 1});
            CHECK(own < at(mesh, tau));
            CHECK(total <= secant(mesh, tau) * (1 + 1e-9));
        }
        // The fault has no effect far beyond the path.
        const double early = 1e-3;
        double total = 0;
        faulty->total({&early, 1}, early, {&total, 1});
        CHECK(total == Approx(secant(mesh, early)).epsilon(1e-9));
    }
}

}  // namespace gearpod::stiffness::test_gapped_mesh
