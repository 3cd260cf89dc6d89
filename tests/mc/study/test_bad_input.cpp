// Checks that every kind of error in a study file is reported with file, line, key and remedy.
#include "mc/files/input/document.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_problems.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_bad_input {

using mc::format;
using mc::Problem;
using mc::Problems;
using mc::read_study;
using mc::read_study_text;
using namespace tests;

const BadSettings kBadSettings[] = {
    // Unknown names.
    {"gearbox.module_mm =\ngearbox.module = 3.175",
     "unknown key; did you mean module_mm? (unit missing)"},
    {"gearbox.module_mm =\ngearbox.module_m = 0.003175",
     "did you mean module_mm? (its unit is mm)"},
    {"gearbox.young_modulus_Pa =\ngearbox.young_modulus_GPa = 2.068e11",
     "did you mean young_modulus_Pa? (its unit is Pa)"},
    {"gearbox.planet.teeth =\ngearbox.planet.teth = 31", "did you mean planet.teeth?"},
    {"gearbox.teeth = 19", "it belongs in [gearbox.sun]"},
    {"planet.teeth = 31", "write [gearbox.planet]", "planet"},
    {"operation.torque_N_m =\noperation.turqe = 429", "did you mean torque_N_m?"},
    {"operation.torque_N_m =\noperation.turque_N_m = 429", "did you mean torque_N_m?"},
    {"sensor.low_pass_Hz =\nsensor.low_pass_kHz = 800",
     "did you mean low_pass_Hz? (its unit is Hz)"},
    {"operation.planets = 4", "it belongs in [gearbox]"},
    {"seed = 3", "the key belongs in [ensemble]"},
    {"fault.kind = \"crak\"", "did you mean crack?"},
    {"effects.path = \"hammign\"", "did you mean hamming?"},
    {"features.use = [\"te_rms\", \"te_kurtsis\"]",
     "unknown feature \"te_kurtsis\"; did you mean te_kurtosis?"},
    // Wrong types.
    {"gearbox.planets = 4.5", "must be an integer"},
    {"gearbox.planets = \"four\"", "must be an integer, but is a string"},
    {"gearbox.module_mm = true", "must be a number in mm, but is true"},
    {"gearbox.module_mm = [3.175]", "must be a number in mm, but is a list"},
    {"ensemble.seed = 2024-01-01", "but is a date"},
    {"title = 5", "must be a string"},
    {"effects = 3", "must be a section, but is an integer"},
    {"effects.inertial_terms = \"yes\"", "must be true or false"},
    {"sensor.noise_levels = 1", "must be a list of numbers"},
    {"sensor.noise_levels = [1, \"a\"]", "must be a number, but is a string"},
    {"fault.side = 1", "must be a string, but is an integer"},
    // Out of range.
    {"gearbox.sun.mass_kg = -0.7", "must be > 0, but is -0.7"},
    {"gearbox.planets = 1", "must be between 2 and 8"},
    {"gearbox.poisson_ratio = 0.5", "must be >= 0 and < 0.5"},
    {"gearbox.carrier.mass_kg = nan", "must be a finite number"},
    {"operation.torque_N_m = inf", "must be a finite number"},
    {"operation.torque_N_m = -1", "must be >= 0, but is -1"},
    {"sensor.sampling_Hz = 1.01e7", "must be > 0 and <= 10000000"},
    {"sensor.low_pass_Hz = 1.01e7", "must be > 0 and <= 10000000"},
    {"sensor.encoder_sampling_Hz = 1.01e7", "must be > 0 and <= 10000000"},
    {"numerics.max_meshes = -1", "must be between 0 and 1000000"},
    {"numerics.steps_per_mesh = 1000001", "must be between 0 and 1000000"},
    {"ensemble.seed = -7", "must be >= 0, but is -7"},
    {"ensemble.instances = 0", "must be between"},
    {"sensor.noise_levels = [1, 0.5]", "must ascend"},
    {"sensor.noise_levels = [5, 2, 1]", "2 is not above 5"},
    {"sensor.noise_levels = []", "is an empty list"},
    {"numerics.lanes = 2", "must be 8, 4 or 1, but is 2"},
    {"numerics.lanes = 16", "must be 8, 4 or 1, but is 16"},
    {"numerics.precision = \"single\"\nnumerics.lanes = 3", "must be 16, 8, 4 or 1, but is 3"},
    {"numerics.integrator = \"sdirk3\"\nnumerics.precision = \"single\"",
     "\"single\" is for the integrators rk4 and central-difference, but numerics.integrator is "
     "\"sdirk3\""},
    {"numerics.grid_tolerance = 0", "must be > 0 and < 1"},
    {"sensor.low_pass_Hz = 2500", "2500 Hz must be below 2500 Hz, half of sampling_Hz"},
    // Missing.
    {"operation.torque_N_m =", "missing; add torque_N_m"},
    {"operation.carrier_speed_rpm =", "no speed is given", "operation"},
    {"gearbox.mesh_damping_ratio =", "missing (belongs to effects.mesh_damping = \"ratio\")"},
    {"random.fault.depth_mm =", "missing (fault.kind is \"crack\")", "fault.depth_mm"},
    // Keys that exclude one another.
    {"operation.sun_speed_rpm = 46.7", "conflicts with operation.sun_speed_rpm",
     "operation.carrier_speed_rpm"},
    {"gearbox.sun.inertia_kg_m2 = 1e-3\ngearbox.sun.inertia_over_r2_kg = 0.5", "conflicts with"},
    {"gearbox.mesh_damping_time_s = 1e-6", "is not allowed here"},
    {"gearbox.sun_planet.stiffness_N_m = 1e8", "only for gearbox.tooth_profile = \"constant\""},
    {"operation.input = \"ring\"",
     "is \"ring\", which stands still (operation.fixed); use \"sun\" or \"carrier\""},
    {"operation.torque_on = \"ring\"",
     "is \"ring\", which stands still (operation.fixed); use \"sun\" or \"carrier\""},
    {"operation.fixed = \"sun\"\noperation.input = \"sun\"",
     "which stands still (operation.fixed); use \"ring\" or \"carrier\""},
    {"operation.carrier_speed_rpm =\noperation.fixed = \"carrier\"\noperation.sun_speed_rpm = "
     "8.87\noperation.input = \"carrier\"",
     "which stands still (operation.fixed); use \"sun\" or \"ring\""},
    {"operation.ring_speed_rpm = 9", "was removed; give sun_speed_rpm or carrier_speed_rpm"},
    {"operation.carrier_speed_rpm =\noperation.fixed = \"sun\"\noperation.sun_speed_rpm = 8.87",
     "the sun stands still"},
    {"effects.mesh_damping = \"rayleigh\"", "of an earlier version was removed; use \"ratio\""},
    {"ensemble.until = { half_width = 0.1 }",
     "was removed; remove it; run --resume with more --instances"},
    {"fault.member = \"sun\"", "only for fault.member = \"planet\"", "fault.side"},
    // Impossible gears and cracks.
    {"gearbox.ring.teeth = 77", "cannot be assembled: the ring has 77 teeth"},
    {"gearbox.planets = 5", "cannot be assembled"},
    {"gearbox.centre_distance_mm = 70", "the other keys give 79.375 mm"},  // (19 + 31) 3.175 mm / 2
    {"fault.planet = 5", "is 5, but there are 4 planets"},
    {"fault.depth_mm = 20", "20 mm is longer than the tooth"},
    {"random.fault.depth_mm = { distribution = \"levels\", values = [0, 20] }",
     "20 mm is longer than the tooth"},
    {"random.fault.depth_mm = { distribution = \"levels\", values = [0, -1] }",
     "depth_mm must be >= 0"},
    // Distributions.
    {"random.fault.depth_mm = { distribution = \"levels\", values = [] }", "has no values",
     "random.fault.depth_mm.values"},
    {"random.fault.depth_mm = { distribution = \"levels\", value = [1] }",
     "unknown parameter of levels; did you mean values?", "random.fault.depth_mm.value"},
    {"random.gearbox.planet.bearing_stiffness_N_m = { distribution = \"log-normal\", median = "
     "1.1e8, cv = 0.2 }",
     "did you mean lognormal?"},
    {"random.gearbox.planet.bearing_stiffness_N_m = { distribution = \"lognormal\", median = 1.1e8 "
     "}",
     "missing; lognormal needs it", "random.gearbox.planet.bearing_stiffness_N_m.cv"},
    {"random.gearbox.planet.bearing_stiffness_N_m = { distribution = \"lognormal\", median = "
     "1.1e8, cv = -1 }",
     "must be > 0, but is -1", "random.gearbox.planet.bearing_stiffness_N_m.cv"},
    {"random.fault.depth_mm = { distribution = \"grid\", low = 0, high = 4, count = 2000000000 }",
     "must be an integer between 2 and 100000, but is 2000000000", "random.fault.depth_mm.count"},
    {"random.fault.depth_mm = { distribution = \"grid\", low = 0, high = 4, count = 4.0 }",
     "must be an integer, but is a number (4.0); give a value between 2 and 100000",
     "random.fault.depth_mm.count"},
    {"random.sensor.path_exponent = { distribution = \"truncated-normal\", mean = 0.1, sd = 0.05, "
     "low = 0.3, high = -0.1 }",
     "low must be below high"},
    {"random.sensor.path_exponent = { distribution = \"truncated-normal\", mean = 0.1, sd = 0.05, "
     "low = -0.1, high = inf }",
     "must be a finite number", "random.sensor.path_exponent.high"},
    {"random.gearbox.planet.bearing_stiffness_N_m = { distribution = \"normal\", mean = 1e8, sd = "
     "2e7 }",
     "use lognormal or truncated-normal"},
    {"random.gearbox.module_mm = { distribution = \"constant\", value = 3 }",
     "may not be random (it defines the teeth"},
    {"random.sensor.sampling_Hz = { distribution = \"constant\", value = 3 }",
     "sampling is the same for all gearboxes"},
    {"random.sensor.noise = { distribution = \"constant\", value = 3 }",
     "did you mean noise_m_s2? (unit missing)"},
    {"random.sensor.noise_m_s2 = 3", "must be a table, but is an integer"},
    {"random.sensors.noise_m_s2 = 3", "unknown section; did you mean sensor?", "random.sensors"},
    {"detection.size_edges_mm = [0, 2]", "fault.depth_mm is not continuous"},
};

