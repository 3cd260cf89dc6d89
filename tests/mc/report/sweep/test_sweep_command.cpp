// Checks gearpod sweep: a study at every combination of given values.
#include <fmt/format.h>

#include "analysis/report/wording.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_sweep_command {

using namespace test;
namespace fs = std::filesystem;

std::string study_of(int instances) {
    return test::study("planet-crack-ideal.toml") + " --instances " + std::to_string(instances) +
           " --set ensemble.threshold_instances=20 ";
}
const std::string kStudy = study_of(22);

std::string sweep(const Folder& folder, const std::string& rest, int instances = 22) {
    return "sweep " + study_of(instances) + " --out " + folder.file("s") + " " + rest;
}

TEST_CASE("A sweep's points are runs with the same gearboxes, and are computed once") {
    const Folder folder;
    const std::string vary = "--vary sensor.noise_m_s2=[1,3] ";
    check_mentions(require_success(sweep(folder, vary + "--json " + folder.file("s.json"))),
                   {"2 of 2, noise_m_s2=3: started"});
    const std::string one = folder.file("s/noise_m_s2=1.h5"),
                      three = folder.file("s/noise_m_s2=3.h5");
    for (const auto& [file, value] : {std::pair{one, "1"}, std::pair{three, "3"}}) {
        require_success("run " + kStudy + " --quiet --force --set sensor.noise_m_s2=" + value +
                        " --out " + folder.file("run.h5"));
        CHECK(bits(file) == bits(folder.file("run.h5")));
    }
    // Paired as in `compare`: the same seed, gearboxes and fault sizes.
    CHECK(program("compare " + one + " " + three).mentions("22 test gearboxes that are the same"));

    const auto json = json_of_file(folder.file("s.json"));
    REQUIRE(json["points"].size() == 2);
    CHECK(json["points"][1]["values"]["sensor.noise_m_s2"] == "3");
    CHECK(json["points"][0]["gearboxes"] == 42);
    CHECK(json["points"][0]["results"] == one);
    const auto report = json_of("report " + one + " --json -");
    int found = 0;
    for (const auto& feature : json["points"][0]["features"]) {
        for (const auto& reported : report["reliability"]["features"]) {
            for (const auto& level : reported["levels"]) {
                if (reported["name"] == feature["feature"] &&
                    level["noise_level"] == feature["noise_level"]) {
                    CHECK(level["auc"]["auc"] == feature["auc"]);
                    ++found;
                }
            }
        }
    }
    CHECK(found == 35);  // seven features at five noise levels

    const std::string before = bytes_of(one);
    check_mentions(require_success(sweep(folder, "--vary sensor.noise_m_s2=[1,2,3] ")),
                   {"1 of 3, noise_m_s2=1: finished before", "2 of 3, noise_m_s2=2: started",
                    "3 of 3, noise_m_s2=3: finished before"});
    CHECK(bytes_of(one) == before);
    CHECK(fs::exists(folder.file("s/noise_m_s2=2.h5")));
}

TEST_CASE("A stopped sweep resumes, and can be extended by gearboxes") {
    const Folder folder;
    const std::string vary = "--vary sensor.gain=[1,2] ";
    require_success(sweep(folder, vary + "--quiet"));
    const auto whole = bits(folder.file("s/gain=2.h5"));
    const std::string part =
        "run " + kStudy + " --quiet --set sensor.gain=2 --out " + folder.file("s/gain=2.h5");
    fs::remove(folder.file("s/gain=2.h5"));
    CHECK(program(part + " --time-limit 00:00:00").code == 4);
    check_mentions(require_success(sweep(folder, vary)),
                   {"1 of 2, gain=1: finished before", "2 of 2, gain=2: continued"});
    CHECK(bits(folder.file("s/gain=2.h5")) == whole);

    check_mentions(require_success(sweep(folder, vary, 33)), {"1 of 2, gain=1: continued"});
    CHECK(mc::read_results(folder.file("s/gain=1.h5")).status.size() == 53);
}

TEST_CASE("A sweep reports every problem once before it starts") {
    const Folder folder;
    const Outcome bad =
        check_refused(sweep(folder, "--vary sensor.nois=[1,2,3] --vary sensor.gain=[1,-2]"),
                      {"--vary: sensor.nois: unknown key", "--vary: sensor.gain: must be > 0"});
    CHECK(std::count(bad.output.begin(), bad.output.end(), '\n') == 2);
    CHECK(folder.empty());
    check_refused(sweep(folder, "--vary sensor.gain=2"));
    check_refused("sweep " + kStudy);
}

