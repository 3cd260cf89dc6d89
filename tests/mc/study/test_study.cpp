// Checks a study file: read, converted to SI, overridden and written.
#include "mc/files/input/spelling.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study/find_fault.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/shipped_studies.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_study {

using namespace tests;

Study study_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return test::study_of_text(text, overrides);
}

// A gearbox without teeth, with numbers that need all their digits.
Study constant_study() {
    return test::shipped_study(
        "published/lin-parker-n3.toml",
        {"operation.torque_N_m=0.1", "operation.carrier_speed_rpm=1234.567891234567",
         "effects.inertial_terms=false", "sensor.low_pass_Hz=0.3",
         "sensor.encoder_sampling_Hz=333.3333333333333", "sensor.encoder_noise_arcsec=0.7",
         "ensemble.seed=9223372036854775807"});
}

TEST_CASE("Values of a study file are in SI units and radians") {
    const Study study = study_of(kExampleStudy);
    CHECK(study.title == "example");
    CHECK(study.gearbox.module_m == Approx(0.003175).epsilon(1e-15));
    CHECK(study.gearbox.pressure_angle_rad == Approx(M_PI / 9).epsilon(1e-15));
    CHECK(*study.operation.carrier_speed_rad_s == Approx(8.87 * 2 * M_PI / 60).epsilon(1e-15));
    CHECK(study.sensor.encoder_noise_rad == Approx(1.5 / 3600 * M_PI / 180).epsilon(1e-15));
    CHECK(crack_angle_rad(study) == M_PI / 4);
    CHECK(study.sensor.noise_levels == std::vector<double>{0.0, 0.5, 1.0});
    CHECK(study.features.use.size() == 7);
}

TEST_CASE("The nominal value of a random input is the given one, else the median") {
    const Study study = study_of(kExampleStudy);
    CHECK(*study.gearbox.bodies[Member::planet].bearing_stiffness_N_m == 1e8);
    CHECK(fault_size(study) == Approx(0.002));
    const Study without = study_of(example_with("planet.bearing_stiffness_N_m = 1e8\n", ""));
    CHECK(*without.gearbox.bodies[Member::planet].bearing_stiffness_N_m == 1.1e8);
    CHECK(study.find_random("fault.depth_mm")->distribution.median() ==
          1e-3 * study.find_random("fault.depth_mm")->distribution.in_unit_of_file().median());
    CHECK(study.find_random("sensor.noise_m_s2") == nullptr);
}

TEST_CASE("Overrides replace values of the file and may omit quotes around strings") {
    const Study study = study_of(
        kExampleStudy,
        {"ensemble.seed=12", "fault.side=sun", "effects.motion='torsional'",
         "random.fault.depth_mm={distribution=\"grid\", low=0, high=4, count=3}",
         "random.gearbox.planet.bearing_stiffness_N_m.cv = 0.5", "detection.confidence = 0.9"});
    CHECK(study.ensemble.seed == 12);
    CHECK(study.fault.side == FaultSide::sun);
    CHECK(test::shipped_study("wind-turbine-train.toml").fault.side == FaultSide::ring);
    CHECK(study.effects.motion == Motion::torsional);
    CHECK(study.find_random("fault.depth_mm")->distribution.in_unit_of_file().levels() ==
          std::vector<double>{0.0, 2.0, 4.0});
    CHECK(study.find_random("gearbox.planet.bearing_stiffness_N_m")->distribution.toml() ==
          "{ distribution = \"lognormal\", median = 110000000, cv = 0.5 }");
    CHECK(study.detection.confidence == 0.9);
}

