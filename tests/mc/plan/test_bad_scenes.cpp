// Checks that keys invalid for a kind of gearbox, degrees of freedom, profile or fault are refused
// when a study is read.
#include "mc/study/study.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_problems.hpp"
#include "tests/test.hpp"

namespace gearpod::test_bad_scenes {

using mc::format;
using mc::read_study_text;
using namespace tests;

struct BadScene {
    const std::string& study;
    const char* from;
    const char* to;
    const char* key;    // named by the single problem
    const char* words;  // in the problem or in the remedy
};

const BadScene kBadScenes[] = {
    // Keys of the other kind of gearbox.
    {kFixedShaftStudy, "[effects]", "planets = 3\n[effects]", "gearbox.planets",
     "is not allowed here (only for gearbox.kind = \"planetary\"); remove it"},
    {kFixedShaftStudy, "[operation]", "[operation]\nfixed = \"ring\"", "operation.fixed",
     "only for gearbox.kind = \"planetary\""},
    {kFixedShaftStudy, "[operation]", "[operation]\ncarrier_speed_rpm = 10",
     "operation.carrier_speed_rpm", "only for gearbox.kind = \"planetary\""},
    {kFixedShaftStudy, "[effects]", "[effects]\ninertial_terms = true", "effects.inertial_terms",
     "only for gearbox.kind = \"planetary\""},
    {kFixedShaftStudy, "[effects]", "[effects]\npath = \"hamming\"", "effects.path",
     "is on a bearing"},
    {kFixedShaftStudy, "[sensor]", "[sensor]\npath_exponent = 0.1", "sensor.path_exponent",
     "only for gearbox.kind = \"planetary\""},
    {kFixedShaftStudy, "pinion_speed_rpm = 1800\n", "", "operation.pinion_speed_rpm", "missing"},
    {kFixedShaftStudy, "gear.teeth = 48\n", "", "gearbox.gear.teeth", "missing"},
    {kFixedShaftStudy, "module_mm = 3.175\n", "", "gearbox.module_mm",
     "missing (gearbox.kind is \"fixed-shaft\")"},
    {kFixedShaftStudy, "motor_inertia_kg_m2 = 0.0021\n", "", "gearbox.motor_inertia_kg_m2",
     "missing"},
    {kFixedShaftStudy, "\"fixed-shaft\"\npinion", "\"fixed-shft\"\npinion", "gearbox.kind",
     "did you mean fixed-shaft?"},
    {kFixedShaftStudy, "gear.teeth = 48", "gear.teeth = 3", "gearbox.gear.teeth",
     "the gear is not possible"},
    {kExampleStudy, "[operation]", "[operation]\npinion_speed_rpm = 10",
     "operation.pinion_speed_rpm", "only for gearbox.kind = \"fixed-shaft\""},
    {kExampleStudy, "[sensor]", "[sensor]\nposition = \"gear\"", "sensor.position",
     "only for gearbox.kind = \"fixed-shaft\""},
    {kExampleStudy, "[operation]", "[effects]\npath = \"none\"\n[operation]", "effects.path",
     "use path = \"rectangular\""},
    // Faults that are impossible for the gearbox, the tooth or the profile.
    {kFixedShaftStudy, "member = \"pinion\"", "member = \"planet\"\nside = \"sun\"", "fault.member",
     "which a fixed-shaft gearbox does not have; use \"pinion\" or \"gear\""},
    {kExampleStudy, "member = \"planet\"\nside = \"ring\"", "member = \"gear\"", "fault.member",
     "is \"gear\", which a planetary gearbox does not have"},
    {kExampleStudy, "member = \"planet\"", "member = \"gear\"", "fault.member",
     "is \"gear\", which a planetary gearbox does not have"},
    {kFixedShaftStudy, "chip_mm = 8", "chip_mm = 17", "fault.chip_mm",
     "17 mm is wider than the face, 16 mm; stay at or below 16 mm"},
    {kFixedShaftStudy, "chip_height_mm = 2", "chip_height_mm = 9", "fault.chip_height_mm",
     "removes the whole tooth"},
    {kFixedShaftStudy, "chip_mm = 8\n", "", "fault.chip_mm", "missing (fault.kind is \"chip\")"},
    {kFixedShaftStudy, "chip_mm = 8", "chip_mm = 8\ndepth_mm = 1", "fault.depth_mm",
     "only for fault.kind = \"crack\""},
    {kFixedShaftStudy, "chip_mm = 8", "chip_mm = 8\nangle_deg = 45", "fault.angle_deg",
     "only for fault.kind = \"crack\" or \"spatial-crack\""},
    {kExampleStudy, "side = \"ring\"", "side = \"both\"", "fault.side",
     "is \"both\", but a crack is on one flank"},
    {kQuasiStaticStudy, "values = [0, 0.1, 0.2, 0.3]", "values = [0, 1.1]",
     "random.fault.reduction", "reduction must be between 0 and 1"},
    {kQuasiStaticStudy, "side = \"both\"\n", "", "fault.side",
     "missing (fault.member is \"planet\")"},
    {kSpatialCrackStudy, "growth_length_mm = [6, 12, 18, 18, 18]",
     "growth_length_mm = [6, 12, 18, 18, 19]", "fault.growth_length_mm",
     "stage 5: 19 mm is longer than the face width, 18 mm"},
    {kSpatialCrackStudy, "growth_depth_mm = [0.5, 1, 1.5, 2, 2]",
     "growth_depth_mm = [0.5, 1, 1.5, 2, 9]", "fault.growth_depth_mm",
     "stage 5: 9 mm is deeper than the tooth"},
    {kSpatialCrackStudy, "growth_depth_mm = [0.5, 1, 1.5, 2, 2]",
     "growth_depth_mm = [0, 1, 1.5, 2, 2]", "fault.growth_depth_mm", "must be > 0, but is 0"},
    {kSpatialCrackStudy, "growth_depth_mm = [0.5, 1, 1.5, 2, 2]",
     "growth_depth_mm = [0.5, 1, 1.5, 1, 2]", "fault.growth_depth_mm", "a crack does not shrink"},
    {kSpatialCrackStudy, "growth_height_mm = [0.5, 0.5, 0.5, 0.5, 0.5]",
     "growth_height_mm = [0.5, 0.5]", "fault.growth_height_mm",
     "has 2 entries, but growth_depth_mm has 5"},
    {kSpatialCrackStudy, "growth_end_height_mm = [2, 2, 2, 2, 2]",
     "growth_end_height_mm = [2, 2, 2, 2, 5]", "fault.growth_end_height_mm",
     "stage 5: 5 mm is above the tip"},
    {kSpatialCrackStudy, "growth_end_depth_mm = [0, 0, 0, 1, 2]",
     "growth_end_depth_mm = [0, 1, 1, 1, 2]", "fault.growth_end_depth_mm",
     "stage 2 has an end depth, but its length of 12 mm does not reach"},
    {kSpatialCrackStudy, "stage = 5", "stage = 5.5", "fault.stage",
     "5.5 is beyond the last of the 5 stages of growth; stay at or below 5"},
    {kSpatialCrackStudy, "end_angle_deg = 90", "end_angle_deg = 91", "fault.end_angle_deg",
     "must be > 0 and <= 90"},
    {kSpatialCrackStudy, "[sensor]", "[detection]\nsize_edges_mm = [0, 1]\n[sensor]",
     "detection.size_edges_mm", "the fault's size is a pure number: use size_edges"},
    {kSpatialCrackStudy, "[sensor]", "[detection]\nsize_edges = [0, 1]\n[sensor]",
     "detection.size_edges", "fault.stage is not continuous"},
    // Profiles and effects that exclude one another.
    {kQuasiStaticStudy,
     "kind = \"reduction\"\nmember = \"planet\"\nside = \"both\"\n[random]\n"
     "fault.reduction = { distribution = \"levels\", values = [0, 0.1, 0.2, "
     "0.3] }",
     "kind = \"crack\"\nmember = \"sun\"\ndepth_mm = 1\n[random]", "fault.kind",
     "a crack needs the shape of its tooth (gearbox.tooth_profile is \"square-wave\"); use "
     "fault.kind = \"reduction\""},
    {kQuasiStaticStudy, "[effects]", "[effects]\nfoundation = \"sainsot\"", "effects.foundation",
     "the stiffness is given, not computed from the teeth"},
    {kQuasiStaticStudy, "sun_planet.low_stiffness_N_m = 1.2e9",
     "sun_planet.low_stiffness_N_m = 3e9", "gearbox.sun_planet.low_stiffness_N_m",
     "is above the high stiffness"},
    {kQuasiStaticStudy, "sun_planet.contact_ratio = 1.5\n", "", "gearbox.sun_planet.contact_ratio",
     "missing (gearbox.tooth_profile is \"square-wave\")"},
    {kQuasiStaticStudy, "ring.teeth = 68", "ring.teeth = 66", "gearbox.ring.teeth",
     "cannot be assembled"},
    {kQuasiStaticStudy, "[0, 90, 180]", "[0, 90]", "gearbox.planet_positions_deg",
     "has 2 positions, but there are 3 planets"},
    {kQuasiStaticStudy, "[0, 90, 180]", "[0, 90, 181]", "gearbox.planet_positions_deg",
     "a planet at 181 deg does not mesh"},
    {kQuasiStaticStudy, "[0, 90, 180]", "[90, 180, 270]", "gearbox.planet_positions_deg",
     "does not begin with 0"},
    {kQuasiStaticStudy, "[0, 90, 180]", "[0, 180, 90]", "gearbox.planet_positions_deg",
     "must ascend"},
    {kQuasiStaticStudy, "[sensor]", "[sensor]\nsampling_Hz = 5000", "sensor.sampling_Hz",
     "a quasi-static gearbox has no accelerations"},
    {kQuasiStaticStudy, "[random]",
     "[random]\nsensor.noise_m_s2 = { distribution = \"constant\", "
     "value = 1 }",
     "sensor.noise_m_s2", "a quasi-static gearbox has no accelerations"},
    {kQuasiStaticStudy, "[sensor]", "[features]\nuse = [\"te_rms\", \"window_z\"]\n[sensor]",
     "features.use", "\"window_z\" needs the sensor"},
    {kQuasiStaticStudy, "[sensor]", "[numerics]\nintegrator = \"rk4\"\n[sensor]",
     "numerics.integrator", "is not integrated in time"},
    {kFixedShaftStudy, "[effects]", "[effects]\nmotion = \"torsional\"", "effects.motion",
     "gears move on their bearings"},
    {kQuasiStaticStudy, "motion = \"quasi-static-torsional\"",
     "motion = \"quasi-static-torsional\"\npath = \"hann\"", "effects.path",
     "a quasi-static gearbox has no accelerations"},
    {kQuasiStaticStudy, "motion = \"quasi-static-torsional\"", "motion = \"quasistatic\"",
     "effects.motion", "did you mean quasi-static?"},
    {kSpatialCrackStudy, "sun.bore_mm = 20\n", "", "gearbox.sun.bore_mm",
     "missing (effects.foundation is not \"none\")"},
    {kSpatialCrackStudy, "sun.bore_mm = 20", "sun.bore_mm = 52", "gearbox.sun.bore_mm",
     "52 mm leaves no body under the teeth (the root circle's diameter is 51 mm)"},
    {kSpatialCrackStudy, "ring.outer_mm = 230", "ring.outer_mm = 197", "gearbox.ring.outer_mm",
     "give a larger outer diameter"},
    {kSpatialCrackStudy, "planet.bore_mm = 24", "planet.bore_mm = 24\nplanet.rim_mm = 4",
     "gearbox.planet.web_mm", "missing (gearbox.planet.rim_mm is given)"},
    {kSpatialCrackStudy, "sun.bore_mm = 20", "sun.bore_mm = 20\nsun_rim_mm = 4",
     "gearbox.sun_rim_mm", "was removed"},
    {kSpatialCrackStudy, "planet.bore_mm = 24", "planet.bore_mm = 24\nplanet.web_mm = 6",
     "gearbox.planet.rim_mm", "missing (gearbox.planet.web_mm is given)"},
    {kSpatialCrackStudy, "planet.bore_mm = 24",
     "planet.bore_mm = 24\nplanet.rim_mm = 20\nplanet.web_mm = 6", "gearbox.planet.rim_mm",
     "20 mm leaves no room for the web (the gear body is 19.5 mm thick"},
    {kExampleStudy, "[operation]", "planet.rim_mm = 4\n[operation]", "gearbox.planet.rim_mm",
     "only for elastic gear bodies, but effects.foundation is \"none\""},
    {kSpatialCrackStudy, "backlash_mm = 0.1\n", "", "gearbox.backlash_mm",
     "missing (effects.separation is \"two-sided\")"},
    {kSpatialCrackStudy, "separation = \"two-sided\"", "separation = \"one-sided\"",
     "gearbox.backlash_mm", "only for effects.separation = \"two-sided\""},
    {kSpatialCrackStudy, "ring_planet.error_phase_deg = [0, 90]",
     "ring_planet.error_phase_deg = [0]", "gearbox.ring_planet.error_phase_deg",
     "has 1 phases for 2 amplitudes in error_um"},
    {kSpatialCrackStudy, "sun_planet.error_um = [10, 2]", "sun_planet.error_um = [10, -2]",
     "gearbox.sun_planet.error_um", "must be >= 0, but is -2"},
    {kSpatialCrackStudy, "horizon = \"full\"", "horizon = \"periodic\"", "numerics.horizon",
     "is \"periodic\", but every tooth has individual errors"},
    {kSpatialCrackStudy, "pitch_error_um = 3", "tooth_quality = 13", "gearbox.tooth_quality",
     "must be between 0 and 12"},
    {kSpatialCrackStudy, "pitch_error_um = 3", "gear.quality = 6", "gearbox.gear.quality",
     "only for gearbox.kind = \"fixed-shaft\""},
    {kSpatialCrackStudy, "pitch_error_um = 3", "sun.index_um = [1, 2, 3]", "gearbox.sun.index_um",
     "has 3 deviations for 28 teeth"},
    {kSpatialCrackStudy, "pitch_error_um = 3", "planet.ring_side_index_um = [1, 2, 3]",
     "gearbox.planet.ring_side_index_um", "has 3 deviations for 136 teeth"},
    {kSpatialCrackStudy, "pitch_error_um = 3", "pin_radial_um = [1, 2, 3]", "gearbox.pin_radial_um",
     "has 3 values, but there are 4 planets"},
    {kSpatialCrackStudy, "pitch_error_um = 3", "planet_mass_factors = [1, 0, 1, 1]",
     "gearbox.planet_mass_factors", "was removed"},
    {kSpatialCrackStudy, "separation = \"two-sided\"",
     "separation = \"two-sided\"\nmotion = \"torsional\"\n[random]\n"
     "gearbox.pin_radial_rms_um = { distribution = \"constant\", value = 1 }",
     "gearbox.pin_radial_rms_um", "the bearings of this model are rigid"},
    {kSpatialCrackStudy, "integrator = \"newmark\"", "integrator = \"newmak\"",
     "numerics.integrator", "did you mean newmark?"},
    // Tones.
    {kFixedShaftStudy, "[sensor]", "[sensor]\ntones = 3", "sensor.tones",
     "must be a list of tones, but is an integer"},
    {kFixedShaftStudy, "[sensor]",
     "[sensor]\ntones = [{ frequency_Hz = 5, amplitude_m_s2 = 1 }, 3]", "sensor.tones",
     "tone 2 must be a table, but is an integer"},
    {kFixedShaftStudy, "[sensor]", "[sensor]\ntones = [{ frequency_Hz = 5, amplitude_ms2 = 1 }]",
     "sensor.tones", "tone 1: unknown key amplitude_ms2; did you mean amplitude_m_s2?"},
    {kFixedShaftStudy, "[sensor]", "[sensor]\ntones = [{ frequency_Hz = 5 }]", "sensor.tones",
     "tone 1 has no amplitude_m_s2"},
    {kFixedShaftStudy, "[sensor]",
     "[sensor]\ntones = [{ frequency_Hz = \"a\", amplitude_m_s2 = 1 }]", "sensor.tones",
     "tone 1: frequency_Hz must be a number, but is a string"},
    {kFixedShaftStudy, "[sensor]", "[sensor]\ntones = [{ frequency_Hz = -1, amplitude_m_s2 = 1 }]",
     "sensor.tones", "tone 1: frequency_Hz must be > 0 and finite, but is -1"},
    {kFixedShaftStudy, "[sensor]",
     "[sensor]\ntones = [{ frequency_Hz = 30000, amplitude_m_s2 = 1 }]", "sensor.tones",
     "tone 1: 30000 Hz must be below"},
    // Inputs that must not be random.
    {kQuasiStaticStudy, "[random]",
     "[random]\ngearbox.helix_angle_deg = { distribution = \"constant\", value = 1 }",
     "random.gearbox.helix_angle_deg", "may not be random (it defines the teeth"},
    {kSpatialCrackStudy, "[sensor]",
     "[random]\ngearbox.sun_planet.error_um = { distribution = \"constant\", value = 1 }\n[sensor]",
     "random.gearbox.sun_planet.error_um", "may not be random (it is not a number)"},
    {kFixedShaftStudy, "[sensor]",
     "[random]\nfault.chip_height_mm = { distribution = \"constant\", value = 1 }\n[sensor]",
     "random.fault.chip_height_mm", "only the size of a fault may be random"},
};

// The pinion of Tian's gearbox with a band of pits at that radius.
std::string pitted(double radius_mm) {
    return replaced(kFixedShaftStudy,
                    "kind = \"chip\"\nmember = \"pinion\"\nchip_mm = 8\n"
                    "chip_height_mm = 2",
                    "kind = \"pitting\"\nmember = \"pinion\"\npit_width_mm = 4\npit_length_mm = 1\n"
                    "pit_depth_mm = 0.1\npit_radius_mm = " +
                        std::to_string(radius_mm));
}

TEST_CASE("The scenes from which invalid ones are made are valid") {
    for (const std::string& text : {kFixedShaftStudy, kQuasiStaticStudy, kSpatialCrackStudy}) {
        const auto reading = read_study_text(text, "good.toml");
        INFO(format(reading.problems));
        CHECK(reading.study.has_value());
    }
}

TEST_CASE("Each invalid scene is refused with one message on its key") {
    for (const BadScene& bad : kBadScenes) {
        const std::string text = replaced(bad.study, bad.from, bad.to);
        INFO(bad.from << " -> " << bad.to);
        REQUIRE_FALSE(text.empty());
        const auto reading = read_study_text(text, "bad.toml");
        INFO(format(reading.problems));
        CHECK_FALSE(reading.study.has_value());
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].key == bad.key);
        CHECK(reading.problems[0].line > 0);
        CHECK(mentions(reading.problems[0], bad.words));
    }
}