struct BadFile {
    const char* from;    // text of the example to replace
    const char* to;      // replacement
    const char* marker;  // text on the line named by the problem
    const char* key;
    const char* words;  // in the problem or in the remedy
};

// Sections that are unknown or are not TOML.
const BadFile kBadFiles[] = {
    {"[sensor]", "[senser]", "[senser]", "senser", "unknown section; did you mean sensor?"},
    {"planets = 4", "planets = ", "planets =", "", "not valid TOML"},
    {"planets = 4", "planets = 4\nplanets = 5", "planets = 5", "", "not valid TOML"},
    {"[operation]", "[operation", "[operation", "", "not valid TOML"},
    {"[operation]", "[[[operation]]]", "[[[operation", "", "not valid TOML"},
    {"[operation]", "[[operation]]", "[[operation", "operation", "must be a section"},
};

TEST_CASE("Each bad study file is refused with the line, the key and the remedy") {
    for (const BadSettings& bad : kBadSettings) {
        check_refused(kExampleStudy, bad);
    }
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
        return test::mapped(reading.problems, [&](const Problem& problem) {
            return problem.key + ": " + problem.what;
        });
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
    CHECK(test::contains(shown, "bad.toml:5: gearbox.planets: must be between 2 and 8, but is 40"));
    CHECK(test::contains(shown, "--set: "));
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
    CHECK(test::contains(format(reading.problems),
                         "torque_N_m and sun_speed_rpm or carrier_speed_rpm"));
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

TEST_CASE("All gears that do not mesh are named, on the line of the angle or the smaller gear") {
    // Lengths in modules, tip circles one module from the pitch circles. True if the mate's contact
    // reaches below the base circle of the gear of z1 teeth: the length of the line of action up to
    // there is (r1 +- r2) sin a.
    const auto undercuts = [](int z1, int z2, bool internal, double angle_deg) {
        const double a = angle_deg * M_PI / 180.0, side = internal ? -1.0 : 1.0;
        const double r1 = 0.5 * z1, r2 = 0.5 * z2, tip = r2 + side, base = r2 * std::cos(a);
        const double reach = std::sqrt(tip * tip - base * base),
                     room = (r2 + side * r1) * std::sin(a);
        return side * reach > side * room;
    };
    struct Train {
        int planets, sun, planet, ring;
        const char *angle_deg, *marker, *key;
    };
    const Train trains[] = {
        {4, 19, 31, 81, "14.5", "pressure_angle", "gearbox.pressure_angle_deg"},
        {6, 20, 10, 40, "20", "planet.teeth", "gearbox.planet.teeth"},
        {6, 20, 10, 40, "20.5", "planet.teeth", "gearbox.planet.teeth"},
    };
    for (const Train& train : trains) {
        std::string text = example_with("pressure_angle_deg = 20",
                                        "pressure_angle_deg = " + std::string(train.angle_deg));
        const auto set = [&](const std::string& from, const std::string& key, int value) {
            text.replace(text.find(from), from.size(), key + " = " + std::to_string(value));
        };
        set("planets = 4", "planets", train.planets);
        set("sun.teeth = 19", "sun.teeth", train.sun);
        set("planet.teeth = 31", "planet.teeth", train.planet);
        set("ring.teeth = 81", "ring.teeth", train.ring);
        const double angle_deg = std::stod(train.angle_deg);
        REQUIRE(undercuts(std::min(train.sun, train.planet), std::max(train.sun, train.planet),
                          false, angle_deg));
        REQUIRE(undercuts(train.planet, train.ring, true, angle_deg));
        const auto problems = read_study_text(text, "bad.toml").problems;
        INFO(format(problems));
        REQUIRE(problems.size() == 2);
        for (const Problem& problem : problems) {
            CHECK(problem.line == line_of(text, train.marker));
            CHECK(problem.key == train.key);
        }
        CHECK(mentions(problems[0], "sun and planet do not mesh (the tips of " +
                                        std::to_string(std::max(train.sun, train.planet)) +
                                        " teeth reach below the base circle"));
        CHECK(mentions(problems[1], "planet and ring do not mesh (the tips of " +
                                        std::to_string(train.ring) + " teeth"));
    }
}

TEST_CASE("Gears without tooth contact at some phase are refused") {
    const auto problems =
        read_study_text(example_with("planets = 4", "planets = 4\naddendum_coefficient = 0.2"),
                        "bad.toml")
            .problems;
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].key == "gearbox.sun.teeth");
    CHECK(mentions(problems[0], "sun and planet do not mesh (the contact ratio of 19 against 31"));
    CHECK(problems[1].key == "gearbox.planet.teeth");
    CHECK(mentions(problems[1], "planet and ring do not mesh (the contact ratio of 31 against 81"));
}