TEST_CASE("An override of a key removes it from [random], in any order of overrides") {
    const std::string stiffness = "gearbox.planet.bearing_stiffness_N_m";
    const Study fixed = study_of(kExampleStudy, {stiffness + "=3e8"});
    CHECK(fixed.find_random(stiffness) == nullptr);
    CHECK(fixed.random.size() == 2);
    CHECK(*fixed.gearbox.bodies[Member::planet].bearing_stiffness_N_m == 3e8);
    CHECK(study_of(resolved_text(fixed)) == fixed);
    CHECK(study_of(kExampleStudy, {"sensor={sampling_Hz=5000, low_pass_Hz=800, "
                                   "encoder_sampling_Hz=5000, path_exponent=0.2}"})
              .find_random("sensor.path_exponent") == nullptr);

    // An override of [random] keeps the section's nominal value, and vice versa.
    CHECK(study_of(kExampleStudy, {"random." + stiffness + ".cv=0.5"})
              .gearbox.bodies[Member::planet]
              .bearing_stiffness_N_m == 1e8);
    const std::string plain = stiffness + "=3e8",
                      whole = "random." + stiffness + "={distribution='uniform', low=1, high=2}",
                      part = "random." + stiffness + ".cv=0.5";
    for (const std::string& random : {whole, part}) {
        const Study both = study_of(kExampleStudy, {plain, random});
        CHECK(both == study_of(kExampleStudy, {random, plain}));
        CHECK(*both.gearbox.bodies[Member::planet].bearing_stiffness_N_m == 3e8);
        REQUIRE(both.find_random(stiffness) != nullptr);
        CHECK(both.find_random(stiffness)->distribution ==
              study_of(kExampleStudy, {random}).find_random(stiffness)->distribution);
    }
}

TEST_CASE("An override may be a distribution, and a notice names each one that it removes") {
    const std::string stiffness = "gearbox.planet.bearing_stiffness_N_m";
    const std::string law = "={distribution='uniform', low=1e8, high=2e8}";
    CHECK(study_of(kExampleStudy, {stiffness + law}) ==
          study_of(kExampleStudy, {"random." + stiffness + law}));
    const StudyReading fixed = read_study_text(kExampleStudy, "study.toml", {stiffness + "=3e8"});
    REQUIRE(fixed.notices.size() == 1);
    CHECK(fixed.notices[0].file == "--set");
    CHECK(fixed.notices[0].key == stiffness);
    CHECK(fixed.notices[0].what.find("all gearboxes have this value") != std::string::npos);
    CHECK(read_study_text(kExampleStudy, "study.toml", {stiffness + law}).notices.empty());
    CHECK(read_study_text(kExampleStudy, "study.toml", {"ensemble.seed=3"}).notices.empty());
}

TEST_CASE("By default the sun is driven, and the ring where the sun is fixed") {
    const auto input_of = [](const std::string& fixed, const std::string& speed) {
        return study_of(example_with("carrier_speed_rpm", speed), {"operation.fixed=" + fixed});
    };
    const Study ring = input_of("ring", "sun_speed_rpm"),
                sun = input_of("sun", "carrier_speed_rpm"),
                carrier = input_of("carrier", "sun_speed_rpm");
    CHECK(ring.operation.input == Member::sun);
    CHECK(sun.operation.input == Member::ring);
    CHECK(carrier.operation.input == Member::sun);
    CHECK(resolved_text(sun).find("\ninput = \"ring\"\n") != std::string::npos);
    CHECK(study_of(resolved_text(sun)) == sun);
    CHECK(study_of(example_with("carrier_speed_rpm", "sun_speed_rpm"),
                   {"operation.fixed=carrier", "operation.input=ring"})
              .operation.input == Member::ring);
}

TEST_CASE("Zero run-in periods mean the program's choice and are the default") {
    CHECK(study_of(kExampleStudy).numerics.max_meshes == 0);
    CHECK(study_of(kExampleStudy, {"numerics.max_meshes=1000000"}).numerics.max_meshes == 1000000);
    CHECK(study_of(kExampleStudy, {"operation.torque_N_m=0"}).operation.torque_N_m == 0.0);
}

TEST_CASE("An override disables tones and pitch errors of the file") {
    const std::string toned =
        replaced(kFixedShaftStudy, "[sensor]",
                 "[sensor]\ntones = [{ frequency_Hz = 50, amplitude_m_s2 = 3 }]");
    CHECK(study_of(toned).sensor.tones.size() == 1);
    CHECK(study_of(toned, {"sensor.tones=[]"}) == study_of(kFixedShaftStudy));
    const std::vector<std::string> rough{"numerics.horizon=full", "gearbox.pitch_error_um=3"};
    auto smooth = rough;
    smooth.push_back("gearbox.pitch_error_um=0");
    CHECK(study_of(kQuasiStaticStudy, rough).errors.pitch_error_m == Approx(3e-6));
    CHECK(study_of(kQuasiStaticStudy, smooth).errors.pitch_error_m == 0.0);
}

