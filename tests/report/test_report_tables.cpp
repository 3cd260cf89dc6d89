// Checks the tables of a report as CSV: complete, rectangular, with the numbers of the JSON.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mc/report/run_report.hpp"
#include "mc/report/tables.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/mc/program.hpp"
#include "tests/report/report_cases.hpp"

namespace test_report_tables {

using namespace gearpod;
using nlohmann::json;

namespace {

json report_of(const tests::ReportCase& each) {
    const mc::ColumnRows rows(each.results);
    return mc::report_json(each.results, rows, mc::reliability_of(each.results, rows, "", 2));
}

// Fields of a line without quotes.
std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') {
            const bool escaped = quoted && i + 1 < line.size() && line[i + 1] == '"';
            if (escaped) {
                out.back() += line[++i];
            } else {
                quoted = !quoted;
            }
        } else if (line[i] == ',' && !quoted) {
            out.emplace_back();
        } else {
            out.back() += line[i];
        }
    }
    return out;
}

}  // namespace

TEST_CASE(
    "Every table of every report has one field per column in each row, and no table is empty") {
    for (const tests::ReportCase& each : tests::report_cases()) {
        INFO(each.name);
        const auto tables = mc::report_tables(report_of(each));
        CHECK(tables.size() >= 2);
        for (const mc::CsvTable& table : tables) {
            INFO(table.name);
            REQUIRE(!table.rows.empty());
            for (const std::string& row : table.rows) {
                CHECK(fields(row).size() == table.columns.size());
                CHECK(row.find("nan") == std::string::npos);
            }
        }
    }
}

TEST_CASE("The tables hold the report's numbers, with sizes in the unit of their names") {
    const auto cases = tests::report_cases();
    const auto usual = std::find_if(cases.begin(), cases.end(),
                                    [](const auto& each) { return each.name == "usual"; });
    REQUIRE(usual != cases.end());
    const json report = report_of(*usual);
    const test::Folder folder;
    const auto files =
        mc::write_files(folder.file("new/tables"), mc::table_files(mc::report_tables(report)));
    CHECK(files.size() > 8);
    const auto lines = [&](const std::string& name) {
        std::istringstream text(test::bytes_of(folder.file("new/tables/" + name + ".csv")));
        std::vector<std::vector<std::string>> out;
        for (std::string line; std::getline(text, line);) {
            out.push_back(fields(line));
        }
        return out;
    };
    const auto detection = lines("detection");
    const json& feature = report["detection"]["features"][0];
    CHECK(detection[0][7] == "size_low_m");
    CHECK(detection[1][0] == feature["name"]);
    const json& cell = feature["levels"][0]["sizes"][2];
    CHECK(std::stod(detection[3][8]) == cell["size_high"].get<double>());
    CHECK(std::stod(detection[3][12]) == cell["pd"].get<double>());
    const auto smallest = lines("smallest_fault");
    for (std::size_t n = 0; n + 1 < smallest.size(); ++n) {
        const json& found = report["reliability"]["levels"][n]["smallest_fault"];
        CHECK(smallest[n + 1][1] == (found.is_object() ? found["feature"].get<std::string>() : ""));
    }
    CHECK_THROWS_WITH(
        mc::write_files(files.front() + "/below", mc::table_files(mc::report_tables(report))),
        Catch::Contains(files.front()));
}

}  // namespace test_report_tables
