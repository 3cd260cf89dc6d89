#include "tests/stiffness/mesh_level_pairs.hpp"

#include "gears/mesh_geometry.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "tests/stiffness/finite_element_tables.hpp"
#include "tests/stiffness/gear_pairs.hpp"
#include "tests/test.hpp"

using namespace gearpod;
using namespace gearpod::stiffness;
using std::numbers::pi;

namespace mesh_level {
namespace {

constexpr double kDegree = pi / 180, kNormalAngle = 20 * kDegree;

// Gear of the standard rack in its transverse plane.
gears::Gear rack_gear(int teeth, double normal_module_m, double helix_rad) {
    const double c = std::cos(helix_rad);
    gears::Gear gear{std::abs(teeth), teeth < 0, normal_module_m / c,
                     std::atan(std::tan(kNormalAngle) / c)};
    gear.addendum_coefficient = c;
    gear.dedendum_coefficient = 1.25 * c;
    return gear;
}

Material steel(double width_m, double helix_rad) {
    Material material{2.06e11, 0.3, width_m, true};
    set_helix(helix_rad, kNormalAngle, material);
    return material;
}

// External pair without backlash.
LevelPair external(const std::string& name, int z_1, int z_2, double module_m,
                   gears::SpecifiedShifts specified, double width_m, double helix_rad = 0) {
    gears::Gear one = rack_gear(z_1, module_m, helix_rad),
                two = rack_gear(z_2, module_m, helix_rad);
    const double c = std::cos(helix_rad);
    for (std::optional<double>* shift : {&specified.first, &specified.second})
        if (*shift)
            **shift *= c;
    const auto set = gears::working_shifts(one, two, nullptr, specified);
    one.profile_shift = set.first;
    two.profile_shift = set.second;
    one.tip_shortening = two.tip_shortening = set.tip_shortening;
    LevelPair pair{name, {one, two, set.centre_distance_m}, steel(width_m, helix_rad), helix_rad};
    return pair;
}

LevelPair discs(const std::string& name, int z_1, int z_2, double x_1, double x_2, double helix_deg,
                const std::string& elements, double bore = 1.0 / 3.0) {
    LevelPair pair = external(name, z_1, z_2, 4e-3, {x_1, x_2}, 0.02, helix_deg * kDegree);
    pair.held_1_m = bore * pair.geometry.gear(1).root_radius();
    pair.held_2_m = bore * pair.geometry.gear(2).root_radius();
    pair.force_N = 300e3 * 0.02 / std::cos(kNormalAngle);
    pair.elements = elements;
    return pair;
}

// Pair number `which` of a stage of sun, planet and ring.
LevelPair stage(const std::string& name, int sun, int planet, int ring, double module_m,
                double sun_shift, double distance_m, const Material& material, bool ring_mesh) {
    gears::Gear s = rack_gear(sun, module_m, 0), p = rack_gear(planet, module_m, 0),
                r = rack_gear(-ring, module_m, 0);
    const auto set = gears::working_shifts(s, p, &r, {sun_shift, {}, {}, distance_m});
    s.profile_shift = set.first;
    p.profile_shift = set.second;
    r.profile_shift = set.ring;
    s.tip_shortening = p.tip_shortening = set.tip_shortening;
    if (ring_mesh)
        return {name, {p, r, set.centre_distance_m}, material};
    return {name, {s, p, set.centre_distance_m}, material};
}

// Source: NREL 5 MW reference gearbox (Nejad et al. 2016), reports of KISSsoft 03/2017 on its
// stages in the repository gfsReboucas/Drivetrain. The bodies are those of the finite elements.
std::vector<LevelPair> nrel_pairs() {
    LevelPair sun = stage("18/36", 18, 36, 93, 21e-3, 0.389, 0.584, steel(0.55, 0), false);
    LevelPair ring = stage("36/93 internal", 18, 36, 93, 21e-3, 0.389, 0.584, steel(0.55, 0), true);
    sun.held_1_m = sun.geometry.gear(1).root_radius() / 2;
    sun.held_2_m = ring.held_1_m = sun.geometry.gear(2).root_radius() / 2;
    const gears::Gear& rim = ring.geometry.gear(2);
    ring.held_2_m = rim.root_radius() + 3 * (rim.root_radius() - rim.tip_radius());
    sun.report_N_m = 15.640e9 * 0.55;
    ring.report_N_m = 20.563e9 * 0.55;
    sun.report_blank = ring.report_blank = 0.862;
    sun.force_N = ring.force_N = 550e3;
    sun.elements = "turbine-sun";
    ring.elements = "turbine-ring";
    LevelPair fast =
        external("24/95, 10 deg", 24, 95, 14e-3, {0.48, {}, {}, 0.861}, 0.36, 10 * kDegree);
    fast.held_1_m = 0.08955;
    fast.held_2_m = 0.59666;
    fast.force_N = 240064.4 / std::cos(fast.geometry.gear(1).pressure_angle_rad);
    fast.report_N_m = 18.632e9 * 0.36;
    fast.report_blank = 0.898;
    return {sun, ring, fast};
}

// The pairs of tests/stiffness/test_finite_element_gears.cpp.
std::vector<LevelPair> element_pairs() {
    LevelPair sun = stage("27/35", 27, 35, 99, test_pairs::kModule, 0.3, 0.1000125,
                          test_pairs::kLiangSteel, false);
    LevelPair ring = stage("35/99 internal", 27, 35, 99, test_pairs::kModule, 0.3, 0.1000125,
                           test_pairs::kLiangSteel, true);
    LevelPair liang{"31/81 internal",
                    {test_pairs::external(31), test_pairs::internal(81)},
                    test_pairs::kLiangSteel};
    sun.held_1_m = 0.024;
    sun.held_2_m = ring.held_1_m = 0.0315;
    ring.held_2_m = 0.1775;
    liang.held_1_m = 0.02;
    liang.held_2_m = 0.155;
    liang.profile = Profile::root_circle;
    sun.force_N = ring.force_N = 8721;
    liang.force_N = 3969;
    sun.elements = "bell-sun";
    ring.elements = "bell-ring";
    liang.elements = "liang-ring";
    return {sun, ring, liang};
}

// Twist of a body of shear modulus G and width L between two circles, as displacement along the
// line of action per unit force: R_b^2 |1/r_held^2 - 1/r_root^2| / (4 pi G L).
double twist(const gears::Gear& gear, double held_m, const Material& material) {
    const double shear = material.youngs_modulus_Pa / (2 * (1 + material.poisson_ratio));
    const double base = gear.base_radius(), root = gear.root_radius();
    return base * base * std::abs(1 / (held_m * held_m) - 1 / (root * root)) /
           (4 * pi * shear * material.face_width_m);
}

// Stiffness without a compliance that all pairs in contact share.
double without(double stiffness, double compliance) {
    return 1 / (1 / stiffness - compliance);
}

// Mean over a mesh period of the rows of a case, each with the same compliance removed. Simpson's
// rule applies to the rows with more pairs and to those with fewer, times the length of their
// stretch.
double mean_of_rows(const LevelPair& pair, double compliance) {
    std::vector<double> more, fewer;
    const double ratio = pair.geometry.contact_ratio();
    const int most = static_cast<int>(std::floor(ratio)) + 1;
    for (const finite_elements::Row& row : finite_elements::table("mesh"))
        if (row.text("case") == pair.elements)
            (row.count("pairs") == most ? more : fewer)
                .push_back(without(row.number("flank_N_m"), compliance));
    const auto simpson = [](const std::vector<double>& k) {
        const std::size_t last = k.size() - 1;
        return (k[0] + 4 * k[last / 2] + k[last]) / 6;
    };
    REQUIRE(!more.empty());
    REQUIRE(!fewer.empty());
    const double part = ratio - std::floor(ratio);
    return part * simpson(more) + (1 - part) * simpson(fewer);
}

}  // namespace

std::vector<LevelPair> all_pairs() {
    std::vector<LevelPair> pairs{
        discs("19/48", 19, 48, 0, 0, 0, "discs-19-48"),
        discs("19/48, rims", 19, 48, 0, 0, 0, "rims-19-48", 0.75),
        discs("30/60", 30, 60, 0, 0, 0, "discs-30-60"),
        discs("20/30, shifts 0.4 and 0.2", 20, 30, 0.4, 0.2, 0, "discs-20-30"),
        discs("17/43, shift 0.3", 17, 43, 0.3, 0, 0, ""),
        discs("25/40", 25, 40, 0, 0, 0, ""),
        discs("25/40, 15 deg", 25, 40, 0, 0, 15, "")};
    for (const std::vector<LevelPair>& more : {nrel_pairs(), element_pairs()})
        pairs.insert(pairs.end(), more.begin(), more.end());
    return pairs;
}

const LevelPair& pair_of_case(const std::string& name) {
    static const std::vector<LevelPair> pairs = all_pairs();
    const auto pair = std::ranges::find_if(pairs, [&](const LevelPair& p) {
        return !p.elements.empty() && name.starts_with(p.elements);
    });
    REQUIRE(pair != pairs.end());
    return *pair;
}

std::unique_ptr<const MeshStiffness> model(const LevelPair& pair, FoundationModel foundation,
                                           Contact contact) {
    return std::make_unique<CoupledMesh>(
        pair.geometry, pair.material, pair.profile,
        CoupledMeshOptions{foundation, contact, pair.held_1_m, pair.held_2_m, pair.force_N});
}

double model_mean(const LevelPair& pair, FoundationModel foundation, Contact contact) {
    return mean_total(*model(pair, foundation, contact));
}

double untwisted_ring_mean(const LevelPair& pair) {
    const auto mesh = model(pair, FoundationModel::elastic_ring, Contact::linear);
    const double compliance = twist_compliance(pair);
    constexpr int kPhases = 1000;
    double sum = 0;
    for (int i = 0; i < kPhases; ++i)
        sum += without(total_at(*mesh, (i + 0.5) / kPhases), compliance);
    return sum / kPhases;
}

double elements_mean(const LevelPair& pair) {
    return pair.elements.empty() ? 0 : mean_of_rows(pair, 0);
}

double untwisted_elements_mean(const LevelPair& pair) {
    return pair.elements.empty() ? 0 : mean_of_rows(pair, twist_compliance(pair));
}

double twist_compliance(const LevelPair& pair) {
    return twist(pair.geometry.gear(1), pair.held_1_m, pair.material) +
           twist(pair.geometry.gear(2), pair.held_2_m, pair.material);
}

}  // namespace mesh_level
