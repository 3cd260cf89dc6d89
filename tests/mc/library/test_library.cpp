// Checks the functions for other programs: problems as exceptions, and recordings in memory.
#include "mc/files/input/problems.hpp"
#include "mc/library/inspection_table.hpp"
#include "mc/library/open_study.hpp"
#include "mc/library/signal_features.hpp"
#include "mc/library/stiffness_modes.hpp"
#include "tests/test.hpp"

namespace gearpod::test_library {

const std::string kStudy = GEARPOD_SOURCE_DIR "/studies/planet-crack-ideal.toml";

template <typename Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const mc::BadInput& error) {
        return error.what();
    }
    return "nothing was thrown";
}

using test::contains;

TEST_CASE("A study that is read by a program reports every problem in one exception") {
    const std::string text = "[gearbox]\nsun_teth = 1\n[operation]\ntorque = 1\n";
    const std::string with_lines = message_of([&] { mc::OpenStudy("text", text); });
    CHECK(contains(with_lines, "text:2: gearbox.sun_teth: unknown key"));
    CHECK(contains(with_lines, "\ntext:4: operation.torque: unknown key"));
    const std::string without = message_of([&] { mc::OpenStudy("text", text, {}, false); });
    CHECK(contains(without, "text: gearbox.sun_teth: unknown key"));

    mc::OpenStudy study(kStudy);
    CHECK(&study.plans() == &study.plans());
    CHECK(contains(
        message_of([&] { mc::simulate_row(study.plans().tile, study.plans().ensemble, -1); }),
        "must be a row of the results, 0 to"));
}

TEST_CASE("A recording in memory gives the features of its gearbox") {
    mc::OpenStudy study(kStudy);
    const mc::Simulation simulated =
        mc::simulate_row(study.plans().tile, study.plans().ensemble, 0);
    std::vector<mc::SignalColumn> recorded;
    for (const mc::SignalColumn& column : simulated.columns) {
        if (column.name == "mesh_phase" || column.name == "sensor") {
            recorded.push_back({column.name, "", column.values});
        }
    }
    mc::SignalRequest request;
    request.signal = {"memory", recorded};
    const mc::SignalFeatures found = mc::signal_features(request, study.plans().tile);
    CHECK(found.signal.tracking == "column mesh_phase");
    CHECK(found.signal.sensor_meshes > 0);

    request.signal = {"memory", {{"force", "N", {1, 2, 3}}}};
    CHECK_THROWS_WITH(mc::signal_features(request, study.plans().tile),
                      Catch::Contains("memory: it has neither a column sensor nor"));
}

TEST_CASE("Stiffness columns start with the phase and have one value per point") {
    mc::OpenStudy study(kStudy);
    const auto columns = mc::stiffness_columns(*study.plans().tile.gearbox, 4);
    CHECK(columns.front().values == std::vector<double>{0, 0.25, 0.5, 0.75});
    CHECK(columns.back().unit == "N/m");
    CHECK(mc::transmission_error_columns(*study.plans().tile.gearbox, 2).size() == 9);
}

TEST_CASE("A table in memory is inspected like one of a file") {
    mc::TextTable table;
    table.path = "table";
    table.columns = {{"size", "mm"}, {"hit", ""}};
    for (int size = 1; size <= 12; ++size) {
        table.rows.push_back({std::to_string(size), size > 6 || size == 4 ? "1" : "0"});
        table.lines.push_back(size);
    }
    const mc::InspectedTable inspected = mc::inspect_table(table, {});
    CHECK(inspected.names.size.unit == "mm");
    CHECK(std::isfinite(inspected.result.hit_miss.a50.estimate.size));

    mc::InspectionOptions wrong;
    wrong.convention = "both";
    wrong.links = {"line"};
    const std::string message = message_of([&] { mc::inspect_table(table, wrong); });
    CHECK(contains(message, "--convention: must be calibrated or handbook or"));
    CHECK(contains(message, "\ntable: --link: must be logit or"));
}

}  // namespace gearpod::test_library
