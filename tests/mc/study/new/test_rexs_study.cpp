// Checks gearpod new --rexs: studies from gear-unit models.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "mc/numerics/study_scene.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/new/rexs_study.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study/new/rexs_example.hpp"

namespace test_rexs_study {

using namespace gearpod;
using test::Folder;
using test::program;

namespace {

struct Made {
    mc::NewStudy made;
    std::optional<mc::Study> study;
    std::string problems, notices;
    bool refused_with(const std::string& text) const {
        return problems.find(text) != std::string::npos;
    }
    bool notes(const std::string& text) const { return notices.find(text) != std::string::npos; }
};

Made make(const std::string& text, const mc::RexsChoices& choices = {}) {
    const Folder folder;
    const std::string file = folder.file("model.rexs");
    std::ofstream(file, std::ios::binary) << text;
    Made result;
    result.made = new_from_rexs(file, choices, "new --rexs model.rexs");
    result.problems = format(result.made.problems);
    result.notices = format(result.made.notices);
    if (!result.made.text.empty()) {
        result.study = mc::read_study_text(result.made.text, "s.toml").study;
        CHECK(make_scene("s.toml", mc::read_study_text(result.made.text, "s.toml")));
    }
    return result;
}

mc::RexsChoices stage(const std::string& id) {
    mc::RexsChoices choices;
    choices.stage = id;
    return choices;
}

double width_mm(const mc::Study& study) {
    return 1e3 * *study.gearbox.face_width_m;
}

}  // namespace

TEST_CASE("A planetary stage of a REXS model becomes a study with its values") {
    const Made made = make(test::planetary_example().text());
    INFO(made.problems);
    REQUIRE(made.study);
    const mc::Study& study = *made.study;
    CHECK(mc::teeth_of(study, mc::Member::sun) == 20);
    CHECK(mc::teeth_of(study, mc::Member::planet) == 28);
    CHECK(mc::teeth_of(study, mc::Member::ring) == 76);
    CHECK(study.gearbox.planets == 3);
    CHECK(1e3 * mc::centre_distance_m(study) == Approx(48));
    CHECK(width_mm(study) == Approx(20));
    CHECK(*study.gearbox.young_modulus_Pa == Approx(2.1e11));
    CHECK(*study.gearbox.poisson_ratio == Approx(0.29));
    CHECK(study.operation.torque_N_m == Approx(30.5));
    CHECK(*study.operation.sun_speed_rad_s == Approx(1500 * M_PI / 30));
    CHECK(*study.gearbox.bodies[mc::Member::planet].bearing_stiffness_N_m == Approx(2.5e8));
    CHECK(made.notes("not in the model, by rule or chosen: "));
    CHECK(made.notes("sun's shift"));
    CHECK(made.notes("1 gear_casing"));
    // The study states the same.
    CHECK(made.made.text.find("Not taken from the model") != std::string::npos);
}

TEST_CASE("Units of REXS attributes are respected, and unknown ones refused") {
    test::RexsExample m = test::planetary_example();
    m.set(10, "normal_module", "m", "0.002");
    m.set(10, "face_width", "m", "0.02");
    m.set(10, "normal_pressure_angle", "rad", "0.3490658503988659");
    m.set(11, "normal_pressure_angle", "\xc2\xb0", "20");
    m.set(21, "tip_diameter", "mum", "60000");
    m.set(22, "tip_diameter", "mm", "60");
    m.set(23, "tip_diameter", "cm", "6");
    m.set(90, "elastic_modulus", "GPa", "210");
    m.set(80, "torque_around_u_axis", "N mm", "30500");
    m.set(50, "rotational_speed", "1 / s", "25");
    m.set(101, "radial_stiffness", "N / mm", "250000");
    const Made made = make(m.text());
    INFO(made.problems);
    REQUIRE(made.study);
    CHECK(width_mm(*made.study) == Approx(20));
    CHECK(1e3 * *made.study->gearbox.module_m == Approx(2));
    CHECK(1e3 * *made.study->gearbox.bodies[mc::Member::planet].tip_diameter_m == Approx(60));
    CHECK(*made.study->gearbox.young_modulus_Pa == Approx(2.1e11));
    CHECK(made.study->operation.torque_N_m == Approx(30.5));
    CHECK(*made.study->operation.sun_speed_rad_s == Approx(1500 * M_PI / 30));
    CHECK(*made.study->gearbox.bodies[mc::Member::planet].bearing_stiffness_N_m == Approx(2.5e8));

    m.set(10, "normal_module", "furlong", "2");
    m.set(11, "face_width", "", "20");
    m.set(90, "elastic_modulus", "mm", "210000");
    const Made refused = make(m.text());
    INFO(refused.problems);
    CHECK(refused.refused_with("cylindrical_gear 10: normal_module: unit furlong is not known"));
    CHECK(refused.refused_with("ring_gear 11: face_width: states no unit"));
    CHECK(refused.refused_with("material 90: elastic_modulus: unit mm is not known"));
    CHECK(std::count(refused.problems.begin(), refused.problems.end(), '\n') == 3);
}

TEST_CASE("Contradictions of a REXS model are refused with both values, all at once") {
    test::RexsExample m = test::planetary_example();
    m.set(22, "number_of_teeth", "none", "29");
    m.set(32, "center_distance", "mm", "49");
    m.set(11, "normal_module", "mm", "2.5");
    const Made refused = make(m.text());
    INFO(refused.problems);
    CHECK(refused.refused_with("number_of_teeth: is 29, but cylindrical_gear 21 has 28"));
    CHECK(refused.refused_with("center_distance: is 49, but cylindrical_stage 31 has 48"));
    CHECK(refused.refused_with("normal_module: is 2.5, but that of cylindrical_gear 10 is 2"));

    m = test::planetary_example();
    for (const int gear : {10, 11, 21, 22, 23}) {
        m.set(gear, "addendum_modification_coefficient", "none", "0");
    }
    for (int i = 1; i <= 3; ++i) {
        m.set(30 + i, "center_distance", "mm", "50");
        m.set(40 + i, "center_distance", "mm", "50");
    }
    const Made distance = make(m.text());
    INFO(distance.problems);
    CHECK(distance.refused_with("cylindrical_stage 31: center_distance: is 50 mm"));
    CHECK(distance.refused_with("fit at 48 mm"));
    CHECK(distance.made.problems.size() == 2);

    m = test::planetary_example();
    m.set(52, "rotational_speed", "1 / min", "400");  // 1500 * 20 / 96 = 312.5 rpm
    const Made speed = make(m.text());
    INFO(speed.problems);
    CHECK(speed.refused_with("400 rpm contradict 1500 rpm of shaft 50"));
    m.set(52, "rotational_speed", "1 / min", "-312.5");
    CHECK(make(m.text()).study);

    m = test::planetary_example();
    m.set(1, "number_of_planets", "none", "4");
    CHECK(make(m.text()).refused_with("is 4, but the model has 3 planet gears"));
    m = test::planetary_example();
    m.set(51, "rotational_speed", "1 / min", "12");
    CHECK(make(m.text()).refused_with("the ring is not the fixed member"));
}

// Shifts of 0.581 and 0.5131 fit 23 and 67 teeth of 30 degrees at 53 mm.
TEST_CASE("A model with several gear pairs needs a stage, and speed and torque follow it") {
    test::RexsExample m = test::two_pairs_example();
    const Made several = make(m.text());
    INFO(several.problems);
    CHECK(several.refused_with("the model has 2 stages"));
    CHECK(
        several.refused_with("1 (cylindrical_stage, 23/67 teeth); 2 (cylindrical_stage, 20/76 "
                             "teeth)"));
    CHECK(make(m.text(), stage("7")).refused_with("there is no stage 7"));

    m.set(10, "addendum_modification_coefficient", "none", "0.581");
    m.set(11, "addendum_modification_coefficient", "none", "0.5131");
    const Made first = make(m.text(), stage("1"));
    INFO(first.problems);
    REQUIRE(first.study);
    CHECK(first.study->gearbox.kind == mc::GearboxKind::fixed_shaft);
    CHECK(first.study->operation.torque_N_m == Approx(4.7));
    CHECK(*first.study->operation.pinion_speed_rad_s == Approx(1400 * M_PI / 30));
    CHECK(first.study->gearbox.helix_angle_rad == Approx(M_PI / 6));
    CHECK(1e3 * mc::centre_distance_m(*first.study) == Approx(53));

    const Made second = make(m.text(), stage("2"));
    INFO(second.problems);
    REQUIRE(second.study);
    CHECK(second.study->operation.torque_N_m == Approx(4.7 * 67 / 23));
    CHECK(*second.study->operation.pinion_speed_rad_s == Approx(1400 * M_PI / 30 * 23 / 67));

    // The torque of a load that brakes: the gear at the other end drives.
    m.set(80, "torque_around_u_axis", "N m", "-4.7");
    const Made reversed = make(m.text(), stage("1"));
    INFO(reversed.problems);
    REQUIRE(reversed.study);
    CHECK(mc::teeth_of(*reversed.study, mc::Member::pinion) == 67);
    CHECK(reversed.study->operation.torque_N_m == Approx(4.7 * 67 / 23));

    m.set(11, "helix_angle_reference_diameter", "deg", "30");
    CHECK(make(m.text(), stage("1")).refused_with("opposite hands"));
}

TEST_CASE("Loads that a model lacks are required as options") {
    test::RexsExample m = test::planetary_example();
    m.attributes[50].clear();
    const Made lacking = make(m.text());
    CHECK(
        lacking.refused_with("--torque, --speed, --power: the model states a torque, but no "
                             "speed"));
    mc::RexsChoices choices;
    choices.speed_rpm = 900;
    const Made given = make(m.text(), choices);
    REQUIRE(given.study);
    CHECK(*given.study->operation.sun_speed_rad_s == Approx(30 * M_PI));
    // A driving carrier has the torque and speed that balance the sun's.
    choices.input = "carrier";
    choices.speed_rpm.reset();
    const Made carrier = make(test::planetary_example().text(), choices);
    INFO(carrier.problems);
    REQUIRE(carrier.study);
    CHECK(carrier.study->operation.torque_N_m == Approx(30.5 * 96 / 20));
    CHECK(*carrier.study->operation.carrier_speed_rad_s == Approx(1500 * M_PI / 30 * 20 / 96));
}

TEST_CASE("Load cases replace attributes, and several need a choice") {
    test::RexsExample m = test::planetary_example();
    const auto load_case = [](const char* id, const char* torque) {
        return std::string("<load_case id=\"") + id +
               "\"><component id=\"80\" type=\"external_load\"><attribute "
               "id=\"torque_around_u_axis\" unit=\"N m\">" +
               torque + "</attribute></component></load_case>";
    };
    m.load_spectrum = "<load_spectrum id=\"1\">" + load_case("1", "12") + "</load_spectrum>";
    const Made one = make(m.text());
    REQUIRE(one.study);
    CHECK(one.study->operation.torque_N_m == Approx(12));
    m.load_spectrum = "<load_spectrum id=\"1\">" + load_case("1", "12") + load_case("2", "14") +
                      "</load_spectrum>";
    CHECK(make(m.text()).refused_with("--load-case: the model has 2 load cases; choose one: 1, 2"));
    mc::RexsChoices choices;
    choices.load_case = "2";
    const Made two = make(m.text(), choices);
    REQUIRE(two.study);
    CHECK(two.study->operation.torque_N_m == Approx(14));
}

TEST_CASE("What a study does not take from a model is named") {
    test::RexsExample m = test::planetary_example();
    m.add(95, "flank_geometry");
    m.set(95, "width_crowning", "mum", "8");
    m.set(95, "grinding_allowance", "mm", "0.0");
    m.relate("flank", {{"gear", 10}, {"left", 95}, {"right", 95}});
    m.add(96, "shaft_section");
    m.set(101, "radial_stiffness", "N / m", "1e20");
    m.set(101, "axial_stiffness", "N / m", "3e7");
    const Made made = make(m.text());
    INFO(made.notices);
    REQUIRE(made.study);
    CHECK(made.notes("flank_geometry: width_crowning (8 mum)"));
    CHECK(!made.notes("grinding_allowance"));
    CHECK(made.notes("1 shaft_section"));
    CHECK(made.notes("concept_bearing 101 (1e+20 N/m)"));
    CHECK(made.notes("axial_stiffness (3e7 N / m)"));
}

TEST_CASE("Every version of REXS 1 is read, and others refused") {
    test::RexsExample m = test::planetary_example();
    for (const char* version : {"1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6"}) {
        m.version = version;
        const Made made = make(m.text());
        INFO(version);
        CHECK(made.study);
        CHECK(!made.notes("newer"));
    }
    m.version = "1.7";
    CHECK(make(m.text()).notes("version 1.7 is newer than 1.6"));
    for (const char* version : {"2.0", "1.x", "1.", "one"}) {
        m.version = version;
        CHECK(make(m.text()).refused_with("version " + std::string(version) +
                                          " of REXS is not known"));
    }
    m.version = "";
    CHECK(make(m.text()).refused_with("states no version"));
}

TEST_CASE("Hostile and foreign files are refused with their reason") {
    test::RexsExample m = test::planetary_example();
    m.prologue =
        "<!DOCTYPE bomb [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">"
        "<!ENTITY c \"&b;&b;&b;&b;\">]>\n";
    CHECK(make(m.text()).refused_with("document type declaration"));
    std::string deep;
    for (int i = 0; i < 300000; ++i) {
        deep += "<a>";
    }
    for (int i = 0; i < 300000; ++i) {
        deep += "</a>";
    }
    CHECK(make("<model version=\"1.4\">" + deep + "</model>").refused_with("nested more than"));
    CHECK(make("PK\x03\x04 archive").refused_with("ZIP archive"));
    CHECK(make("{\"model\": {}}").refused_with("JSON"));
    CHECK(make("").refused_with("is empty"));
    CHECK(make("<html></html>").refused_with("its root is <html>"));
    CHECK(make("<model version=\"1.4\"><components></model>").refused_with("not well-formed"));
    CHECK(make("<model version=\"1.4\"/>").refused_with("has no gear stages"));
    std::string many = "<model version=\"1.4\">";
    for (int i = 0; i < 2000001; ++i) {
        many += "<a/>";
    }
    CHECK(make(many + "</model>").refused_with("XML tags"));

    const Folder folder;
    const auto refusal = [](const std::string& path) {
        return mc::format(mc::new_from_rexs(path, {}, "new").problems);
    };
    const std::string pipe = folder.file("pipe.rexs");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(refusal(pipe).find("a pipe") != std::string::npos);
    CHECK(refusal(folder.path()).find("is a folder") != std::string::npos);
    CHECK(refusal(folder.file("none.rexs")).find("cannot be read (No such file") !=
          std::string::npos);
    const std::string huge = folder.file("huge.rexs");
    std::ofstream(huge) << "<model/>";
    std::filesystem::resize_file(huge, std::uintmax_t{1} << 30);
    CHECK(refusal(huge).find("has 1024 MB") != std::string::npos);
}

TEST_CASE("Stages that are not simulated are listed with the reason") {
    test::RexsExample m = test::two_pairs_example();
    m.add(3, "bevel_stage");
    m.types[11] = "ring_gear";
    const Made other = make(m.text(), stage("3"));
    INFO(other.problems);
    CHECK(other.refused_with("only planetary and cylindrical stages are simulated"));
    CHECK(make(m.text(), stage("1")).refused_with("internal gears on fixed shafts"));
    // The only possible one needs no choice.
    CHECK(make(m.text()).study);
    m.relations.push_back({"stage", {{"stage", 99}, {"gear_1", 10}}});
    CHECK(make(m.text()).refused_with("component 99 (stage) does not exist"));
}

TEST_CASE("new --rexs writes a study that is described, and refuses the model's own values") {
    const Folder folder;
    const std::string model = folder.file("m.rexs"), file = folder.file("m.toml");
    std::ofstream(model) << test::two_pairs_example().text();
    const auto written = program("new --rexs " + model + " --stage 2 --out " + file);
    INFO(written.output);
    REQUIRE(written.code == 0);
    CHECK(written.mentions("not in the model, by rule or chosen"));
    const auto described = program("describe " + file);
    INFO(described.output);
    CHECK(described.code == 0);
    CHECK(program("new --rexs " + model + " --stage 2 --out " + model + " --force").code == 2);
    for (const char* option : {"--sun 20", "--module 2", "planetary", "--planets 3"}) {
        INFO(option);
        CHECK(program("new --rexs " + model + " --stage 2 " + option).code == 2);
    }
    CHECK(program("new planetary --sun 20 --planet 28 --module 2 --stage 1 --torque 3 --speed 9")
              .code == 2);
    CHECK(program("new").code == 2);
    CHECK(program("new planetary --planet 28 --module 2 --torque 3 --speed 9").mentions("--sun"));
}

}  // namespace test_rexs_study