TEST_CASE("Spellings of earlier versions are accepted, and their keys ignored, with a notice") {
    const auto [former, equal, remedy] =
        GENERATE(table<std::string, std::vector<std::string>, std::string>(
            {{"numerics.horizon=march", {"numerics.horizon=full"}, "write \"full\""},
             {"numerics.step_tolerance=1e-5", {}, "remove it"}}));
    const auto reading = read_study_text(kExampleStudy, "s.toml", {former});
    REQUIRE(reading.study);
    CHECK(*reading.study == study_of(kExampleStudy, equal));
    REQUIRE(reading.notices.size() == 1);
    CHECK(reading.notices[0].key == former.substr(0, former.find('=')));
    CHECK(reading.notices[0].remedy == remedy);
    CHECK(read_study_text(kExampleStudy, "s.toml", {}).notices.empty());
}

TEST_CASE("Integrators of earlier versions are refused, with the one to use instead") {
    const std::string key = "numerics.integrator=";
    const auto [former, current] = GENERATE(table<std::string, std::string>(
        {{"bs3", "rk4"}, {"bathe", "sdirk3"}, {"generalized-alpha", "sdirk3"}}));
    const auto refused = read_study_text(kExampleStudy, "s.toml", {key + former});
    CHECK(!refused.study);
    REQUIRE(refused.problems.size() == 1);
    CHECK(refused.problems[0].key == "numerics.integrator");
    CHECK(refused.problems[0].what == "\"" + former + "\" of an earlier version was removed");
    CHECK(refused.problems[0].remedy == "use \"" + current + "\"");
    CHECK(read_study_text(kExampleStudy, "s.toml", {key + current}).study);
}

TEST_CASE("Keys of members are read in the spelling without tables, with one notice") {
    const Study study = study_of(kExampleStudy);
    std::string text = kExampleStudy;
    for (const auto& [now, former] :
         {std::pair{"sun.teeth", "sun_teeth"}, std::pair{"planet.mass_kg", "planet_mass_kg"},
          std::pair{"gearbox.planet.bearing", "gearbox.planet_bearing"}}) {
        text.replace(text.find(now), std::string(now).size(), former);
    }
    const StudyReading reading = read_study_text(text, "s.toml");
    REQUIRE(reading.study);
    CHECK(*reading.study == study);
    REQUIRE(reading.notices.size() == 1);
    CHECK(reading.notices[0].line > 0);
    CHECK(reading.notices[0].what == "is the spelling of an earlier version");
    CHECK_THAT(reading.notices[0].remedy,
               Catch::StartsWith("write ") && Catch::Contains(", and 2 more keys in the same way"));
    // Options replace values of either spelling.
    for (const char* key : {"gearbox.sun_mass_kg=2", "gearbox.sun.mass_kg=2"}) {
        const StudyReading changed = read_study_text(text, "s.toml", {key});
        REQUIRE(changed.study);
        CHECK(changed.study->gearbox.bodies[Member::sun].mass_kg == 2.0);
        CHECK(changed.notices.size() == 1);
    }
    CHECK(study_of(text, {"gearbox.planet_bearing_stiffness_N_m=3e8"}).random.size() == 2);
    const StudyReading twice =
        read_study_text(example_with("sun.teeth = 19", "sun.teeth = 19\nsun_teeth = 19"), "s.toml");
    REQUIRE(twice.problems.size() == 1);
    CHECK(twice.problems[0].key == "gearbox.sun_teeth");
    CHECK(twice.problems[0].what == "is also given as gearbox.sun.teeth");
    // Correlations and lists of inputs.
    const std::string pair =
        "random.correlations=[{between=['gearbox.planet_bearing_stiffness_N_m', "
        "'sensor.path_exponent'], rank=0.5}]";
    CHECK(study_of(kExampleStudy, {pair}).correlations[0].first ==
          "gearbox.planet.bearing_stiffness_N_m");
}

