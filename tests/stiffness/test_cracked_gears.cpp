// Checks the loss of mesh stiffness by a crack, by fracture mechanics, against finite elements of
// whole gears. Table and its computation: tests/peers/fem-gear-pairs/README.md.
#include "gears/mesh_geometry.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/stiffness/finite_element_tables.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/stiffness/mesh_level_pairs.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_cracked_gears {

using finite_elements::Row;
using test_pairs::kCrackAngle;
using test_pairs::kLiangSteel;

// A gear pair with the cracked gear, and the radii at which the bodies are fixed.
struct Gears {
    gears::MeshGeometry geometry;
    int cracked;
    double held_1_m, held_2_m;
};

// Gears by the table's name of the cracked tooth.
Gears gears_of(const std::string& tooth) {
    if (tooth.starts_with("bell")) {  // studies/bell-206b.toml
        const mesh_level::LevelPair& bell = mesh_level::pair_of_case("bell-sun");
        return {bell.geometry, tooth == "bell-sun" ? 1 : 2, bell.held_1_m, bell.held_2_m};
    }
    const gears::Gear planet = test_pairs::external(31);
    if (tooth == "sun" || tooth == "planet-sun")
        return {{test_pairs::external(19), planet}, tooth == "sun" ? 1 : 2, 0.013, 0.020};
    return {{planet, test_pairs::internal(81)}, tooth == "ring" ? 2 : 1, 0.020, 0.155};
}

struct CrackedPair {
    CrackedPair(const std::string& tooth, Profile profile)
        : gears(gears_of(tooth)),
          mesh(gears.geometry, kLiangSteel, profile,
               {FoundationModel::elastic_ring, Contact::linear, gears.held_1_m, gears.held_2_m,
                0.0}),
          cracks(gears.geometry, kLiangSteel, profile, gears.cracked, kCrackAngle,
                 CrackLaw::fracture_mechanics) {}

    // Lost fraction of the mesh stiffness at a position since the tooth's engagement began.
    double loss(double depth_m, double tau) const { return loss(*cracks.at(depth_m), tau); }
    double loss(const ToothFault& crack, double tau) const {
        const auto faulty = mesh.with_fault(crack);
        return 1 -
               total_at(*faulty, mesh.transitions(), tau) / total_at(mesh, tau - std::floor(tau));
    }

    Gears gears;
    CoupledMesh mesh;
    ToothCrack cracks;
};

Profile profile_named(const std::string& name) {
    return name == "fillet" ? Profile::fillet : Profile::root_circle;
}

double position(const Row& row) {
    return row.number("phase") + row.count("cracked");
}

double loss_of(const Row& row) {
    return 1 - row.number("cracked_N_m") / row.number("healthy_N_m");
}

// Spatial crack of a row of spatial.h5.
CrackGrowth growth_of(const Row& row) {
    const auto metres = [&](const char* column) { return 1e-3 * row.number(column); };
    return {{metres("depth_mm")},
            {metres("end_depth_mm")},
            {metres("length_mm")},
            {0},
            {0},
            kCrackAngle,
            kCrackAngle,
            16};
}

// A spatial crack of spatial.h5, and plane cracks of its local depths.
class SpatialCase {
  public:
    explicit SpatialCase(const Row& row)
        : pair_(row.text("tooth"), Profile::fillet),
          surface_(growth_of(row).at(1, width())),
          family_(pair_.gears.geometry, kLiangSteel, Profile::fillet, pair_.gears.cracked,
                  growth_of(row), nullptr, CrackLaw::fracture_mechanics),
          crack_(family_.at(1)) {
        for (int i = 0; i < kSlices; ++i)
            plane_.push_back(pair_.cracks.at(surface_.crack(slice(i)).depth_m));
    }

    // Loss of mesh stiffness by the spatial crack.
    double loss(const Row& row) const { return pair_.loss(*crack_, position(row)); }

    // Share of the load that the cracked pair carries without the crack.
    double load_share(const Row& row) const {
        const double tau[] = {position(row)};
        double share[1];
        pair_.mesh.share(tau, tau[0], share);
        return share[0];
    }

    // Mean along the face of the losses by the plane cracks: slices of the whole mesh in parallel.
    double mean_plane_loss(const Row& row) const {
        double sum = 0;
        for (int i = 0; i < kSlices; ++i)
            sum += surface_.stretching(slice(i)) / width() * pair_.loss(*plane_[i], position(row)) /
                   kSlices;
        return sum;
    }

  private:
    static constexpr int kSlices = 32;
    static double width() { return kLiangSteel.face_width_m; }
    static double slice(int i) { return (i + 0.5) / kSlices; }