TEST_CASE("A pitted band is refused outside the contact with the mating flank") {
    // Dimensions of Tian's 19/48 pair in mm: tips 3.175 from the pitch circles. The gear's tip
    // meets the pinion where the line of action, (r1 + r2) sin a long between the base circles, is
    // sqrt(ra2^2 - rb2^2) from the gear's end.
    const double a = M_PI / 9, r1 = 0.5 * 3.175 * 19, r2 = 0.5 * 3.175 * 48;
    const double tip2 = r2 + 3.175, base1 = r1 * std::cos(a), base2 = r2 * std::cos(a);
    const double left = (r1 + r2) * std::sin(a) - std::sqrt(tip2 * tip2 - base2 * base2);
    const double low = std::hypot(base1, left), high = r1 + 3.175;
    CHECK(read_study_text(pitted(low + 0.51), "good.toml").study);
    CHECK(read_study_text(pitted(high - 0.51), "good.toml").study);
    for (const double radius : {low + 0.49, high - 0.49}) {
        const auto reading = read_study_text(pitted(radius), "bad.toml");
        INFO(format(reading.problems));
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].key == "fault.pit_radius_mm");
        CHECK(mentions(reading.problems[0], "extends beyond the active flank"));
    }
}

}  // namespace gearpod::test_bad_scenes
