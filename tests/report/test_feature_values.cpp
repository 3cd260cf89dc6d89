// Checks the printed feature values of a study without thresholds.
#include "mc/report/run_sections.hpp"
#include "tests/mc/program.hpp"
#include "tests/report/report_cases.hpp"

namespace gearpod::test_feature_values {

using test::require_success;
using test::TemporaryFile;

TEST_CASE("Values are printed only without thresholds and for few gearboxes") {
    int with = 0;
    for (const tests::ReportCase& made : tests::report_cases()) {
        INFO(made.name);
        const bool shown =
            !mc::feature_values(made.results, mc::ColumnRows(made.results)).blocks.empty();
        for (const auto& feature : made.results.detection) {
            for (const auto& level : feature.levels) {
                CHECK((!shown || std::isnan(level.threshold)));
            }
        }
        with += shown;
    }
    CHECK(with > 0);
}

TEST_CASE("A study without noise prints the values of its file, not dashes") {
    const auto [folder, file] = TemporaryFile("r.h5");
    require_success("run " + test::study("published/park-fig-13.toml") + " --quiet --out " + file);
    const auto report = require_success("report " + file);
    CHECK(!report.mentions("-    "));
    CHECK(report.mentions("Feature values"));
    // Line of each test gearbox: row, loss of stiffness, then the four features.
    const mc::Results results = mc::read_results(file);
    int found = 0;
    std::istringstream lines(report.output);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        std::size_t row = 0;
        double size = 0.0;
        if (!(cells >> row >> size) || row == 0 || row >= results.status.size()) {
            continue;
        }
        for (const mc::FeatureResult& feature : results.features) {
            double shown = 0.0;
            REQUIRE(cells >> shown);
            CHECK(shown == Approx(feature.values[row]).epsilon(1e-4));
        }
        ++found;
    }
    CHECK(found == 4);
}

}  // namespace gearpod::test_feature_values