TEST_CASE("A removed key is refused with a remedy, and ignored where it has no effect") {
    const auto read = [](const std::string& line) {
        return read_study_text(example_with("[operation]", line + "\n[operation]"), "s.toml");
    };
    for (const char* line :
         {"planet_mass_scatter = 0.01", "sun_root_relief_um = 3", "sun.root_relief_um = 3",
          "relief_shape = \"parabolic\"", "planet_bearing_stiffness_factors = [1, 1, 1, 2]"}) {
        INFO(line);
        const StudyReading reading = read(line);
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].what == "was removed");
        CHECK(reading.problems[0].line > 0);
        CHECK_FALSE(reading.problems[0].remedy.empty());
    }
    for (const char* line : {"planet_mass_scatter = 0", "relief_shape = \"linear\""}) {
        const StudyReading reading = read(line);
        REQUIRE(reading.study);
        CHECK(*reading.study == study_of(kExampleStudy));
        REQUIRE(reading.notices.size() == 1);
        CHECK(reading.notices[0].what == "belongs to an earlier version and is ignored");
    }
}

TEST_CASE("The resolved text gives the same study, bit for bit") {
    std::vector<Study> studies{study_of(kExampleStudy), constant_study()};
    for (const std::string& text : {kFixedShaftStudy, kQuasiStaticStudy, kSpatialCrackStudy}) {
        studies.push_back(study_of(text));
    }
    studies.push_back(
        study_of(kFixedShaftStudy,
                 {"sensor.tones=[{frequency_Hz=0.1, amplitude_m_s2=0.7}, {frequency_Hz=50, "
                  "amplitude_m_s2=3}]",
                  "sensor.position=gear",
                  "random.gearbox.gear.bearing_damping_N_s_m={distribution="
                  "'lognormal', median=1.8e5, cv=0.3}",
                  "numerics.integrator=sdirk3", "effects.shear=false"}));
    studies.push_back(study_of(kQuasiStaticStudy,
                               {"random.fault.reduction={distribution='uniform', low=0, high=0.3}",
                                "detection.size_edges=[0, 0.1, 0.3]"}));
    studies.push_back(study_of(example_with("\"levels\", values = [0, 1, 2, 3, 4.3]",
                                            "\"triangular\", low = 0.1, mode = 0.7, high = 3.3"),
                               {"detection.size_edges_mm=[0.1, 0.7, 1.1, 3.3]",
                                "title=\"a \\\"quoted\\\" \\\\ title é\""}));
    studies.push_back(study_of(
        kExampleStudy, {"random.sensor.noise_m_s2 = {distribution='uniform', "
                        "low = 0.1, high = 0.2}",
                        "fault.angle_deg = 51.3", "gearbox.module_mm=0.7",
                        "random.fault.depth_mm.values=[0.1, 0.3]", "features.use=['te_fc']"}));
    for (const Study& study : studies) {
        const std::string text = resolved_text(study);
        INFO(text);
        CHECK(study_of(text) == study);
        CHECK(resolved_text(study_of(text)) == text);
    }
    CHECK(resolved_text(studies[0]).find("module_mm = 3.175\n") != std::string::npos);
}

TEST_CASE("The resolved text contains every key that may be given") {
    const std::string text = resolved_text(study_of(kExampleStudy));
    // Keys whose absence has a meaning.
    std::istringstream words(
        "inertia speed size_edges_mm planet_positions shift tip_mm "
        "centre_distance relief_um crowning_um normal_module "
        "ring_to_sun_phase bore rim_mm web_mm outer error crack_law "
        "noise_density range_m_s2 cross_axis uncertain_inputs chosen_values tones bearings stages additional "
        "background_Hz "
        "interval_h "
        "record_ "
        "housing_modes response_Hz "
        "false_alarms_per_ interpolation_tolerance "
        "torque_noise pin_ python index_um quality");
    const std::vector<std::string> without_default{std::istream_iterator<std::string>(words), {}};
    const auto shows = [&](const Key& key) {
        const std::size_t begin = text.find("[" + key.table() + "]\n");
        const std::size_t end = std::min(text.find("\n[", begin), text.size());
        return begin != std::string::npos &&
               text.substr(begin, end - begin).find("\n" + std::string(key.label()) + " = ") !=
                   std::string::npos;
    };
    for (const Key& key : schema()) {
        const bool optional_here =
            key.presence(study_of(kExampleStudy)).need == Need::optional &&
            std::any_of(without_default.begin(), without_default.end(), [&](const auto& part) {
                return key.name.find(part) != std::string_view::npos;
            });
        const bool forbidden = key.presence(study_of(kExampleStudy)).need == Need::forbidden;
        INFO(key.path());
        CHECK((optional_here || forbidden || shows(key)));
    }
}