TEST_CASE("A sweep does not overwrite another study's results, and refuses one without a scene") {
    const Folder folder;
    const std::string vary = "--quiet --vary sensor.gain=[1,2] ";
    require_success(sweep(folder, vary));
    const std::string before = bytes_of(folder.file("s/gain=1.h5"));
    check_refused(sweep(folder, vary + "--set numerics.steps_per_mesh=1"),
                  {"numerics.steps_per_mesh: 1 steps are too few"});
    check_refused(sweep(folder, vary + "--set operation.torque_N_m=300"));
    CHECK(bytes_of(folder.file("s/gain=1.h5")) == before);
    require_success(sweep(folder, vary + "--set operation.torque_N_m=300 --force"));
    CHECK(bytes_of(folder.file("s/gain=1.h5")) != before);
}

TEST_CASE("A sweep of lives has the lives of the command, and resumes") {
    const Folder folder;
    const std::string study = test::study("planet-crack-ideal.toml") + life_arguments() +
                              " --set 'features.use=[\"sensor_rms\",\"window_ratio\"]'"
                              " --set monitoring.false_alarms_per_1000_h=10 ";
    const auto swept = [&](const std::string& values) {
        return program("sweep --lives " + study + "--out " + folder.file("s") +
                       " --vary life.interval_h=" + values + " --json -");
    };
    const Outcome first = require_success(swept("[5,10]"));
    const auto json = nlohmann::json::parse(first.output.substr(first.output.find('{')));
    CHECK(json["kind"] == "lives-sweep");
    REQUIRE(json["points"].size() == 2);
    for (const auto& point : json["points"]) {
        const std::string hours = point["values"]["life.interval_h"];
        auto monitored =
            json_of("lives " + study + "--quiet --force --set life.interval_h=" + hours +
                    " --out " + folder.file("l.h5") + " --json -")["monitored"];
        for (auto& one : monitored) {
            one.erase("alarm_h");
        }
        CHECK(point["monitored"] == monitored);
        CHECK(point["lives"] == 3);
    }
    // The same gearboxes and records: those before the crack have the same signals at any interval.
    const auto five = mc::read_results(folder.file("s/interval_h=5.h5")),
               ten = mc::read_results(folder.file("s/interval_h=10.h5"));
    CHECK(five.features[0].values[0] == ten.features[0].values[0]);
    const Outcome more = swept("[5,10,20]");
    check_mentions(more,
                   {"1 of 3, interval_h=5: finished before", "3 of 3, interval_h=20: started"});

    const Outcome text = require_success("sweep --lives " + study + "--quiet --out " +
                                         folder.file("s") + " --vary life.interval_h=[5,10]");
    // Ten false alarms in 1000 h find three cracks by chance.
    CHECK(text.mentions("At no point does a detector find more cracks than chance"));
}

// Points that are ranked, not ranked, without a known share, or without results.
TEST_CASE("The headline of a sweep of lives names the worst point and drops none") {
    std::mt19937_64 engine(7);
    for (int made = 0; made < 300; ++made) {
        mc::LivesSweep sweep{"lives", {{"life.records", {}}}, {}, {{"te_rms", "single", {}}}};
        std::vector<double> shares;
        const std::size_t points = 1 + engine() % 4;
        std::size_t unranked = 0;
        while (sweep.points.size() < points) {
            mc::LivesPoint& point = sweep.points.emplace_back();
            point.point.labels = {std::to_string(sweep.points.size())};
            const auto kind = engine() % 4;
            if (kind < 3) {
                auto& result = point.monitored.emplace_back(sweep.order.front());
                result.unranked = kind == 1 ? "no more than chance" : "";
                result.performance.share = kind == 2 ? NAN : static_cast<double>(engine() % 3) / 16;
            }
            if (kind < 2) {
                shares.push_back(point.monitored.front().performance.share);
                unranked += kind == 1;
            }
        }
        const std::string text = without_line_breaks(report_text(mc::lives_sweep_report(sweep)));
        INFO(text);
        const auto says = [&](const std::string& part) { return text.find(part) < text.size(); };
        const auto counts = [&](const std::string& what, std::size_t count) {
            return says(fmt::format("{} at {} of {} points", what, count, points)) == (count > 0);
        };
        std::ranges::sort(shares);
        CHECK(says("at every point") == (!shares.empty() && shares.front() == shares.back()));
        if (!shares.empty()) {
            CHECK(says(analysis::percent_text(shares.front())));
            CHECK(counts("no share is known", points - shares.size()));
            CHECK(counts("it has no rank", unranked));
        }
    }
}

