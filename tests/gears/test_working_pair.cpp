// Checks the geometry of shifted gears against published sets, to the printed digits.
#include "gears/mesh_geometry.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_working_pair {

constexpr double kDegree = std::numbers::pi / 180;

Gear standard(int teeth, double module_mm, double angle_deg = 20) {
    return {std::abs(teeth), teeth < 0, 1e-3 * module_mm, angle_deg * kDegree};
}

Gear with(Gear gear, double shift, double shortening = 0) {
    gear.profile_shift = shift;
    gear.tip_shortening = shortening;
    return gear;
}

// A gear pair as on a drawing; lengths in mm.
struct Set {
    Set(Gear one, Gear two, SpecifiedShifts specified)
        : shifts(working_shifts(one, two, nullptr, specified)),
          mesh(with(one, shifts.first, shifts.tip_shortening),
               with(two, shifts.second, shifts.tip_shortening), shifts.centre_distance_m) {}
    double angle() const { return mesh.working_pressure_angle() / kDegree; }
    double tip(int which) const { return 2e3 * mesh.gear(which).tip_radius(); }
    double root(int which) const { return 2e3 * mesh.gear(which).root_radius(); }
    double working(int which) const { return 2e3 * mesh.working_pitch_radius(which); }

    WorkingShifts shifts;
    MeshGeometry mesh;
};

// Diameters of both gears in mm: working, tip and root circles.
void check_diameters(const Set& set, std::pair<double, double> working, double last_working,
                     std::pair<double, double> tip, std::pair<double, double> root, double last) {
    CHECK(set.working(1) == Approx(working.first).margin(last_working));
    CHECK(set.working(2) == Approx(working.second).margin(last_working));
    CHECK(set.tip(1) == Approx(tip.first).margin(last));
    CHECK(set.tip(2) == Approx(tip.second).margin(last));
    CHECK(set.root(1) == Approx(root.first).margin(last));
    CHECK(set.root(2) == Approx(root.second).margin(last));
}

// A planetary stage defined by its sun's shift and the centre distance.
struct Stage {
    Stage(int sun, int planet, int ring, double module_mm, double sun_shift, double distance_mm)
        : shifts(shifts_of(sun, planet, ring, module_mm, sun_shift, distance_mm)),
          sun_mesh(gear(sun, module_mm, shifts.first), gear(planet, module_mm, shifts.second),
                   shifts.centre_distance_m),
          ring_mesh(gear(planet, module_mm, shifts.second),
                    with(standard(-ring, module_mm), shifts.ring), shifts.centre_distance_m) {}
    static WorkingShifts shifts_of(int sun, int planet, int ring, double module_mm,
                                   double sun_shift, double distance_mm) {
        const Gear outer = standard(-ring, module_mm);
        return working_shifts(standard(sun, module_mm), standard(planet, module_mm), &outer,
                              {sun_shift, {}, {}, 1e-3 * distance_mm});
    }
    Gear gear(int teeth, double module_mm, double shift) const {
        return with(standard(teeth, module_mm), shift, shifts.tip_shortening);
    }

    WorkingShifts shifts;
    MeshGeometry sun_mesh, ring_mesh;
};

double thickness_mm(const Gear& gear) {
    return 1e3 * gear.thickness_at(gear.tip_radius());
}

// Tolerance for KISSsoft's three decimals, the last of which is not always rounded.
constexpr double kLast = 1e-3;

double contact_diameter_mm(const MeshGeometry& mesh, int which, double tau) {
    return 2e3 * mesh.contact_radius(which, tau);
}

// Source: KHK gear technical reference, calculation of a profile shifted spur gear (1), a =
// 56.4999.
TEST_CASE("a pair of 12 and 24 teeth shifted by 0.6 and 0.36 matches KHK's") {
    const Set set(standard(12, 3), standard(24, 3), {0.6, 0.36});
    CHECK(set.angle() == Approx(26.0886).margin(5e-5));
    CHECK(involute(set.mesh.working_pressure_angle()) == Approx(0.034316).margin(5e-7));
    CHECK(1e3 * set.mesh.centre_distance() == Approx(56.4999).margin(5e-5));
    check_diameters(set, {37.667, 75.333}, 5e-4, {44.840, 79.400}, {32.100, 66.660}, 5e-4);
    CHECK(set.mesh.backlash() == Approx(0).margin(1e-15));
}

