// Checks the inputs of the reliability assessment from an ensemble's rows.
#include "mc/report/run_report.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_reliability_of_results {

// Four hundred healthy gearboxes set the threshold; of 600 test gearboxes, every third has no
// fault. The parameter that looks like a crack depth is an input like any other.
Results example() {
    Results r;
    r.noise_levels = {1.0, 2.0};
    r.request.noise_levels = r.noise_levels;
    r.request.groups = {{0.0, 0.0}, {0.5, 0.5}, {1.0, 1.0}};
    r.request.size = {"fault_broken", "1"};
    r.parameters = {{"fault_depth_m", "m", {}}, {"fault_broken", "1", {}}};
    r.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    std::mt19937_64 engine(5);
    for (int row = 0; row < 1000; ++row) {
        const bool sets_threshold = row < 400;
        const double size = sets_threshold ? 0.0 : 0.5 * (row % 3);
        r.group.push_back(static_cast<int>(sets_threshold ? Group::threshold : Group::test));
        r.status.push_back(0);
        r.parameters[0].values.push_back(1e-3 * row);
        r.parameters[1].values.push_back(size);
        for (const double noise : r.noise_levels) {
            r.features[0].values.push_back(3.0 * size +
                                           std::normal_distribution<double>(0.0, noise)(engine));
        }
    }
    r.detection = detect_all(r, ColumnRows(r));
    return r;
}

TEST_CASE("The fault's size is the column named by the request, all others are inputs") {
    const Results r = example();
    const auto reliability = reliability_of(r, ColumnRows(r), "", 2);
    REQUIRE(reliability);
    const auto& level = reliability->features.at(0).levels.at(0);
    CHECK(level.auc.healthy == 600);
    CHECK(level.auc.faulty == 400);
    CHECK(level.auc_by_size.at(2).faulty == 200);
    REQUIRE(level.misses.inputs.size() == 1);
    CHECK(level.misses.inputs[0].name == "fault_depth_m");
    CHECK(reliability->conditions.empty());
    CHECK(reliability_of(r, ColumnRows(r), "fault_depth_m", 2)->conditions.size() == 1);
    CHECK_THROWS_WITH(reliability_of(r, ColumnRows(r), "fault_broken", 2),
                      Catch::Contains("it has fault_depth_m"));
}

TEST_CASE("An ensemble that exceeds the memory is not assessed, and the text reports this") {
    const Results r = example();
    CHECK(reliability_of(r, ColumnRows(r), "", 2, 2000));
    const auto none =
        reliability_of(r, ColumnRows(r), "", 2, 1999);  // one thousand gearboxes, 2 values each
    CHECK(!none);
    CHECK_THAT(report_text(findings_of_run(r, ColumnRows(r), none).report),
               Catch::Contains("is limited to 25000000"));
}

}  // namespace gearpod::mc::test_reliability_of_results
