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

const std::pair<const std::string&, std::vector<BadSettings>> kBadScenes[] = {
    {kFixedShaftStudy,
     {
         // Keys of the other kind of gearbox.
         {"gearbox.planets = 3",
          "is not allowed here (only for gearbox.kind = \"planetary\"); remove it"},
         {"operation.fixed = \"ring\"", "only for gearbox.kind = \"planetary\""},
         {"operation.carrier_speed_rpm = 10", "only for gearbox.kind = \"planetary\""},
         {"effects.inertial_terms = true", "only for gearbox.kind = \"planetary\""},
         {"effects.path = \"hamming\"", "is on a bearing"},
         {"sensor.path_exponent = 0.1", "only for gearbox.kind = \"planetary\""},
         {"operation.pinion_speed_rpm =", "missing"},
         {"gearbox.gear.teeth =", "missing"},
         {"gearbox.module_mm =", "missing (gearbox.kind is \"fixed-shaft\")"},
         {"gearbox.motor_inertia_kg_m2 =", "missing"},
         {"gearbox.kind = \"fixed-shft\"", "did you mean fixed-shaft?"},
         {"gearbox.gear.teeth = 3", "the gear is not possible"},
         // Faults that are impossible for the gearbox, the tooth or the profile.
         {"fault.side = \"sun\"\nfault.member = \"planet\"",
          "which a fixed-shaft gearbox does not have; use \"pinion\" or \"gear\""},
         {"fault.chip_mm = 17", "17 mm is wider than the face, 16 mm; stay at or below 16 mm"},
         {"fault.chip_height_mm = 9", "removes the whole tooth"},
         {"fault.chip_mm =", "missing (fault.kind is \"chip\")"},
         {"fault.depth_mm = 1", "only for fault.kind = \"crack\""},
         {"fault.angle_deg = 45", "only for fault.kind = \"crack\" or \"spatial-crack\""},
         // Profiles and effects that exclude one another.
         {"effects.motion = \"torsional\"", "gears move on their bearings"},
         // Tones.
         {"sensor.tones = 3", "must be a list of tones, but is an integer"},
         {"sensor.tones = [{ frequency_Hz = 5, amplitude_m_s2 = 1 }, 3]",
          "tone 2 must be a table, but is an integer"},
         {"sensor.tones = [{ frequency_Hz = 5, amplitude_ms2 = 1 }]",
          "tone 1: unknown key amplitude_ms2; did you mean amplitude_m_s2?"},
         {"sensor.tones = [{ frequency_Hz = 5 }]", "tone 1 has no amplitude_m_s2"},
         {"sensor.tones = [{ frequency_Hz = \"a\", amplitude_m_s2 = 1 }]",
          "tone 1: frequency_Hz must be a number, but is a string"},
         {"sensor.tones = [{ frequency_Hz = -1, amplitude_m_s2 = 1 }]",
          "tone 1: frequency_Hz must be > 0 and finite, but is -1"},
         {"sensor.tones = [{ frequency_Hz = 30000, amplitude_m_s2 = 1 }]",
          "tone 1: 30000 Hz must be below"},
         // Inputs that must not be random.
         {"random.fault.chip_height_mm = { distribution = \"constant\", value = 1 }",
          "only the size of a fault may be random"},
     }},
    {kExampleStudy,
     {
         // Keys of the other kind of gearbox.
         {"operation.pinion_speed_rpm = 10", "only for gearbox.kind = \"fixed-shaft\""},
         {"sensor.position = \"gear\"", "only for gearbox.kind = \"fixed-shaft\""},
         {"effects.path = \"none\"", "use path = \"rectangular\""},
         // Faults that are impossible for the gearbox, the tooth or the profile.
         {"fault.side =\nfault.member = \"gear\"",
          "is \"gear\", which a planetary gearbox does not have"},
         {"fault.member = \"gear\"", "is \"gear\", which a planetary gearbox does not have"},
         {"fault.side = \"both\"", "is \"both\", but a crack is on one flank"},
         // Profiles and effects that exclude one another.
         {"gearbox.planet.rim_mm = 4",
          "only for elastic gear bodies, but effects.foundation is \"none\""},
     }},
    {kQuasiStaticStudy,
     {
         // Faults that are impossible for the gearbox, the tooth or the profile.
         {"random.fault.reduction = { distribution = \"levels\", values = [0, 1.1] }",
          "reduction must be between 0 and 1"},
         {"fault.side =", "missing (fault.kind is \"reduction\")"},
         // Profiles and effects that exclude one another.
         {"fault.side =\nrandom.fault.reduction =\nfault.member = \"sun\"\nfault.depth_mm = "
          "1\nfault.kind = \"crack\"",
          "a crack needs the shape of its tooth (gearbox.tooth_profile is \"square-wave\"); use "
          "fault.kind = \"reduction\""},
         {"effects.foundation = \"sainsot\"",
          "the stiffness is given, not computed from the teeth"},
         {"gearbox.sun_planet.low_stiffness_N_m = 3e9", "is above the high stiffness"},
         {"gearbox.sun_planet.contact_ratio =",
          "missing (gearbox.tooth_profile is \"square-wave\")"},
         {"gearbox.ring.teeth = 66", "cannot be assembled"},
         {"gearbox.planet_positions_deg = [0, 90]", "has 2 positions, but there are 3 planets"},
         {"gearbox.planet_positions_deg = [0, 90, 181]", "a planet at 181 deg does not mesh"},
         {"gearbox.planet_positions_deg = [90, 180, 270]", "does not begin with 0"},
         {"gearbox.planet_positions_deg = [0, 180, 90]", "must ascend"},
         {"sensor.sampling_Hz = 5000", "a quasi-static gearbox has no accelerations"},
         {"random.sensor.noise_m_s2 = { distribution = \"constant\", value = 1 }",
          "a quasi-static gearbox has no accelerations", "sensor.noise_m_s2"},
         {"features.use = [\"te_rms\", \"window_z\"]", "\"window_z\" needs the sensor"},
         {"numerics.integrator = \"rk4\"", "is not integrated in time"},
         {"effects.path = \"hann\"", "a quasi-static gearbox has no accelerations"},
         {"effects.motion = \"quasistatic\"", "did you mean quasi-static?"},
         // Inputs that must not be random.
         {"random.gearbox.helix_angle_deg = { distribution = \"constant\", value = 1 }",
          "may not be random (it defines the teeth"},
     }},
    {kSpatialCrackStudy,
     {
         // Faults that are impossible for the gearbox, the tooth or the profile.
         {"fault.growth_length_mm = [6, 12, 18, 18, 19]",
          "stage 5: 19 mm is longer than the face width, 18 mm"},
         {"fault.growth_depth_mm = [0.5, 1, 1.5, 2, 9]", "stage 5: 9 mm is deeper than the tooth"},
         {"fault.growth_depth_mm = [0, 1, 1.5, 2, 2]", "must be > 0, but is 0"},
         {"fault.growth_depth_mm = [0.5, 1, 1.5, 1, 2]", "a crack does not shrink"},
         {"fault.growth_height_mm = [0.5, 0.5]", "has 2 entries, but growth_depth_mm has 5"},
         {"fault.growth_end_height_mm = [2, 2, 2, 2, 5]", "stage 5: 5 mm is above the tip"},
         {"fault.growth_end_depth_mm = [0, 1, 1, 1, 2]",
          "stage 2 has an end depth, but its length of 12 mm does not reach"},
         {"fault.stage = 5.5",
          "5.5 is beyond the last of the 5 stages of growth; stay at or below 5"},
         {"fault.end_angle_deg = 91", "must be > 0 and <= 90"},
         {"detection.size_edges_mm = [0, 1]", "the fault's size is a pure number: use size_edges"},
         {"detection.size_edges = [0, 1]", "fault.stage is not continuous"},
         // Profiles and effects that exclude one another.
         {"gearbox.sun.bore_mm =", "missing (effects.foundation is not \"none\")"},
         {"gearbox.sun.bore_mm = 52",
          "52 mm leaves no body under the teeth (the root circle's diameter is 51 mm)"},
         {"gearbox.ring.outer_mm = 197", "give a larger outer diameter"},
         {"gearbox.planet.rim_mm = 4", "missing (gearbox.planet.rim_mm is given)",
          "gearbox.planet.web_mm"},
         {"gearbox.sun_rim_mm = 4", "was removed"},
         {"gearbox.planet.web_mm = 6", "missing (gearbox.planet.web_mm is given)",
          "gearbox.planet.rim_mm"},
         {"gearbox.planet.web_mm = 6\ngearbox.planet.rim_mm = 20",
          "20 mm leaves no room for the web (the gear body is 19.5 mm thick"},
         {"gearbox.backlash_mm =", "missing (effects.separation is \"two-sided\")"},
         {"effects.separation = \"one-sided\"", "only for effects.separation = \"two-sided\"",
          "gearbox.backlash_mm"},
         {"gearbox.ring_planet.error_phase_deg = [0]", "has 1 phases for 2 amplitudes in error_um"},
         {"gearbox.sun_planet.error_um = [10, -2]", "must be >= 0, but is -2"},
         {"numerics.horizon = \"periodic\"",
          "is \"periodic\", but every tooth has individual errors"},
         {"gearbox.pitch_error_um =\ngearbox.tooth_quality = 13", "must be between 0 and 12"},
         {"gearbox.pitch_error_um =\ngearbox.gear.quality = 6",
          "only for gearbox.kind = \"fixed-shaft\""},
         {"gearbox.pitch_error_um =\ngearbox.sun.index_um = [1, 2, 3]",
          "has 3 deviations for 28 teeth"},
         {"gearbox.pitch_error_um =\ngearbox.planet.ring_side_index_um = [1, 2, 3]",
          "has 3 deviations for 136 teeth"},
         {"gearbox.pitch_error_um =\ngearbox.pin_radial_um = [1, 2, 3]",
          "has 3 values, but there are 4 planets"},
         {"gearbox.pitch_error_um =\ngearbox.planet_mass_factors = [1, 0, 1, 1]", "was removed"},
         {"effects.motion = \"torsional\"\nrandom.gearbox.pin_radial_rms_um = { distribution = "
          "\"constant\", value = 1 }",
          "the bearings of this model are rigid", "gearbox.pin_radial_rms_um"},
         {"numerics.integrator = \"newmak\"", "did you mean newmark?"},
         // Inputs that must not be random.
         {"random.gearbox.sun_planet.error_um = { distribution = \"constant\", value = 1 }",
          "may not be random (it is not a number)"},
     }},
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
    for (const auto& [study, rows] : kBadScenes) {
        for (const BadSettings& bad : rows) {
            check_refused(study, bad);
        }
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
