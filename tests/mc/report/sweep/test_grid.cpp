#include "mc/report/sweep/summaries.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_grid {

TEST_CASE("A grid has every combination once; the last key varies fastest") {
    Problems problems;
    const auto keys = read_varied(
        {"sensor.gain=[1, 2.5]", "sensor.noise_levels=[[0, 1], [1]]", "effects.path=[\"none\"]"},
        problems);
    CHECK(format(problems).empty());
    const auto points = grid_of(keys);
    REQUIRE(points.size() == 4);
    CHECK(points[1].values == std::vector<std::string>{"1", "[1]", "\"none\""});
    CHECK(points[2].overrides == std::vector<std::string>{"sensor.gain=2.5",
                                                          "sensor.noise_levels=[0, 1]",
                                                          "effects.path=\"none\""});
    std::set<std::string> names;
    for (const SweepPoint& point : points) {
        CHECK(point.name.find_first_of("/\\ \"'[]{}*?$") == std::string::npos);
        names.insert(point.name);
    }
    CHECK(names.size() == 4);
}

TEST_CASE("A point's file has the same name in a larger grid") {
    Problems problems;
    const auto few = grid_of(read_varied({"sensor.gain=[1, 3]", "a.b=[\"x\"]"}, problems));
    const auto more = grid_of(read_varied({"sensor.gain=[1, 2, 3]", "a.b=[\"x\"]"}, problems));
    CHECK(few[0].name == "gain=1_b=x");
    CHECK(few[1].name == more[2].name);
}

TEST_CASE("Equal key names in two sections, and values that are no file names, stay distinct") {
    Problems problems;
    const auto same = grid_of(read_varied({"life.records=[1]", "x.records=[1, 2]"}, problems));
    CHECK(same[0].name != same[1].name);
    const auto tables = grid_of(read_varied(
        {"random.sensor.gain=[{distribution='constant', value=1}, {distribution='constant', "
         "value=2}]"},
        problems));
    CHECK(format(problems).empty());
    REQUIRE(tables.size() == 2);
    CHECK(tables[0].name != tables[1].name);
    CHECK(tables[0].name.size() < 120);
}

TEST_CASE("Labels of long values that differ at their end are numbered") {
    Problems problems;
    const std::string mode = "[{frequency_Hz=180, damping=0.03, nodal_diameters=2, participation=";
    const auto points =
        grid_of(read_varied({"sensor.housing_modes=[" + mode + "1.25}], " + mode + "1.5}]]",
                             "sensor.gain=[{distribution='uniform', low=1, high=2}]"},
                            problems));
    CHECK(format(problems).empty());
    REQUIRE(points.size() == 2);
    CHECK_THAT(points[0].labels[0], Catch::StartsWith("1: [") && Catch::EndsWith("..."));
    CHECK_THAT(points[1].labels[0], Catch::StartsWith("2: [") && Catch::EndsWith("..."));
    CHECK(points[0].labels[1] == "uniform, high=2, low=1");
}

TEST_CASE("Malformed lists of values are refused with their key") {
    for (const char* bad : {"sensor.gain=3", "sensor.gain=[]", "sensor.gain", "sensor.gain=[1, 1]",
                            "sensor.gain=[1"}) {
        INFO(bad);
        Problems problems;
        read_varied({bad}, problems);
        REQUIRE(problems.size() == 1);
        CHECK(problems[0].file == "--vary");
        CHECK(problems[0].key == "sensor.gain");
    }
    Problems twice;
    read_varied({"a.b=[1]", "a.b=[2]"}, twice);
    CHECK(twice.size() == 1);
    Problems none;
    std::string many = "a.b=[0";
    for (int i = 1; i < 101; ++i) {
        many += "," + std::to_string(i);
    }
    auto keys = read_varied({many + "]"}, none);
    keys.push_back({"a.c", keys[0].values});
    CHECK(grid_of(keys).empty());  // 101 x 101
}

}  // namespace gearpod::mc::test_grid