TEST_CASE("A gearbox of constant stiffness may have teeth or none") {
    CHECK_FALSE(constant_study().gearbox.has_teeth());
    const Study study = study_of(
        kExampleStudy, {"gearbox.tooth_profile='constant'", "gearbox.sun_planet.stiffness_N_m=1e8",
                        "gearbox.ring_planet.stiffness_N_m=1e8", "fault.kind='none'"});
    CHECK(study.gearbox.has_teeth());
    CHECK(*study.gearbox.meshes[MeshKind::sun_planet].stiffness_N_m == 1e8);
}

TEST_CASE("Size groups are the levels in ascending order, or lie between the edges") {
    const Study levels = study_of(kExampleStudy, {"random.fault.depth_mm.values=[3, 0, 3, 1]"});
    const auto groups = size_groups(levels);
    REQUIRE(groups.size() == 3);
    CHECK(groups[0].low == 0.0);
    CHECK(groups[2].low == 3 * 1e-3);
    CHECK(groups[2].high == groups[2].low);
    CHECK(fault_sizes(levels) == std::vector<double>{1e-3, 3 * 1e-3});

    const Study edges = study_of(
        example_with("\"levels\", values = [0, 1, 2, 3, 4.3]", "\"uniform\", low = 0, high = 4"),
        {"detection.size_edges_mm=[0, 1, 4]"});
    REQUIRE(size_groups(edges).size() == 2);
    CHECK(size_groups(edges)[1].low == 1e-3);
    CHECK(size_groups(edges)[1].high == 4 * 1e-3);
    CHECK(detection_request(edges).noise_levels == edges.sensor.noise_levels);
    CHECK(size_groups(study_of(kExampleStudy, {"fault.kind='none'"})).size() == 1);
}

TEST_CASE("Each kind of fault has one size, with its unit") {
    const std::pair<const char*, const char*> columns[] = {{"none", "fault_depth_m"},
                                                           {"crack", "fault_depth_m"},
                                                           {"spatial-crack", "fault_stage"},
                                                           {"chip", "fault_chip_m"},
                                                           {"breakage", "fault_break_width_m"},
                                                           {"pitting", "fault_pit_width_m"},
                                                           {"wear", "fault_wear_m"},
                                                           {"broken", "fault_broken"},
                                                           {"reduction", "fault_reduction"}};
    CHECK(std::size(columns) == all_faults().size() + 1);
    for (const auto& [kind, column] : columns) {
        Study study;
        study.fault.kind = find_fault(kind);
        CHECK(fault_size_column(study) == column);
        CHECK(fault_size_key(study).may_be_random());
        CHECK(detection_request(study).size.name == column);
        const bool length = std::string_view(column).ends_with("_m");
        CHECK(detection_request(study).size.unit == (length ? "m" : "1"));
    }
    const Study edges = study_of(
        kQuasiStaticStudy, {"random.fault.reduction={distribution='uniform', low=0, high=0.3}",
                            "detection.size_edges=[0, 0.1, 0.3]"});
    REQUIRE(size_groups(edges).size() == 2);
    CHECK(size_groups(edges)[1].low == 0.1);
    CHECK(size_groups(study_of(kSpatialCrackStudy)).front().high == 5.0);
    CHECK(size_groups(study_of(kFixedShaftStudy)).front().high == 8 * 1e-3);
}

