// Checks that every kind of error in a study file is reported with file, line, key and remedy.
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_problems.hpp"
#include "tests/test.hpp"

namespace gearpod::test_bad_input {

using mc::format;
using mc::Problem;
using mc::Problems;
using mc::read_study;
using mc::read_study_text;
using namespace tests;

struct BadFile {
    const char* from;    // text of the example to replace
    const char* to;      // replacement
    const char* marker;  // text on the line named by the problem
    const char* key;
    const char* words;  // in the problem or in the remedy
};

const BadFile kBadFiles[] = {
    // Unknown names.
    {"module_mm", "module", "module =", "gearbox.module",
     "unknown key; did you mean module_mm? (unit missing)"},
    {"module_mm = 3.175", "module_m = 0.003175", "module_m", "gearbox.module_m",
     "did you mean module_mm? (its unit is mm)"},
    {"young_modulus_Pa", "young_modulus_GPa", "young_modulus_GPa", "gearbox.young_modulus_GPa",
     "did you mean young_modulus_Pa? (its unit is Pa)"},
    {"planet.teeth", "planet.teth", "planet.teth", "gearbox.planet.teth",
     "did you mean planet.teeth?"},
    {"[operation]", "teeth = 19\n[operation]", "teeth = 19\n[op", "gearbox.teeth",
     "it belongs in [gearbox.sun]"},
    {"[operation]", "[planet]\nteeth = 31\n[operation]", "[planet]", "planet",
     "write [gearbox.planet]"},
    {"torque_N_m", "turqe", "turqe", "operation.turqe", "did you mean torque_N_m?"},
    {"torque_N_m", "turque_N_m", "turque", "operation.turque_N_m", "did you mean torque_N_m?"},
    {"low_pass_Hz", "low_pass_kHz", "low_pass_kHz", "sensor.low_pass_kHz",
     "did you mean low_pass_Hz? (its unit is Hz)"},
    {"[operation]", "[operation]\nplanets = 4", "planets = 4\ntorque", "operation.planets",
     "it belongs in [gearbox]"},
    {"[sensor]", "[senser]", "[senser]", "senser", "unknown section; did you mean sensor?"},
    {"title", "seed = 3\ntitle", "seed = 3", "seed", "the key belongs in [ensemble]"},
    {"kind = \"crack\"", "kind = \"crak\"", "crak", "fault.kind", "did you mean crack?"},
    {"[operation]", "[effects]\npath = \"hammign\"\n[operation]", "hammign", "effects.path",
     "did you mean hamming?"},
    {"[operation]", "[features]\nuse = [\"te_rms\", \"te_kurtsis\"]\n[operation]", "te_kurtsis",
     "features.use", "unknown feature \"te_kurtsis\"; did you mean te_kurtosis?"},
    // Wrong types.
    {"planets = 4", "planets = 4.5", "planets =", "gearbox.planets", "must be an integer"},
    {"planets = 4", "planets = \"four\"", "planets =", "gearbox.planets",
     "must be an integer, but is a string"},
    {"module_mm = 3.175", "module_mm = true", "module_mm", "gearbox.module_mm",
     "must be a number in mm, but is true"},
    {"module_mm = 3.175", "module_mm = [3.175]", "module_mm", "gearbox.module_mm",
     "must be a number in mm, but is a list"},
    {"seed = 7", "seed = 2024-01-01", "seed =", "ensemble.seed", "but is a date"},
    {"title = \"example\"", "title = 5", "title", "title", "must be a string"},
    {"title", "effects = 3\ntitle", "effects", "effects", "must be a section, but is an integer"},
    {"[operation]", "[effects]\ninertial_terms = \"yes\"\n[operation]", "inertial_terms",
     "effects.inertial_terms", "must be true or false"},
    {"noise_levels = [0, 0.5, 1]", "noise_levels = 1", "noise_levels", "sensor.noise_levels",
     "must be a list of numbers"},
    {"noise_levels = [0, 0.5, 1]", "noise_levels = [1, \"a\"]", "noise_levels",
     "sensor.noise_levels", "must be a number, but is a string"},
    {"side = \"ring\"", "side = 1", "side", "fault.side", "must be a string, but is an integer"},
    // Out of range.
    {"sun.mass_kg = 0.7", "sun.mass_kg = -0.7", "sun.mass_kg", "gearbox.sun.mass_kg",
     "must be > 0, but is -0.7"},
    {"planets = 4", "planets = 1", "planets = 1", "gearbox.planets", "must be between 2 and 8"},
    {"poisson_ratio = 0.3", "poisson_ratio = 0.5", "poisson", "gearbox.poisson_ratio",
     "must be >= 0 and < 0.5"},
    {"carrier.mass_kg = 10", "carrier.mass_kg = nan", "carrier.mass", "gearbox.carrier.mass_kg",
     "must be a finite number"},
    {"torque_N_m = 429", "torque_N_m = inf", "torque", "operation.torque_N_m",
     "must be a finite number"},
    {"torque_N_m = 429", "torque_N_m = -1", "torque", "operation.torque_N_m",
     "must be >= 0, but is -1"},
    {"sampling_Hz = 5000", "sampling_Hz = 1.01e7", "sampling_Hz", "sensor.sampling_Hz",
     "must be > 0 and <= 10000000"},
    {"low_pass_Hz = 800", "low_pass_Hz = 1.01e7", "low_pass_Hz", "sensor.low_pass_Hz",
     "must be > 0 and <= 10000000"},
    {"encoder_sampling_Hz = 5000", "encoder_sampling_Hz = 1.01e7", "encoder_sampling_Hz",
     "sensor.encoder_sampling_Hz", "must be > 0 and <= 10000000"},
    {"[operation]", "[numerics]\nmax_meshes = -1\n[operation]", "max_meshes", "numerics.max_meshes",
     "must be between 0 and 1000000"},
    {"[operation]", "[numerics]\nsteps_per_mesh = 1000001\n[operation]", "steps_per_mesh",
     "numerics.steps_per_mesh", "must be between 0 and 1000000"},
    {"seed = 7", "seed = -7", "seed =", "ensemble.seed", "must be >= 0, but is -7"},
    {"instances = 100", "instances = 0", "instances = 0", "ensemble.instances", "must be between"},
    {"noise_levels = [0, 0.5, 1]", "noise_levels = [1, 0.5]", "noise_levels", "sensor.noise_levels",
     "must ascend"},
    {"noise_levels = [0, 0.5, 1]", "noise_levels = [5, 2, 1]", "noise_levels",
     "sensor.noise_levels", "2 is not above 5"},
    {"noise_levels = [0, 0.5, 1]", "noise_levels = []", "noise_levels", "sensor.noise_levels",
     "is an empty list"},
    {"[operation]", "[numerics]\nlanes = 2\n[operation]", "lanes", "numerics.lanes",
     "must be 8, 4 or 1, but is 2"},
    {"[operation]", "[numerics]\nlanes = 16\n[operation]", "lanes", "numerics.lanes",
     "must be 8, 4 or 1, but is 16"},
    {"[operation]", "[numerics]\nprecision = \"single\"\nlanes = 3\n[operation]", "lanes",
     "numerics.lanes", "must be 16, 8, 4 or 1, but is 3"},
    {"[operation]", "[numerics]\nprecision = \"single\"\nintegrator = \"sdirk3\"\n[operation]",
     "precision", "numerics.precision",
     "\"single\" is for the integrators rk4 and central-difference, but numerics.integrator is "
     "\"sdirk3\""},
    {"[operation]", "[numerics]\ngrid_tolerance = 0\n[operation]", "grid_tolerance",
     "numerics.grid_tolerance", "must be > 0 and < 1"},
    {"low_pass_Hz = 800", "low_pass_Hz = 2500", "low_pass", "sensor.low_pass_Hz",
     "2500 Hz must be below 2500 Hz, half of sampling_Hz"},
    // Missing.
    {"torque_N_m = 429\n", "", "[operation]", "operation.torque_N_m", "missing; add torque_N_m"},
    {"carrier_speed_rpm = 8.87\n", "", "[operation]", "operation", "no speed is given"},
    {"mesh_damping_ratio = 0.07\n", "", "[gearbox]", "gearbox.mesh_damping_ratio",
     "missing (belongs to effects.mesh_damping = \"ratio\")"},
    {"side = \"ring\"\n", "", "[fault]", "fault.side", "missing (fault.member is \"planet\")"},
    {"fault.depth_mm = { distribution = \"levels\", values = [0, 1, 2, 3, 4.3] }\n", "", "[fault]",
     "fault.depth_mm", "missing (fault.kind is \"crack\")"},
    // Keys that exclude one another.
    {"carrier_speed_rpm", "sun_speed_rpm = 46.7\ncarrier_speed_rpm", "carrier_speed",
     "operation.carrier_speed_rpm", "conflicts with operation.sun_speed_rpm"},
    {"sun.mass_kg", "sun.inertia_kg_m2 = 1e-3\nsun.inertia_over_r2_kg = 0.5\nsun.mass_kg",
     "sun.inertia_over_r2", "gearbox.sun.inertia_over_r2_kg", "conflicts with"},
    {"[operation]", "mesh_damping_time_s = 1e-6\n[operation]", "mesh_damping_time_s",
     "gearbox.mesh_damping_time_s", "is not allowed here"},
    {"[operation]", "sun_planet.stiffness_N_m = 1e8\n[operation]", "sun_planet.stiffness",
     "gearbox.sun_planet.stiffness_N_m", "only for gearbox.tooth_profile = \"constant\""},
    {"[operation]", "[operation]\ninput = \"ring\"", "input", "operation.input",
     "is \"ring\", which stands still (operation.fixed); use \"sun\" or \"carrier\""},
    {"[operation]", "[operation]\ntorque_on = \"ring\"", "torque_on", "operation.torque_on",
     "is \"ring\", which stands still (operation.fixed); use \"sun\" or \"carrier\""},
    {"carrier_speed_rpm", "fixed = \"sun\"\ninput = \"sun\"\ncarrier_speed_rpm", "input",
     "operation.input", "which stands still (operation.fixed); use \"ring\" or \"carrier\""},
    {"carrier_speed_rpm", "fixed = \"carrier\"\ninput = \"carrier\"\nsun_speed_rpm", "input",
     "operation.input", "which stands still (operation.fixed); use \"sun\" or \"ring\""},
    {"carrier_speed_rpm", "ring_speed_rpm = 9\ncarrier_speed_rpm", "ring_speed",
     "operation.ring_speed_rpm", "was removed; give sun_speed_rpm or carrier_speed_rpm"},
    {"carrier_speed_rpm", "fixed = \"sun\"\nsun_speed_rpm", "sun_speed", "operation.sun_speed_rpm",
     "the sun stands still"},
    {"[operation]", "[effects]\nmesh_damping = \"rayleigh\"\n[operation]", "rayleigh",
     "effects.mesh_damping", "of an earlier version was removed; use \"ratio\""},
    {"[ensemble]", "[ensemble]\nuntil = { half_width = 0.1 }", "until", "ensemble.until",
     "was removed; remove it; run --resume with more --instances"},
    {"member = \"planet\"", "member = \"sun\"", "side = ", "fault.side",
     "only for fault.member = \"planet\""},
    // Impossible gears and cracks.
    {"ring.teeth = 81", "ring.teeth = 77", "ring.teeth", "gearbox.ring.teeth",
     "cannot be assembled: the ring has 77 teeth"},
    {"planets = 4", "planets = 5", "planets", "gearbox.planets", "cannot be assembled"},
    {"side = \"ring\"", "side = \"ring\"\nplanet = 5", "planet = 5", "fault.planet",
     "is 5, but there are 4 planets"},
    {"side = \"ring\"", "side = \"ring\"\ndepth_mm = 20", "depth_mm = 20", "fault.depth_mm",
     "20 mm is longer than the tooth"},
    {"values = [0, 1, 2, 3, 4.3]", "values = [0, 20]", "values = [0, 20]", "random.fault.depth_mm",
     "20 mm is longer than the tooth"},
    {"values = [0, 1, 2, 3, 4.3]", "values = [0, -1]", "values = [0, -1]", "random.fault.depth_mm",
     "depth_mm must be >= 0"},
    // Distributions.
    {"values = [0, 1, 2, 3, 4.3]", "values = []", "values = []", "random.fault.depth_mm.values",
     "has no values"},
    {"values = [0, 1, 2, 3, 4.3]", "value = [1]", "value = [1]", "random.fault.depth_mm.value",
     "unknown parameter of levels; did you mean values?"},
    {"distribution = \"lognormal\"", "distribution = \"log-normal\"", "log-normal",
     "random.gearbox.planet.bearing_stiffness_N_m", "did you mean lognormal?"},
    {"median = 1.1e8, cv = 0.2", "median = 1.1e8", "median",
     "random.gearbox.planet.bearing_stiffness_N_m.cv", "missing; lognormal needs it"},
    {"median = 1.1e8, cv = 0.2", "median = 1.1e8, cv = -1", "median",
     "random.gearbox.planet.bearing_stiffness_N_m.cv", "must be > 0, but is -1"},
    {"\"levels\", values = [0, 1, 2, 3, 4.3]", "\"grid\", low = 0, high = 4, count = 2000000000",
     "count", "random.fault.depth_mm.count",
     "must be an integer between 2 and 100000, but is 2000000000"},
    {"\"levels\", values = [0, 1, 2, 3, 4.3]", "\"grid\", low = 0, high = 4, count = 4.0", "count",
     "random.fault.depth_mm.count",
     "must be an integer, but is a number (4.0); give a value between 2 and 100000"},
    {"low = -0.1, high = 0.3", "low = 0.3, high = -0.1", "path_exponent",
     "random.sensor.path_exponent", "low must be below high"},
    {"low = -0.1, high = 0.3", "low = -0.1, high = inf", "path_exponent",
     "random.sensor.path_exponent.high", "must be a finite number"},
    {"\"lognormal\", median = 1.1e8, cv = 0.2", "\"normal\", mean = 1e8, sd = 2e7", "\"normal\"",
     "random.gearbox.planet.bearing_stiffness_N_m", "use lognormal or truncated-normal"},
    {"[random]", "[random]\ngearbox.module_mm = { distribution = \"constant\", value = 3 }",
     "gearbox.module_mm =", "random.gearbox.module_mm", "may not be random (it defines the teeth"},
    {"[random]", "[random]\nsensor.sampling_Hz = { distribution = \"constant\", value = 3 }",
     "sensor.sampling_Hz =", "random.sensor.sampling_Hz", "sampling is the same for all gearboxes"},
    {"[random]", "[random]\nsensor.noise = { distribution = \"constant\", value = 3 }",
     "sensor.noise =", "random.sensor.noise", "did you mean noise_m_s2? (unit missing)"},
    {"[random]", "[random]\nsensor.noise_m_s2 = 3",
     "sensor.noise_m_s2 =", "random.sensor.noise_m_s2", "must be a table, but is an integer"},
    {"[random]", "[random]\nsensors.noise_m_s2 = 3", "sensors.noise", "random.sensors",
     "unknown section; did you mean sensor?"},
    {"[random]", "[detection]\nsize_edges_mm = [0, 2]\n[random]", "size_edges_mm",
     "detection.size_edges_mm", "fault.depth_mm is not continuous"},
    // Broken TOML.
    {"planets = 4", "planets = ", "planets =", "", "not valid TOML"},
    {"planets = 4", "planets = 4\nplanets = 5", "planets = 5", "", "not valid TOML"},
    {"[operation]", "[operation", "[operation", "", "not valid TOML"},
    {"[operation]", "[[[operation]]]", "[[[operation", "", "not valid TOML"},
    {"[operation]", "[[operation]]", "[[operation", "operation", "must be a section"},
};

TEST_CASE("Each bad study file is refused with the line, the key and the remedy") {
    for (const BadFile& bad : kBadFiles) {
        const std::string text = example_with(bad.from, bad.to);
        REQUIRE_FALSE(text.empty());
        const auto reading = read_study_text(text, "bad.toml");
        INFO(bad.from << " -> " << bad.to << "\n" << format(reading.problems));
        CHECK_FALSE(reading.study.has_value());
        const auto found =
            std::find_if(reading.problems.begin(), reading.problems.end(), [&](const Problem& p) {
                return p.file == "bad.toml" && p.line == line_of(text, bad.marker) &&
                       p.key == bad.key && mentions(p, bad.words);
            });
        CHECK(found != reading.problems.end());
        // One mistake gives one message.
        CHECK(reading.problems.size() == 1);
    }
}

TEST_CASE("Continuous crack depths need size edges that cover them") {
    std::string text =
        example_with("\"levels\", values = [0, 1, 2, 3, 4.3]", "\"uniform\", low = 0, high = 4");
    auto reading = read_study_text(text, "bad.toml");
    REQUIRE(reading.problems.size() == 1);
    CHECK(reading.problems[0].key == "detection.size_edges_mm");
    CHECK(mentions(reading.problems[0], "whose sizes must be grouped"));

    reading = read_study_text(text + "[detection]\nsize_edges_mm = [0, 1, 3]\n", "bad.toml");
    REQUIRE(reading.problems.size() == 1);
    CHECK(reading.problems[0].line == line_of(text, "seed") + 2);
    CHECK(mentions(reading.problems[0], "does not cover all fault sizes of the study, 0 to 4 mm"));

    CHECK(read_study_text(text + "[detection]\nsize_edges_mm = [0, 1, 4]\n", "good.toml").study);
}

TEST_CASE("A crack depth is refused from the length on at which the crack exits the tooth") {
    // Source: Liang (2016), section 3.2, root chord of the 31-tooth planet at the root circle;
    // twice its half length over sin 45 degrees. R_b and a2 computed by hand for m = 3.175 mm, a0 =
    // 20 degrees: the root circle (45.24 mm) lies below the base circle (46.25 mm), so the half
    // chord is R_b sin a2.
    const double a0 = 20.0 * M_PI / 180.0;
    const double base_mm = 0.5 * 3.175 * 31 * std::cos(a0);
    const double half_angle = M_PI / (2 * 31) + std::tan(a0) - a0;
    const double limit_mm = 2.0 * base_mm * std::sin(half_angle) / std::sin(M_PI / 4.0);
    const auto reading_of = [&](double depth_mm) {
        return read_study_text(kExampleStudy, "study.toml",
                               {"random.fault.depth_mm.values=[" + std::to_string(depth_mm) + "]"});
    };
    CHECK(reading_of(limit_mm - 1e-3).study);
    const auto reading = reading_of(limit_mm + 1e-3);
    REQUIRE(reading.problems.size() == 1);
    char limit[32];
    std::snprintf(limit, sizeof limit, "%.3f", limit_mm);
    CHECK(mentions(reading.problems[0], std::string(limit).substr(0, 4)));
}

TEST_CASE("Every bad entry of a distribution or a list is reported") {
    const auto whats_of = [](const std::string& text) {
        const auto reading = read_study_text(text, "bad.toml");
        std::vector<std::string> whats;
        for (const Problem& problem : reading.problems) {
            whats.push_back(problem.key + ": " + problem.what);
        }
        return whats;
    };
    using Whats = std::vector<std::string>;
    const std::string bearing = "random.gearbox.planet.bearing_stiffness_N_m",
                      depth = "random.fault.depth_mm", path = "random.sensor.path_exponent";
    CHECK(whats_of(example_with("median = 1.1e8, cv = 0.2", "median = -1, cv = nan")) ==
          Whats{bearing + ".median: must be > 0, but is -1",
                bearing + ".cv: must be a finite number, but is nan"});
    CHECK(whats_of(example_with("[0, 1, 2, 3, 4.3]", "[0, \"a\", nan]")) ==
          Whats{depth + ".values: must be a number, but is a string (\"a\")",
                depth + ".values: must be a finite number, but is nan"});
    CHECK(whats_of(example_with("\"levels\", values = [0, 1, 2, 3, 4.3]",
                                "\"grid\", low = 3, high = 1, count = 1")) ==
          Whats{depth + ".count: must be an integer between 2 and 100000, but is 1",
                depth + ": low must be below high"});
    CHECK(
        whats_of(example_with("sd = 0.05, low = -0.1, high = 0.3", "sd = 0, low = 1, high = 1")) ==
        Whats{path + ".sd: must be > 0, but is 0", path + ": low must be below high"});
    CHECK(whats_of(example_with("sd = 0.05, low = -0.1, high = 0.3", "sd = 0, low = 1")) ==
          Whats{path + ".sd: must be > 0, but is 0", path + ".high: missing"});
    CHECK(whats_of(
              example_with("noise_levels = [0, 0.5, 1]", "noise_levels = [-1, true, 2, inf, 1]")) ==
          Whats{"sensor.noise_levels: must be >= 0, but is -1",
                "sensor.noise_levels: must be a number, but is true",
                "sensor.noise_levels: must be a finite number, but is inf",
                "sensor.noise_levels: must ascend, but 1 is not above 2, the value before it"});
    CHECK(whats_of(example_with("[operation]",
                                "[features]\nuse = [1, \"te_rmss\", 2.5]\n[operation]")) ==
          Whats{"features.use: must be a list of strings, but contains an integer (1)",
                "features.use: must be a list of strings, but contains a number (2.5)",
                "features.use: unknown feature \"te_rmss\""});
}

TEST_CASE("Problems of elements of a list have the line of the element") {
    const std::string text =
        example_with("noise_levels =",
                     "tones = [{ frequency_Hz = 50, amplitude_m_s2 = 0.1 },\n"
                     "{ frequency_Hz = 60, amplitude_m_s2 = -1 },\n"
                     "{ frequency_Hz = 70, amplitude_m_s2 = 1, orders = 3 }]\nnoise_levels =");
    const auto problems = read_study_text(text, "bad.toml").problems;
    INFO(format(problems));
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].line == line_of(text, "amplitude_m_s2 = -1"));
    CHECK(problems[1].line == line_of(text, "orders"));
}

