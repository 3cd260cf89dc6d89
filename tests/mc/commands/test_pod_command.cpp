// Checks gearpod pod on tables of inspections. The statistics are compared with other programs in
// tests/analysis/pod/test_inspection.cpp.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/mc/program.hpp"

namespace test_pod_command {

using namespace gearpod;
using namespace gearpod::test;

namespace {

const std::string kTables = std::string(GEARPOD_SOURCE_DIR) + "/tests/analysis/reference/";

std::string written(const Folder& folder, const std::string& name, const std::string& text) {
    const std::string path = folder.file(name);
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

nlohmann::json pod_of(const std::string& arguments) {
    const Outcome outcome = program("pod " + arguments + " --json -");
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(outcome.output);
}

TEST_CASE("pod reads hits and misses with units, and states the kind of bound") {
    const std::string table = kTables + "inspections_hits.csv --link logit --size-scale linear";
    const auto json = pod_of(table);
    CHECK(json["size"]["unit"] == "mm");
    CHECK(json["hit_miss"]["a90"]["estimate"]["size"].get<double>() == Approx(2.5928436));
    CHECK(json["hit_miss"]["a90"]["upper"]["size"].get<double>() == Approx(3.0141444));
    CHECK(json["convention"] == "calibrated");
    const auto handbook = pod_of(table + " --convention handbook");
    CHECK(handbook["hit_miss"]["a90"]["upper"]["size"].get<double>() == Approx(3.1112525));
    CHECK(handbook["hit_miss"]["simulated_coverage"].get<double>() > 0.9);
    // A method of asymptotic bounds alone is that of the handbook.
    CHECK(pod_of(table + " --bounds likelihood-ratio")["hit_miss"]["a90"] ==
          handbook["hit_miss"]["a90"]);
    const Outcome text = program("pod " + table + " --specimen specimen");
    CHECK(text.mentions("120 specimens and 120 repeated measurements"));
    CHECK(text.mentions("robust covariance"));
    CHECK_THAT(text.output, Catch::Contains("(mm)"));
}

TEST_CASE("pod takes several columns as repeats, a byte order mark and decimal commas") {
    const Folder folder;
    const auto plain = pod_of(kTables +
                              "inspections_responses.csv --response A --response B --response C "
                              "--threshold 6 --size-scale log --response-scale log");
    CHECK(plain["signal_response"]["candidates"][0]["within"].get<double>() ==
          Approx(0.33216108).epsilon(1e-4));
    std::ifstream file(kTables + "inspections_responses.csv");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '.', ',');
    const auto foreign = pod_of(written(folder, "foreign.csv", "\xEF\xBB\xBF" + text) +
                                " --response A --response B --response C --threshold 6 "
                                "--size-scale log --response-scale log");
    CHECK(foreign["signal_response"]["a90"] == plain["signal_response"]["a90"]);
}

TEST_CASE("pod reads tables as pandas, R and spreadsheets write them") {
    const Folder folder;
    const std::string options = " --size \"depth, mm\" --hit y --link logit --size-scale linear";
    std::string plain, pandas, excel;
    for (int i = 1; i <= 40; ++i) {
        const std::string size = std::to_string(i / 4) + "." + std::to_string(25 * (i % 4));
        const std::string hit = i % 7 == 3 ? "0" : i > 15 || i % 5 == 0 ? "1" : "0";
        std::string comma = size;
        std::replace(comma.begin(), comma.end(), '.', ',');
        plain += size + "," + hit + "\n";
        pandas += std::to_string(i) + "," + size + "," + hit + ",note " + std::to_string(i) + "\n";
        excel += comma + ";" + hit + ";\r\n";
    }
    const auto expected =
        pod_of(written(folder, "a.csv", "\"depth, mm\",y\n" + plain) + options)["hit_miss"]["a90"];
    const std::pair<const char*, std::string> forms[] = {
        {"pandas", ",\"depth, mm\",y,remark\n" + pandas},
        {"missing inspections",
         ",\"depth, mm\",y,remark\n" + pandas + "40,3,NaN,x\n41,4,,\n42,4,NA,\n"},
        {"a spreadsheet", "sep=;\r\ndepth, mm;y;\r\n" + excel},
        {"a unit in brackets", "\"depth, mm [mm]\",y\n" + plain}};
    for (const auto& [form, text] : forms) {
        INFO(form);
        CHECK(pod_of(written(folder, "b.csv", text) +
                     options)["hit_miss"]["a90"]["estimate"]["size"] ==
              expected["estimate"]["size"]);
    }
}

TEST_CASE("pod refuses unusable input by name, all at once") {
    const Folder folder;
    const auto refused = [](const std::string& arguments) {
        const Outcome outcome = program("pod " + arguments);
        CHECK(outcome.code == 2);
        return outcome.output;
    };
    const std::string bad =
        refused(written(folder, "bad.csv", "size,hit\n1,2\n-3,1\nx,0\n4,inf\n"));
    CHECK_THAT(bad, Catch::Contains("bad.csv:2: column hit: 2 is neither 1 (hit) nor 0 (miss)"));
    CHECK_THAT(bad, Catch::Contains("bad.csv:3: column size: -3 is negative"));
    CHECK_THAT(bad, Catch::Contains("bad.csv:4: column size: \"x\" is not a finite number"));
    CHECK_THAT(bad, Catch::Contains("bad.csv:5: column hit: \"inf\" is not a finite number"));
    CHECK_THAT(refused(written(folder, "names.csv", "length,seen\n1,1\n")),
               Catch::Contains("its columns are length, seen"));
    CHECK_THAT(refused(written(folder, "row.csv", "size,hit\n1\n")),
               Catch::Contains("row.csv:2: 1 values, but the header names 2 columns"));
    CHECK_THAT(refused(written(folder, "empty.csv", "")), Catch::Contains("is empty"));
    CHECK_THAT(refused(written(folder, "none.csv", "size,hit\n")),
               Catch::Contains("no line has a value"));
    CHECK_THAT(refused(written(folder, "binary.csv", std::string("size,hit\n\0\0", 11))),
               Catch::Contains("is not a line of text"));
    CHECK_THAT(refused(kTables + "inspections_hits.csv --threshold 3"),
               Catch::Contains("--threshold is only for responses"));
    CHECK_THAT(refused(kTables + "inspections_responses.csv --response A"),
               Catch::Contains("no threshold"));
    CHECK_THAT(refused(kTables + "inspections_hits.csv --fit-ceiling --firth"),
               Catch::Contains("cannot be used together"));
}

TEST_CASE("pod reports data that determine no curve") {
    const Folder folder;
    std::string text = "size,hit\n";
    for (int i = 1; i <= 12; ++i) {
        text += std::to_string(i) + (i > 6 ? ",1\n" : ",0\n");
    }
    const std::string table = written(folder, "separated.csv", text);
    const Outcome without = program("pod " + table);
    CHECK(without.code == 0);
    CHECK_THAT(without.output, Catch::Contains("do not overlap"));
    CHECK_THAT(without.output, Catch::Contains("--firth"));
    CHECK_THAT(program("pod " + table + " --firth").output, Catch::Contains("a90"));
}

}  // namespace

}  // namespace test_pod_command