    const CrackedPair pair_;
    const CrackSurface surface_;
    const SpatialCrack family_;
    const std::unique_ptr<const ToothFault> crack_;
    std::vector<std::unique_ptr<const ToothFault>> plane_;
};

// Calls visit(row, case) for every row of spatial.h5; rows of one crack follow each other.
template <class Visit>
void for_spatial_rows(Visit visit) {
    std::unique_ptr<SpatialCase> one;
    std::string before;
    for (const Row& row : finite_elements::table("spatial")) {
        const std::string crack =
            row.text("tooth") + row.text("shape") + std::to_string(row.number("share"));
        if (crack != before)
            one = std::make_unique<SpatialCase>(row);
        before = crack;
        visit(row, *one);
    }
}

// Margin of a loss against the finite elements'.
double margin_of(double elements, double relative = 0.15) {
    return std::max(relative * elements, 0.005);
}

const char* const kTeeth[] = {"sun", "planet-sun", "planet-ring", "ring"};
constexpr Profile kProfiles[] = {Profile::fillet, Profile::root_circle};

TEST_CASE("a crack reduces the mesh stiffness as in finite elements, within 15 %", "[crack]") {
    int rows = 0;
    for (const Row& row : finite_elements::table("cracks")) {
        INFO(row.text("tooth") << " " << row.text("profile") << ", " << row.number("share")
                               << " of the section, at " << position(row));
        const CrackedPair pair(row.text("tooth"), profile_named(row.text("profile")));
        const double depth_m = 1e-3 * row.number("depth_mm");
        CHECK(pair.cracks.largest_size() * row.number("share") == Approx(depth_m).epsilon(1e-5));
        const double elements = loss_of(row);
        CHECK(pair.loss(depth_m, position(row)) == Approx(elements).margin(margin_of(elements)));
        ++rows;
    }
    CHECK(rows == (4 * 2 + 2) * 4 * 5);
}

TEST_CASE("a spatial crack reduces the mesh stiffness as in solid elements, within 15 %",
          "[crack]") {
    // Two pairs in contact: within 16 %. A contact low on the tooth adds up errors of the load
    // share, of the plane crack and of its shape. The mean of plane losses along the face, without
    // any support between slices, is an upper bound of the program's loss.
    int rows = 0;
    for_spatial_rows([&](const Row& row, const SpatialCase& one) {
        INFO(row.text("tooth") << " " << row.text("shape") << ", " << row.number("share")
                               << " of the section, at " << position(row));
        const double elements = loss_of(row), loss = one.loss(row);
        const bool shared = row.count("pairs") > 1;
        CHECK(loss == Approx(elements).margin(margin_of(elements, shared ? 0.16 : 0.15)));
        CHECK(one.load_share(row) == Approx(row.number("load_share")).margin(0.025));
        CHECK(loss < one.mean_plane_loss(row) + 1e-3);
        ++rows;
    });
    CHECK(rows == 4 * 4 * 4 * 5);
}

TEST_CASE("the loss grows from the first hundredth of a millimetre to the whole tooth", "[crack]") {
    for (const char* tooth : kTeeth)
        for (const Profile profile : kProfiles) {
            INFO(tooth << (profile == Profile::fillet ? " fillet" : " root circle"));
            const CrackedPair pair(tooth, profile);
            // Position high on the tooth.
            const double largest = pair.cracks.largest_size(),
                         tau = pair.gears.cracked == 1 ? 1.3 : 0.3;
            double before = 0;
            for (double depth = 1e-5; depth < largest; depth *= 1.2) {
                const double loss = pair.loss(depth, tau);
                CHECK(loss > before);
                CHECK(loss < 1);
                before = loss;
            }
            CHECK(pair.loss(1e-4, tau) > 5e-5);
            // Other pairs carry the whole load once the tooth has broken off.
            const double gone = pair.loss(largest, tau);
            CHECK(gone > before);
            CHECK(pair.loss(largest * (1 - 1e-4), tau) == Approx(gone).epsilon(1e-3));
            CHECK(pair.loss(2 * largest, tau) == gone);
        }
}

TEST_CASE("the added compliance is the integral of the energy release rate", "[crack]") {
    const gears::MeshGeometry geometry(test_pairs::external(31), test_pairs::internal(81));
    for (const int which : {1, 2}) {
        const ToothProfile tooth(geometry.gear(which), Profile::fillet);
        const CrackPath path(tooth, kCrackAngle);
        const double angle = geometry.contact_angle(which, 1.1);
        const double cosine = std::cos(angle), sine = std::sin(angle);
        const double modulus = kLiangSteel.youngs_modulus_Pa /
                               (1 - kLiangSteel.poisson_ratio * kLiangSteel.poisson_ratio);
        for (const double share : {0.1, 0.3, 0.49, 0.7, 0.95}) {
            const double depth = share * path.length(), step = 1e-5 * depth;
            const auto added = [&](double a) {
                return CrackCompliance(path, kLiangSteel, a).added(angle);
            };
            const CrackIntensity k = path.intensity(depth);
            const double opening = k.opening(cosine, sine), sliding = k.sliding(cosine, sine);
            CHECK((added(depth + step) - added(depth - step)) / (2 * step) ==
                  Approx(2 * (opening * opening + sliding * sliding) /
                         (modulus * kLiangSteel.face_width_m))
                      .epsilon(1e-6));
        }
    }
}