// Source: bolsover.com, utilities for Alibre, profile shifted external spur gears.
TEST_CASE("12 and 24 teeth at a centre distance of 56.5 mm have a contact ratio of 1.202") {
    const Set set(standard(12, 3), standard(24, 3), {0.6, {}, {}, 56.5e-3});
    CHECK(set.shifts.first + set.shifts.second == Approx(0.960).margin(5e-4));
    CHECK(set.angle() == Approx(26.0888).margin(5e-5));
    CHECK(set.mesh.contact_ratio() == Approx(1.202).margin(5e-4));
    CHECK(2e3 * set.mesh.gear(1).base_radius() == Approx(33.8289).margin(5e-5));
    CHECK(2e3 * set.mesh.gear(2).base_radius() == Approx(67.6579).margin(5e-5));
}

// Source: KHK gear technical reference (SDP/SI, T-42), calculation of a profile shifted internal
// gear (1): x_2 = 0.5 in its convention, in which an internal gear's shift moves its teeth
// outwards.
TEST_CASE("16 teeth in an internal gear of 24 match KHK's") {
    const Gear pinion = standard(16, 3), ring = with(standard(-24, 3), -0.5);
    CHECK(tight_working_angle(pinion, ring) / kDegree == Approx(31.0937).margin(5e-5));
    CHECK(involute(tight_working_angle(pinion, ring)) == Approx(0.060401).margin(5e-7));
    CHECK(1e3 * tight_centre_distance(pinion, ring) == Approx(13.1683).margin(5e-5));
    CHECK(2e3 * pinion.tip_radius() == Approx(54.000).margin(5e-4));
    CHECK(2e3 * ring.tip_radius() == Approx(69.000).margin(5e-4));
    CHECK(2e3 * pinion.root_radius() == Approx(40.500).margin(5e-4));
    CHECK(2e3 * ring.root_radius() == Approx(82.500).margin(5e-4));
}

// Source: a calculation sheet after ISO 21771, Eq. 62: helical gears of 31 and 30 teeth, m_n = 3.5
// mm, in their transverse plane.
TEST_CASE("31 and 30 helical teeth at 116.5 mm require the sum of shifts of ISO 21771") {
    const double module = 2 * 114.3447280708 / 61;
    const Gear one = standard(31, module, 21.2990642859), two = standard(30, module, 21.2990642859);
    CHECK(involute(one.pressure_angle_rad) == Approx(0.01812609488).epsilon(1e-9));
    const double angle = working_angle_at(one, two, 116.5e-3);
    CHECK(angle / kDegree == Approx(23.8707609654).epsilon(1e-11));
    CHECK(involute(angle) == Approx(0.0259052382).epsilon(2e-9));
    CHECK(tight_shift_sum(one, two, 116.5e-3) * module / 3.5 == Approx(0.6518771312).epsilon(1e-8));
}

// Source: KHK gear technical reference, calculation of a profile shifted helical gear in the normal
// system: m_n = 3 mm, helix 30 degrees. KHK truncates decimals.
TEST_CASE("12 and 60 helical teeth shifted by 0.09809 in the normal plane match KHK's") {
    const double c = std::cos(30 * kDegree);
    const auto helical = [&](int teeth) {
        Gear gear = standard(teeth, 3 / c, std::atan(std::tan(20 * kDegree) / c) / kDegree);
        gear.addendum_coefficient = c;
        gear.dedendum_coefficient = 1.25 * c;
        return gear;
    };
    const Set set(helical(12), helical(60), {0.09809 * c, 0});
    CHECK(set.mesh.gear(1).pressure_angle_rad / kDegree == Approx(22.79588).margin(5e-6));
    CHECK(involute(set.mesh.working_pressure_angle()) == Approx(0.023405).margin(5e-7));
    CHECK(set.angle() == Approx(23.1126).margin(5e-5));
    CHECK(1e3 * set.mesh.centre_distance() == Approx(125.000).margin(5e-4));
    CHECK(2e3 * set.mesh.gear(1).pitch_radius() == Approx(41.569).margin(kLast));
    CHECK(2e3 * set.mesh.gear(2).pitch_radius() == Approx(207.846).margin(kLast));
    CHECK(2e3 * set.mesh.gear(1).base_radius() == Approx(38.322).margin(kLast));
    CHECK(2e3 * set.mesh.gear(2).base_radius() == Approx(191.611).margin(kLast));
    check_diameters(set, {41.667, 208.333}, kLast, {48.153, 213.842}, {34.657, 200.346}, kLast);
}