TEST_CASE("All problems of a file are reported at once, sorted by line, overrides last") {
    std::string text = example_with("planets = 4", "planets = 40");
    text.replace(text.find("seed = 7"), 8, "seed = -1");
    text.replace(text.find("member = \"planet\""), 17, "member = \"plane\"");
    text.replace(text.find("torque_N_m"), 10, "torque_Nm");
    const auto reading =
        read_study_text(text, "bad.toml", {"sensor.nois_levels=[1]", "gearbox.sun.mass_kg=-2"});
    REQUIRE(reading.problems.size() == 6);
    const char* keys[] = {"gearbox.planets", "operation.torque_Nm", "fault.member",
                          "ensemble.seed",   "sensor.nois_levels",  "gearbox.sun.mass_kg"};
    for (const char* key : keys) {
        CHECK(std::count_if(reading.problems.begin(), reading.problems.end(),
                            [&](const Problem& p) { return p.key == key; }) == 1);
    }
    for (std::size_t i = 0; i + 1 < 4; ++i) {
        CHECK(reading.problems[i].line < reading.problems[i + 1].line);
    }
    CHECK(reading.problems[4].file == "--set");
    CHECK(reading.problems[5].file == "--set");
    const std::string shown = format(reading.problems);
    CHECK(shown.find("bad.toml:5: gearbox.planets: must be between 2 and 8, but is 40") !=
          std::string::npos);
    CHECK(shown.find("--set: ") != std::string::npos);
}