// Rows of the table with that key in a section of a report.
std::vector<std::vector<std::string>> table_rows(const analysis::Report& report,
                                                 const std::string& key) {
    for (const analysis::Section& section : report.sections) {
        for (const auto& block : section.blocks) {
            if (const auto* table = std::get_if<analysis::Table>(&block);
                table != nullptr && table->key == key) {
                return table->rows;
            }
        }
    }
    return {};
}

TEST_CASE("A sweep of lives without ranks, or with withheld results, lists every point") {
    mc::LivesSweep sweep{"lives", {{"life.records", {}}}, {}, {}};
    for (const char* label : {"10", "20", "30"}) {
        sweep.points.emplace_back().point.labels = {label};
    }
    sweep.points[1].withheld = "No answer.";
    const analysis::Report report = mc::lives_sweep_report(sweep);
    CHECK(table_rows(report, "points").size() == 3);
    CHECK(statement_text(report, "withheld") ==
          "Results are withheld at 1 of 3 points (records = 20); `lives` there states why.");
    CHECK(contains(statement_text(report, "headline"), "At no point"));
    sweep.points[0].withheld = sweep.points[2].withheld = "No answer.";
    CHECK(statement_text(mc::lives_sweep_report(sweep), "headline") ==
          "The results are withheld at every point.");
}

// Points that find a fault, find none, have no threshold, or have no feature.
TEST_CASE("The headline of a sweep of runs agrees with its table, and drops no point") {
    std::mt19937_64 engine(8);
    for (int made = 0; made < 300; ++made) {
        mc::RunSweep sweep{"runs", {{"sensor.gain", {}}}, {}, {}, {}};
        const std::size_t points = 1 + engine() % 4;
        while (sweep.points.size() < points) {
            mc::PointSummary& point = sweep.points.emplace_back();
            point.point.labels = {std::to_string(sweep.points.size())};
            const auto kind = engine() % 4;
            if (kind < 3) {
                mc::LevelSummary& level = point.levels.emplace_back();
                level.noise_level = engine() % 4 == 0 ? 2.0 : 1.0;
                level.has_threshold = kind != 2;
                if (kind == 0) {
                    level.smallest.emplace();
                    level.smallest->feature = "te_rms";
                    level.smallest->size = 1e-3 * static_cast<double>(1 + engine() % 3);
                    level.smallest->from_curve = true;
                }
            }
        }
        const analysis::Report report = mc::sweep_report(sweep);
        const auto rows = table_rows(report, "points");
        REQUIRE(rows.size() == points);
        const std::string text = statement_text(report, "headline");
        INFO(text);
        // Outcome of each point in its row: that at the noise level which it has.
        std::map<std::string, std::vector<std::string>> outcomes;
        for (const auto& row : rows) {
            std::string outcome = "-";
            for (std::size_t cell = 1; cell < row.size() && outcome == "-"; ++cell) {
                outcome = contains(row[cell], "mm") || contains(row[cell], "no") ? row[cell] : "-";
            }
            outcomes[outcome].push_back("gain = " + row[0]);
        }
        if (outcomes["-"].size() == points) {
            CHECK(contains(text, "computes no feature"));
            continue;
        }
        for (const auto& [cell, words] :
             {std::pair{"none", "none"}, {"no threshold", "no threshold"}, {"-", "no feature"}}) {
            const std::vector<std::string>& names = outcomes[cell];
            CHECK(contains(text, std::string(words) + " in ") == !names.empty());
            for (const std::string& name : names) {
                CHECK((names.size() == points || contains(text, name)));
            }
        }
        std::vector<std::string> sizes;
        for (const auto& [outcome, names] : outcomes) {
            if (contains(outcome, "mm")) {
                sizes.push_back(outcome);
            }
        }
        if (!sizes.empty()) {  // ascending: one digit each
            CHECK(contains(text, sizes.front() + " by "));
            CHECK(contains(text, "largest " + sizes.back()) == (sizes.size() > 1));
        }
    }
}

TEST_CASE("Keys without effect on a sweep of runs, or of lives, are refused") {
    const Folder folder;
    check_refused(sweep(folder, "--vary life.interval_h=[1,2]"),
                  {"--vary: life.interval_h: is only used by `lives`, not by `run`"});
    check_refused(sweep(folder, "--lives --vary sensor.gain=[1,2]"), {"life.interval_h: missing"});
    CHECK(folder.empty());
}

}  // namespace gearpod::test_sweep_command
