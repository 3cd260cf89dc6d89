// Checks the share of time out of contact, from the tile to the results, the report and its JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "mc/numerics/numerical_error.hpp"
#include "mc/report/run_report.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/study/gears.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_contact_loss {

Study light_study(const std::vector<std::string>& more = {}) {
    Study study = test::shipped_study(
        "fleet-alarms.toml",
        test::joined({"operation.carrier_speed_rpm=20", "numerics.horizon=full",
                      "effects.contact_onset=abrupt", "sensor.noise_levels=[1]",
                      "ensemble.threshold_records=1", "detection.false_alarm_rate=0.05",
                      "random.operation.torque_N_m={distribution=\"uniform\",low=300,high=600}"},
                     more));
    study.ensemble.threshold_instances = 8;
    study.ensemble.instances = 8;
    return study;
}

TEST_CASE("Rows hold the share of time out of contact of each mesh, for any lanes") {
    const Results wide = test::run(light_study({"numerics.lanes=16"}));
    REQUIRE(wide.contact_loss.size() == 2);
    CHECK(wide.contact_loss[0].name == "sun-planet");
    CHECK(wide.contact_loss[1].name == "ring-planet");
    for (const RowColumn& mesh : wide.contact_loss) {
        REQUIRE(mesh.values.size() == wide.status.size());
        for (const double value : mesh.values) {
            CHECK(value >= 0.0);
            CHECK(value < 0.9);
        }
        CHECK(std::ranges::count(mesh.values, 0.0) < std::ssize(mesh.values) / 2);
    }
    const Results narrow = test::run(light_study({"numerics.lanes=4", "numerics.threads=2"}));
    for (std::size_t m = 0; m < 2; ++m) {
        CHECK(narrow.contact_loss[m].values == wide.contact_loss[m].values);
    }
    const Results superposed =
        test::run(light_study({"numerics.lanes=16", "numerics.horizon=superposed"}));
    for (std::size_t m = 0; m < 2; ++m) {
        CHECK(superposed.contact_loss[m].values == wide.contact_loss[m].values);
    }
}

TEST_CASE("Heavier loads keep teeth in contact longer") {
    const auto mean = [](double torque) {
        const Results results = test::run(light_study({fmt::format(
            "random.operation.torque_N_m={{distribution=\"constant\",value={}}}", torque)}));
        const auto meshes = summarise_contact_loss(results, ColumnRows(results));
        REQUIRE(meshes.size() == 2);
        CHECK(meshes[0].rows == 16);
        CHECK(meshes[0].lower <= meshes[0].median);
        CHECK(meshes[0].median <= meshes[0].upper);
        return meshes[0].mean;
    };
    const double light = mean(150), medium = mean(600), heavy = mean(6000);
    CHECK(light > medium);
    CHECK(medium > heavy);
    CHECK(heavy == 0.0);
}

TEST_CASE("The share of time out of contact has no value where teeth cannot separate") {
    const Study study = test::shipped_study(
        "planet-crack-ideal.toml", {"ensemble.instances=4", "ensemble.threshold_instances=4"});
    CHECK_FALSE(teeth_can_separate(study));
    Results results = test::run(study);
    CHECK(results.contact_loss.empty());
    CHECK(contact_loss_text(summarise_contact_loss(results, ColumnRows(results))).empty());
    results.detection = detect_all(results);
    CHECK(report_json(results, ColumnRows(results), std::nullopt)["contact_loss"].is_null());
    CHECK_FALSE(find_step_error(mc::Planner(study), 1e9));
}

TEST_CASE("The report's text and JSON contain the share of time out of contact") {
    Results results;
    results.group = {0, 1, 1, 1};
    results.status = {0, 0, 0, 1};
    results.contact_loss = {{"sun-planet", {0.1, 0.2, 0.3, NAN}},
                            {"ring-planet", {0.0, 0.0, 0.0, NAN}}};
    const auto meshes = summarise_contact_loss(results, ColumnRows(results));
    REQUIRE(meshes.size() == 2);
    CHECK(meshes[0].rows == 3);
    CHECK(meshes[0].mean == Approx(0.2));
    CHECK(meshes[0].median == Approx(0.2));
    CHECK(meshes[0].lower == Approx(0.11));
    CHECK(meshes[0].upper == Approx(0.29));
    CHECK(contact_loss_text(meshes) ==
          "sun-planet 20 % (11 % to 29 %), ring-planet 0 % (0 % to 0 %)");
    const auto json = report_json(results, ColumnRows(results), std::nullopt);
    REQUIRE(json["contact_loss"].size() == 2);
    CHECK(json["contact_loss"][0]["mesh"] == "sun-planet");
    CHECK(json["contact_loss"][0]["mean"] == Approx(0.2));
    CHECK(json["contact_loss"][1]["upper"] == 0.0);
}

TEST_CASE("The numerical error decreases with the steps and matches that of finer ones") {
    const auto error = [](int steps) {
        const Study study = light_study({"numerics.precision=double", "numerics.integrator=rk4",
                                         fmt::format("numerics.steps_per_mesh={}", steps)});
        const auto found = find_step_error(mc::Planner(study), 1e9);
        REQUIRE(found);
        CHECK(found->gearboxes == 8);
        CHECK(found->meshes == 16);
        CHECK(found->finer_steps > 3 * found->steps);
        return *found;
    };
    const StepError coarse = error(2000), fine = error(8000);
    CHECK(coarse.sensor > 3.0 * fine.sensor);
    CHECK(coarse.te > 2.0 * fine.te);
    CHECK(fine.sensor > 0.0);
    CHECK_FALSE(find_step_error(mc::Planner(light_study()), 10.0));
}

}  // namespace gearpod::mc::test_contact_loss