// Source: the same in the transverse system: m_t = 3 mm, 20 degrees in the transverse plane.
TEST_CASE("12 and 60 helical teeth shifted by 0.34462 in the transverse plane match KHK's") {
    const Set set(standard(12, 3), standard(60, 3), {0.34462, 0});
    CHECK(involute(set.mesh.working_pressure_angle()) == Approx(0.0183886).margin(5e-8));
    CHECK(set.angle() == Approx(21.3975).margin(5e-5));
    CHECK(1e3 * set.mesh.centre_distance() == Approx(109.0000).margin(5e-5));
    CHECK(2e3 * set.mesh.gear(1).base_radius() == Approx(33.8289).margin(5e-5));
    CHECK(2e3 * set.mesh.gear(2).base_radius() == Approx(169.1447).margin(5e-5));
    check_diameters(set, {36.3333, 181.6667}, 5e-5, {44.000, 185.932}, {30.568, 172.500}, 5e-4);
}

// Source: FVA information sheet 2/IV, FZG test gears, type C.
TEST_CASE("FZG's test gears of type C work at 22.44 degrees") {
    const Set set(standard(16, 4.5), standard(24, 4.5), {0.1817, 0.1715, {}, 91.5e-3});
    CHECK(set.angle() == Approx(22.44).margin(5e-3));
    CHECK(set.tip(1) == Approx(82.46).margin(5e-3));
    CHECK(set.tip(2) == Approx(118.36).margin(5e-3));
    CHECK(set.working(1) == Approx(73.2).margin(5e-2));
    CHECK(set.working(2) == Approx(109.8).margin(5e-2));
    CHECK(set.mesh.contact_ratio() == Approx(1.44).margin(5e-3));
}

// Source: Kos, Analysis of planetary transmissions (University of Ljubljana, LECAD): test run.
TEST_CASE("a stage of 21, 43 and 108 teeth matches Ljubljana's") {
    const Stage stage(21, 43, 108, 1.75, 0.4380, 56.8);
    CHECK(stage.shifts.second == Approx(0.0426).margin(5e-5));
    CHECK(stage.shifts.ring == Approx(0.0000).margin(5e-5));
    const Gear &sun = stage.sun_mesh.gear(1), &planet = stage.sun_mesh.gear(2);
    // The sun's shift has four digits, which leaves an error of 2e-4.
    CHECK(2e3 * sun.tip_radius() == Approx(41.7008).margin(2e-4));
    CHECK(2e3 * planet.tip_radius() == Approx(78.8170).margin(2e-4));
    // The span over k teeth, W_k: k - 1 base pitches and a tooth on the base circle.
    const double pitch = std::numbers::pi * 1.75 * std::cos(20 * kDegree);
    CHECK(2 * pitch + 1e3 * sun.thickness_at(sun.base_radius()) == Approx(13.9546).margin(1e-4));
    CHECK(4 * pitch + 1e3 * planet.thickness_at(planet.base_radius()) ==
          Approx(24.3530).margin(1e-4));
}