TEST_CASE(
    "Options that are impossible for some degrees of freedom or gearboxes are off by default") {
    const Study quasi = study_of(kQuasiStaticStudy), shaft = study_of(kFixedShaftStudy);
    CHECK(quasi.effects.path == nullptr);
    CHECK(shaft.effects.path == nullptr);
    CHECK(study_of(kExampleStudy).effects.path->name == "hamming");
    CHECK(quasi.features.use ==
          std::vector<std::string>{"te_rms", "te_kurtosis", "te_fc", "te_fm0"});
    CHECK(shaft.features.use.size() == 7);
    CHECK(quasi.operation.torque_on == Member::carrier);
    CHECK(study_of(kExampleStudy, {"operation.input=carrier"}).operation.torque_on == Member::sun);
}

TEST_CASE("A study can name every path window, and none") {
    for (const gearpod::signals::PathWindow& window : gearpod::signals::path_windows()) {
        const Study study = study_of(kExampleStudy, {"effects.path=" + std::string(window.name)});
        CHECK(study.effects.path == &window);
        CHECK(choice_text(study, "effects", "path") == window.name);
        CHECK(study_of(resolved_text(study)) == study);
    }
    CHECK(choice_text(study_of(kQuasiStaticStudy), "effects", "path") == "none");
}

TEST_CASE("Lists of errors keep their order and are converted to SI units") {
    const Study study = study_of(kSpatialCrackStudy);
    const auto& meshes = study.gearbox.meshes;
    CHECK(meshes[MeshKind::sun_planet].error_m == std::vector<double>{10 * 1e-6, 2 * 1e-6});
    CHECK(meshes[MeshKind::ring_planet].error_phase_rad[1] == Approx(M_PI / 2));
    CHECK(meshes[MeshKind::sun_planet].error_phase_rad.empty());
    CHECK(study.gearbox.backlash_m == 0.1 * 1e-3);
}

TEST_CASE("Edit distances match the literature") {
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("saturday", "sunday") == 3);
    CHECK(edit_distance("ca", "ac") == 1);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(without_unit("planet_bearing_stiffness_N_m") == "planet_bearing_stiffness");
    CHECK(without_unit("sun_inertia_kg_m2") == "sun_inertia");
    CHECK(without_unit("teeth") == "teeth");
}

TEST_CASE("The help lists every key of the schema with its section") {
    const std::string help = schema_help();
    for (const Key& key : schema()) {
        CHECK(help.find("\n  " + std::string(key.label()) + "\n") != std::string::npos);
        CHECK(help.find("[" + key.table() + "]\n") != std::string::npos);
        CHECK((key.unit.suffix.empty() || key.name.ends_with("_" + std::string(key.unit.suffix))));
    }
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
        CHECK(line.size() <= 80);
    }
    const std::string sensor = schema_help("SENSOR");
    CHECK_THAT(sensor, Catch::StartsWith("[") && Catch::Contains("\n  noise_levels\n"));
    CHECK(sensor.find("\n  teeth\n") == std::string::npos);
    CHECK(sensor.size() < help.size() / 3);
    CHECK(schema_help("no such word") == "");
}

// Checks that a study gives the parameter of its law of mesh damping, and of no other.

template <class Law>
void check_law(MeshDamping kind) {
    Study study = study_of(kExampleStudy);
    const Key* const key = find_key("gearbox", Law::kParameter.key);
    REQUIRE(key != nullptr);
    INFO(key->path());
    CHECK((key->unit.suffix.empty() || key->name.ends_with(key->unit.suffix)));
    CHECK(key->unit.to_si == 1.0);
    CHECK(key->may_be_random());
    for (const ChoiceName& other :
         std::get<ChoiceAccess>(find_key("effects", "mesh_damping")->access).names) {
        study.effects.mesh_damping = static_cast<MeshDamping>(other.value);
        const bool own = study.effects.mesh_damping == kind;
        CHECK(key->presence(study).need == (own ? Need::required : Need::forbidden));
    }
    std::get<NumberAccess>(key->access).set(study, 0.5);
    CHECK(study.gearbox.mesh_damping[kind] == 0.5);
    study.effects.motion = Motion::quasi_static;
    CHECK(key->presence(study).need == Need::optional);
}

TEST_CASE("The parameter of a law of mesh damping belongs to that law only") {
#define GEARPOD_MESH_DAMPING(NAME, LAW) check_law<dynamics::LAW>(MeshDamping::NAME);
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
}

}  // namespace gearpod::mc::test_study