std::string repeated(int count, const std::string& part) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += part;
    }
    return all;
}

TEST_CASE("A study nested too deeply is refused before a parser recurses into it") {
    constexpr int kDeep = 60000;
    const std::string dotted = "a" + repeated(kDeep, ".a");
    const std::string quoted = "\"a\"" + repeated(kDeep, " . 'a'");
    const std::string texts[] = {
        "[" + dotted + "]\n",
        "[[" + dotted + "]]\nx = 1\n",
        dotted + " = 1\n",
        quoted + " = 1\n",
        "gearbox.sun." + dotted + " = 1\n",
        "x = { " + dotted + " = 1 }\n",
        "x = " + repeated(kDeep, "[") + repeated(kDeep, "]") + "\n",
        "x = " + repeated(kDeep, "{ a = ") + "1" + repeated(kDeep, " }") + "\n",
        repeated(kDeep, "["),
    };
    for (const std::string& text : texts) {
        INFO(text.substr(0, 30));
        const auto reading = read_study_text("# one\n" + text, "deep.toml");
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].line == 2);
        CHECK(reading.problems[0].what == "nested deeper than 32 levels");
    }
    for (const std::string& set :
         {dotted + "=1", "fault.side={" + dotted + "=1}", "fault.side=" + repeated(kDeep, "[")}) {
        INFO(set.substr(0, 30));
        const auto reading = read_study_text(kExampleStudy, "study.toml", {set});
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].file == "--set");
    }
}

