// Checks the sentences of sweeps against their tables, for random points that find, miss, have no
// threshold or no feature, are withheld, are not ranked, or in which no tooth fails.
#include <fmt/format.h>

#include "mc/report/sweep/summaries.hpp"
#include "tests/test.hpp"

namespace gearpod::test_sweep_sentences {

using namespace mc;

const analysis::Table& table_of(const analysis::Report& report, const std::string& key) {
    for (const analysis::Section& section : report.sections) {
        for (const auto& block : section.blocks) {
            const auto* table = std::get_if<analysis::Table>(&block);
            if (table != nullptr && table->key == key) {
                return *table;
            }
        }
    }
    throw std::logic_error("no table " + key);
}

// Number of the points of which the headline says this, from "... at 2 of 7 points" or "none in 2
// of 7 studies"; all points share "... in 7 of 7 studies".
int said(const std::string& text, const std::string& what, std::size_t points) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos) {
        return 0;
    }
    const int count = std::atoi(text.c_str() + at + what.size());
    CHECK_THAT(text, Catch::Contains(fmt::format("{}{} of {}", what, count, points)));
    return count;
}

SweepPoint point_of(std::size_t index) {
    const std::string value = std::to_string(index + 1);
    return {{value}, {value}, {}, "gain=" + value};
}

TEST_CASE("The headline of a sweep of runs accounts for every point of its table") {
    std::mt19937 engine(5);
    for (int trial = 0; trial < 300; ++trial) {
        RunSweep sweep{"", {{"sensor.gain", {}}}, {}, {}, {}};
        const std::size_t points = 1 + engine() % 7;
        int found = 0, none = 0, without = 0, featureless = 0;
        for (std::size_t p = 0; p < points; ++p) {
            PointSummary summary{{point_of(p), ""}, 10, 0, {}, "", 0, {}, {}, {}};
            summary.request.size = {"fault_depth_m", "m"};
            const auto kind = engine() % 4;
            if (kind < 3) {
                summary.levels.push_back({1.0, kind != 2, {}});
            }
            if (kind == 0) {
                const double size = 1e-3 * static_cast<double>(1 + engine() % 5);
                summary.levels[0].smallest = {"window_ratio", size, true, {}, true};
            }
            found += kind == 0;
            none += kind == 1;
            without += kind == 2;
            featureless += kind == 3;
            sweep.keys[0].values.push_back(point_of(p).values[0]);
            sweep.points.push_back(std::move(summary));
        }
        const analysis::Report report = sweep_report(sweep);
        const std::string text = statement_text(report, "headline");
        INFO(text);
        const analysis::Table& table = table_of(report, "points");
        REQUIRE(table.rows.size() == points);
        if (static_cast<std::size_t>(featureless) == points) {
            CHECK_THAT(text, Catch::Contains("computes no feature"));
            continue;
        }
        const std::size_t column = 1;  // smallest fault at noise x 1
        double least = 1e9, most = 0.0;
        int sizes = 0, none_here = 0, without_here = 0, empty = 0;
        for (std::size_t p = 0; p < points; ++p) {
            CHECK(table.rows[p][0] == point_of(p).labels[0]);
            const std::string& cell = table.rows[p][column];
            none_here += cell == "none";
            without_here += cell == "no threshold";
            empty += cell == "-";
            if (const double size = std::atof(cell.c_str()); size > 0.0) {
                ++sizes;
                least = std::min(least, size);
                most = std::max(most, size);
            }
        }
        CHECK(sizes == found);
        CHECK(none_here == none);
        CHECK(without_here == without);
        CHECK(empty == featureless);
        CHECK(said(text, "none in ", points) == none);
        CHECK(said(text, "no threshold in ", points) == without);
        CHECK(said(text, "no feature in ", points) == featureless);
        if (found > 0) {
            CHECK_THAT(text, Catch::Contains(fmt::format("{:g} mm by", least)));
            CHECK((text.find("largest") != std::string::npos) == (most > least));
            if (most > least) {
                CHECK_THAT(text, Catch::Contains(fmt::format("largest {:g} mm by", most)));
            }
        }
    }
}

TEST_CASE("The headline of a sweep of lives accounts for every point of its table") {
    std::mt19937 engine(6);
    for (int trial = 0; trial < 300; ++trial) {
        LivesSweep sweep{"", {{"life.recordings", {}}}, {}, {}};
        const std::size_t points = 1 + engine() % 6;
        int withheld = 0, unranked = 0, unknown = 0;
        double least = 2.0, most = -1.0;
        MonitoredFeature best{"window_ratio", "single", {}};
        for (std::size_t p = 0; p < points; ++p) {
            LivesPoint point{{point_of(p), ""}, {}, 16, {}, 0, "", {}, {best}, {}, ""};
            MonitoredFeature& here = point.monitored[0];
            const auto kind = engine() % 4;  // ranked, not ranked, withheld, no tooth fails
            if (kind < 2) {
                here.performance.ended = 16;
                here.performance.found = static_cast<long>(engine() % 17);
                here.performance.share = static_cast<double>(here.performance.found) / 16.0;
                here.performance.share_bounds = {0.0, 1.0};
                least = std::min(least, here.performance.share);
                most = std::max(most, here.performance.share);
            }
            if (kind == 1) {
                here.unranked = "no significantly larger share found than by chance";
            } else if (kind == 2) {
                here.unranked = point.withheld = "too large an error of interpolation";
            } else if (kind == 3) {
                here.unranked = "no tooth fails";
            } else {
                point.ranking = {0};
                sweep.order = {here};
            }
            unranked += kind == 1;
            withheld += kind == 2;
            unknown += kind >= 2;
            sweep.keys[0].values.push_back(point_of(p).values[0]);
            sweep.points.push_back(std::move(point));
        }
        const analysis::Report report = lives_sweep_report(sweep);
        const std::string text = statement_text(report, "headline");
        INFO(text);
        REQUIRE(table_of(report, "points").rows.size() == points);
        if (static_cast<std::size_t>(withheld) == points) {
            CHECK(text == "The results are withheld at every point.");
        } else if (sweep.order.empty()) {
            CHECK_THAT(text, Catch::Contains("At no point"));
        } else {
            CHECK_THAT(text, Catch::Contains(fmt::format("{:.3g} % [", 100.0 * most)));
            if (least < most) {
                CHECK_THAT(text, Catch::Contains(fmt::format(", {:.3g} % [", 100.0 * least)));
            }
            CHECK(said(text, "it has no rank at ", points) == unranked);
            CHECK(said(text, "no share is known at ", points) == unknown);
            CHECK((text.find("at every point") != std::string::npos) == (least == most));
        }
    }
}

}  // namespace gearpod::test_sweep_sentences