// Source: KISSsoft 03/2017 reports on the stages of the NREL 5 MW reference gearbox (Nejad et al.
// 2016), kept in the repository gfsReboucas/Drivetrain.
TEST_CASE("the first stage of a 5 MW wind turbine, 19/17/56 teeth, matches KISSsoft's") {
    const Stage stage(19, 17, 56, 45, 0.617, 863);
    const MeshGeometry &sun = stage.sun_mesh, &ring = stage.ring_mesh;
    CHECK(sun.working_pressure_angle() / kDegree == Approx(28.118).margin(kLast));
    CHECK(ring.working_pressure_angle() / kDegree == Approx(17.161).margin(kLast));
    CHECK(stage.shifts.second == Approx(0.8021).margin(5e-5));
    CHECK(stage.shifts.ring == Approx(-0.5013).margin(5e-5));
    CHECK(45 * stage.shifts.tip_shortening == Approx(10.861).margin(kLast));
    CHECK(2e3 * sun.gear(1).tip_radius() == Approx(978.808).margin(kLast));
    CHECK(2e3 * sun.gear(2).tip_radius() == Approx(905.470).margin(kLast));
    CHECK(2e3 * ring.gear(2).tip_radius() == Approx(2475.118).margin(kLast));
    CHECK(2e3 * sun.gear(2).root_radius() == Approx(724.692).margin(kLast));
    CHECK(2e3 * ring.gear(2).root_radius() == Approx(2677.618).margin(kLast));
    CHECK(2e3 * sun.working_pitch_radius(1) == Approx(910.944).margin(kLast));
    CHECK(2e3 * sun.working_pitch_radius(2) == Approx(815.056).margin(kLast));
    CHECK(2e3 * ring.working_pitch_radius(1) == Approx(752.359).margin(kLast));
    CHECK(2e3 * ring.working_pitch_radius(2) == Approx(2478.359).margin(kLast));
    CHECK(1e3 * sun.tip_clearance(1) == Approx(11.250).margin(kLast));
    CHECK(1e3 * ring.tip_clearance(1) == Approx(23.074).margin(kLast));
    CHECK(1e3 * ring.tip_clearance(2) == Approx(12.213).margin(kLast));
    CHECK(sun.contact_ratio() == Approx(1.115).margin(kLast));
    CHECK(ring.contact_ratio() == Approx(1.278).margin(kLast));
    // Start and end of tip contact, d_Nf, and of single contact, d_B and d_D.
    CHECK(contact_diameter_mm(sun, 1, 0) == Approx(845.350).margin(kLast));
    CHECK(contact_diameter_mm(sun, 2, sun.contact_ratio()) == Approx(762.541).margin(kLast));
    CHECK(contact_diameter_mm(ring, 1, 0) == Approx(749.170).margin(kLast));
    CHECK(contact_diameter_mm(ring, 2, ring.contact_ratio()) == Approx(2594.369).margin(kLast));
    CHECK(contact_diameter_mm(sun, 1, 1) == Approx(961.716).margin(kLast));
    CHECK(contact_diameter_mm(sun, 2, 1) == Approx(773.248).margin(kLast));
    CHECK(contact_diameter_mm(ring, 1, 1) == Approx(862.513).margin(kLast));
    CHECK(contact_diameter_mm(ring, 2, 1) == Approx(2565.052).margin(kLast));
    CHECK(thickness_mm(sun.gear(1)) == Approx(32.599).margin(kLast));
    CHECK(thickness_mm(sun.gear(2)) == Approx(26.588).margin(kLast));
    CHECK(thickness_mm(ring.gear(2)) == Approx(38.407).margin(kLast));
    // Root form diameters that a rack of ISO 53, profile A cuts.
    CHECK(2e3 * sun.gear(1).form_radius() == Approx(825.979).margin(kLast));
    CHECK(2e3 * sun.gear(2).form_radius() == Approx(748.795).margin(kLast));
}

TEST_CASE("the second stage of a 5 MW wind turbine, 18/36/93 teeth, matches KISSsoft's") {
    const Stage stage(18, 36, 93, 21, 0.389, 584);
    const MeshGeometry &sun = stage.sun_mesh, &ring = stage.ring_mesh;
    CHECK(sun.working_pressure_angle() / kDegree == Approx(24.169).margin(kLast));
    CHECK(ring.working_pressure_angle() / kDegree == Approx(15.630).margin(kLast));
    CHECK(stage.shifts.first + stage.shifts.second == Approx(0.8929).margin(5e-5));
    CHECK(stage.shifts.second == Approx(0.5039).margin(5e-5));
    CHECK(stage.shifts.ring == Approx(0.1171).margin(5e-5));
    CHECK(2e3 * sun.gear(1).tip_radius() == Approx(432.838).margin(kLast));
    CHECK(2e3 * sun.gear(2).tip_radius() == Approx(815.663).margin(kLast));
    CHECK(2e3 * ring.gear(2).tip_radius() == Approx(1906.081).margin(kLast));
    CHECK(1e3 * ring.tip_clearance(1) == Approx(8.459).margin(kLast));
    CHECK(1e3 * ring.tip_clearance(2) == Approx(6.709).margin(kLast));
    CHECK(sun.contact_ratio() == Approx(1.370).margin(kLast));
    CHECK(ring.contact_ratio() == Approx(1.618).margin(kLast));
    CHECK(contact_diameter_mm(sun, 1, 0) == Approx(363.547).margin(kLast));
    CHECK(contact_diameter_mm(ring, 1, 0) == Approx(738.082).margin(kLast));
    CHECK(contact_diameter_mm(ring, 2, ring.contact_ratio()) == Approx(1969.750).margin(kLast));
    CHECK(thickness_mm(sun.gear(1)) == Approx(12.910).margin(kLast));
    CHECK(thickness_mm(sun.gear(2)) == Approx(14.858).margin(kLast));
    CHECK(thickness_mm(ring.gear(2)) == Approx(18.937).margin(kLast));
}

}  // namespace gearpod::gears::test_working_pair