TEST_CASE("Overrides that are no assignments or hold no value are refused") {
    const char* const overrides[] = {"ensemble.seed",       "=3",          "ensemble..seed=3",
                                     "ensemble.seed=",      "seed=[1",     "ensemble.seed=1\nx=2",
                                     "ensemble.seed=1 2",   "ensembl.x=1", "ensemble=3",
                                     "gearbox.planets.x=1", "random=1",    "fault.side=left"};
    for (const char* text : overrides) {
        const auto reading = read_study_text(kExampleStudy, "study.toml", {text});
        INFO(text << "\n" << format(reading.problems));
        CHECK_FALSE(reading.study);
        REQUIRE_FALSE(reading.problems.empty());
        CHECK(reading.problems.back().file == "--set");
    }
}

TEST_CASE("An empty file lacks each section with required keys") {
    const auto reading = read_study_text("", "empty.toml");
    for (const char* section : {"gearbox", "operation", "fault", "sensor", "ensemble"}) {
        CHECK(std::count_if(reading.problems.begin(), reading.problems.end(), [&](const auto& p) {
                  return p.key == section && p.what == "the section is missing";
              }) == 1);
    }
    CHECK(format(reading.problems).find("torque_N_m and sun_speed_rpm or carrier_speed_rpm") !=
          std::string::npos);
}

TEST_CASE("A file that cannot be read is one problem") {
    for (const char* path : {"/nowhere/study.toml", "/", ""}) {
        const auto reading = read_study(path);
        CHECK_FALSE(reading.study);
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].file == path);
    }
    const test::Folder folder;
    const std::string huge = folder.file("huge.toml");
    test::write_bytes(huge, "");
    std::filesystem::resize_file(huge, std::uintmax_t{1} << 40);  // of holes
    const auto reading = read_study(huge);
    REQUIRE(reading.problems.size() == 1);
    CHECK(reading.problems[0].what == "has more than 67108864 bytes");
}

TEST_CASE("No damage to a study file leads to an exception") {
    // Truncated at every position, each byte replaced, each line doubled.
    const std::string text = kExampleStudy;
    for (std::size_t i = 0; i < text.size(); i += 3) {
        CHECK_NOTHROW(read_study_text(text.substr(0, i), "cut.toml"));
        for (const char c : {'=', '[', '"', '-', '\0', '\xff'}) {
            std::string damaged = text;
            damaged[i] = c;
            CHECK_NOTHROW(read_study_text(damaged, "damaged.toml"));
        }
    }
}

}  // namespace gearpod::test_bad_input