TEST_CASE(
    "Text that only resembles nesting is accepted: strings, comments, lists of numbers, many "
    "lines") {
    using gearpod::mc::line_nested_too_deep;
    CHECK(line_nested_too_deep("# " + repeated(100, ".a") + "\n") == 0);
    CHECK(line_nested_too_deep("x = \"" + repeated(100, "\\\".a[{") + "\"\ny = 1") == 0);
    CHECK(line_nested_too_deep("x = '" + repeated(100, ".a[{") + "'\n") == 0);
    CHECK(line_nested_too_deep("x = \"\"\"\n" + repeated(100, "\".a[\n") + "\"\"\"\n") == 0);
    CHECK(line_nested_too_deep("x = [" + repeated(100, "0.1, [1.5], ") + "]\n") == 0);
    CHECK(line_nested_too_deep(repeated(100, "[a]\nb.c = 1.25\n")) == 0);
    CHECK(line_nested_too_deep("a" + repeated(31, ".b") + " = 1\n") == 0);
    CHECK(line_nested_too_deep("\n\na" + repeated(32, ".b") + " = 1\n") == 3);
}

TEST_CASE("Numbers whose products would overflow are refused in every key") {
    for (const char* set :
         {"operation.torque_N_m=1e300", "sensor.noise_m_s2=1e300", "sensor.noise_levels=[0,1e300]",
          "gearbox.planet.mass_kg=1e-300", "detection.confidence=1e-300",
          "detection.false_alarm_rate=1e-300", "detection.confidence=0.9999999999999999",
          "random.operation.torque_N_m={distribution='uniform',low=1,high=1e200}",
          "random.operation.torque_N_m={distribution='lognormal',median=1e300,cv=1}"}) {
        const auto reading = read_study_text(kExampleStudy, "study.toml", {set});
        INFO(set << "\n" << format(reading.problems));
        CHECK_FALSE(reading.study);
        CHECK(reading.problems.size() == 1);
    }
}

TEST_CASE("A long file that makes toml++ fail is refused immediately, with its line") {
    const auto reading = read_study_text(repeated(20000, "# comment\n") + "[[[\n", "long.toml");
    REQUIRE(reading.problems.size() == 1);
    CHECK(reading.problems[0].line == 20001);
}

}  // namespace gearpod::test_bad_input
