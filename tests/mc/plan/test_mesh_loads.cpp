// Checks the nominal mesh loads of studies, and the warnings of torques that cannot be meant.
#include "mc/plan/mesh_loads.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_mesh_loads {

using namespace test;

std::vector<std::string> studies_with_gears() {
    std::vector<std::string> names = shipped_studies();
    std::erase_if(names,
                  [](const std::string& name) { return !mc::has_gears(shipped_study(name)); });
    return names;
}

// Warnings of a study whose torque, and given load torque, are multiplied by a factor.
mc::Problems warnings_with(mc::Study study, double factor) {
    std::erase_if(study.random,
                  [](const mc::RandomInput& input) { return input.key.starts_with("operation."); });
    study.operation.torque_N_m *= factor;
    if (study.operation.load_torque_N_m) {
        *study.operation.load_torque_N_m *= factor;
    }
    return mc::load_warnings(study, "study.toml");
}

// Sources: forces by hand, torque over base radius and planets. 1405 N m on a sun with 27 teeth of
// module 3.175 mm: 42.8625 mm cos(20 deg) = 40.2776 mm, four planets.
TEST_CASE("the mesh force of a study is its torque over base radius and planets") {
    const auto loads = mc::mesh_loads(shipped_study("helicopter-life.toml"));
    REQUIRE(loads.size() == 2);
    CHECK(loads[0].force_N == Approx(1405.0 / 0.0402776 / 4.0).epsilon(1e-5));
    CHECK(loads[1].force_N == loads[0].force_N);
    REQUIRE(loads[0].stress);
    REQUIRE(loads[1].stress);
    // The flanks of planet and ring curve in the same sense.
    CHECK(loads[1].stress->contact_Pa < loads[0].stress->contact_Pa);
    CHECK(loads[0].deflection_m > 1e-6);
    CHECK(loads[0].deflection_m < 1e-4);
}

TEST_CASE("no shipped study has a torque that cannot be meant") {
    for (const std::string& name : studies_with_gears()) {
        INFO(name);
        const mc::Problems warnings = mc::load_warnings(shipped_study(name), name);
        INFO(mc::format(warnings));
        CHECK(warnings.empty());
    }
}

TEST_CASE("a torque 1,000 times too large or too small is noticed in every shipped study") {
    for (const std::string& name : studies_with_gears()) {
        INFO(name);
        const mc::Study study = shipped_study(name);
        const mc::Problems much = warnings_with(study, 1e3), little = warnings_with(study, 1e-3);
        REQUIRE(much.size() == 1);
        CHECK(much[0].key == "operation.torque_N_m");
        CHECK(contains(much[0].what, "more than any gear steel withstands"));
        CHECK(contains(much[0].remedy, "not N mm"));
        REQUIRE(little.size() == 1);
        CHECK(contains(little[0].what, "nearly unloaded"));
        CHECK(contains(little[0].remedy, "not kN m"));
        const mc::Problems none = warnings_with(study, 0.0);
        REQUIRE(none.size() == 1);
        CHECK_FALSE(contains(none[0].what, "()"));
    }
}

TEST_CASE("describe prints tooth stresses, and describe and run warn of the torque") {
    const Folder folder;
    const std::string few = " " + test::study("planet-crack-ideal.toml") +
                            " --set ensemble.instances=2 --set ensemble.threshold_instances=1";
    const auto usual = require_success("describe" + few);
    check_mentions(usual, {"sun-planet load",
                           "nominal ones of ISO 6336, method B, at the nominal torque, shared"});
    CHECK(!usual.mentions("check the torque"));
    const std::string large = " --set operation.torque_N_m=450000",
                      small = " --set operation.torque_N_m=0.45";
    CHECK(program("describe" + few + large).mentions("check the unit (N m, not N mm)"));
    CHECK(program("describe" + few + small).mentions("check the unit (N m, not kN m)"));
    check_mentions(program("run" + few + small + " --quiet --out " + folder.file("r.h5")),
                   {"operation.torque_N_m: 0.45 N m on the sun leaves the teeth"});
}

}  // namespace gearpod::test_mesh_loads
