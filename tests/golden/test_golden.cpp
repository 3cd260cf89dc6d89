#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/golden/golden.hpp"

using namespace gearpod::golden;

TEST_CASE("Every golden curve equals the program's output") {
    for (const Golden& golden : goldens()) {
        INFO(golden.name << ": gearpod " << golden.command);
        CHECK(differences(read_curves(golden), compute(golden), golden.tolerance) == "");
    }
}

TEST_CASE("Golden curves have unique names and a tolerance below a percent") {
    std::set<std::string> names;
    for (const Golden& golden : goldens()) {
        CHECK(names.insert(golden.name).second);
        CHECK(golden.tolerance > 0);
        CHECK(golden.tolerance < 0.01);
    }
}

TEST_CASE("A golden curve detects a changed value, length and column, and no smaller change") {
    const Curves kept{{"phase", "k"}, {{0, 0.5, 1}, {3e8, -5e8, 4e8}}};
    Curves now = kept;
    CHECK(differences(kept, now, 1e-6) == "");
    now.columns[1][0] += 0.9e-6 * 9e8;  // of the spread
    CHECK(differences(kept, now, 1e-6) == "");
    now.columns[1][0] = 3e8 + 1.1e-6 * 9e8;
    CHECK(differences(kept, now, 1e-6) != "");
    now.columns[1][0] = std::nan("");
    CHECK(differences(kept, now, 1e-6) != "");
    CHECK(differences(now, now, 1e-6) == "");
    now = kept;
    now.columns[1].pop_back();
    CHECK(differences(kept, now, 1e-6) != "");
    now = kept;
    now.names[1] = "K";
    CHECK(differences(kept, now, 1e-6) != "");
}

TEST_CASE("A golden curve whose command fails or whose column is missing is an error") {
    CHECK_THROWS(compute({"x", "stiffness studies/no-such-study.toml --csv -", {}, {}, 1, 1e-6}));
    CHECK_THROWS(compute({"x",
                          "stiffness studies/published/liang-fig-5-8.toml --csv - --points 2",
                          Source::csv,
                          {"no such column"},
                          1,
                          1e-6}));
}