TEST_CASE("the critical section is at the fillet's 30 degree tangent", "[crack]") {
    for (const int teeth : {19, 31, 60}) {
        const ToothProfile tooth(test_pairs::external(teeth), Profile::fillet);
        const double u = tooth.critical(), step = 1e-6;
        CHECK(u > tooth.fillet_end());
        CHECK(u < tooth.root());
        const ToothSection above = tooth.section(u - step), below = tooth.section(u + step);
        CHECK(std::atan2(below.half_thickness - above.half_thickness, above.axial - below.axial) ==
              Approx(std::numbers::pi / 6).epsilon(1e-5));
    }
    const ToothProfile ring(test_pairs::internal(81), Profile::fillet);
    CHECK(ring.critical() == ring.root());
}

TEST_CASE("a spatial crack of one depth equals the plane crack by fracture mechanics", "[crack]") {
    for (const char* tooth : kTeeth) {
        INFO(tooth);
        const CrackedPair pair(tooth, Profile::fillet);
        const double depth_m = 0.3 * pair.cracks.largest_size(), width_m = kLiangSteel.face_width_m;
        const auto spatial = [&](double end_depth_m, double length_m, double height_m) {
            const CrackGrowth growth{{depth_m},  {end_depth_m}, {length_m},  {height_m},
                                     {height_m}, kCrackAngle,   kCrackAngle, 16};
            const SpatialCrack family(pair.gears.geometry, kLiangSteel, Profile::fillet,
                                      pair.gears.cracked, growth, nullptr,
                                      CrackLaw::fracture_mechanics);
            const auto crack = family.at(1);
            const double tau[] = {0.2, 0.8, 1.3};
            std::vector<double> compliance(3);
            crack->beam_compliance(tau, compliance);
            return compliance;
        };
        const auto plane = pair.cracks.at(depth_m);
        const double tau[] = {0.2, 0.8, 1.3};
        std::vector<double> whole(3), cracked(3);
        plane->beam_compliance(tau, cracked);
        pair.cracks.at(1e-9)->beam_compliance(tau, whole);
        const auto through = spatial(depth_m, width_m, 0), half = spatial(0, 0.5 * width_m, 0),
                   higher = spatial(depth_m, width_m, 0.5e-3);
        for (int i = 0; i < 3; ++i) {
            CHECK(through[i] / cracked[i] == Approx(1.0).epsilon(1e-6));
            CHECK(half[i] > whole[i]);
            CHECK(half[i] < cracked[i]);
            CHECK(higher[i] > whole[i]);
        }
    }
}

TEST_CASE("largest loss of the ring mesh in planet-crack.toml by law and profile", "[.fem]") {
    std::puts("| depth mm | root circle, sections | root circle, fracture | fillet, fracture |");
    const Gears gears = gears_of("planet-ring");
    const auto largest = [&](Profile profile, CrackLaw law, double depth_m) {
        const CrackedPair pair("planet-ring", profile);
        const ToothCrack cracks(gears.geometry, kLiangSteel, profile, 1, kCrackAngle, law);
        const auto crack = cracks.at(depth_m);
        const auto faulty = pair.mesh.with_fault(*crack);
        double loss = 0;
        for (double tau = 0.005; tau < gears.geometry.contact_ratio(); tau += 0.01)
            loss = std::max(loss, 1 - total_at(*faulty, pair.mesh.transitions(), tau) /
                                          total_at(pair.mesh, tau - std::floor(tau)));
        return 100 * loss;
    };
    for (const double depth_m : {0.1e-3, 0.5e-3, 1e-3, 2e-3, 2.15e-3, 3e-3, 4.28e-3})
        std::printf("| %.2f | %.2f | %.2f | %.2f |\n", 1e3 * depth_m,
                    largest(Profile::root_circle, CrackLaw::sections, depth_m),
                    largest(Profile::root_circle, CrackLaw::fracture_mechanics, depth_m),
                    largest(Profile::fillet, CrackLaw::fracture_mechanics, depth_m));
}

}  // namespace gearpod::stiffness::test_cracked_gears
