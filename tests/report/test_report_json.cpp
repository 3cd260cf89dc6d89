// Checks a report's JSON for any results: each number is finite or null, and missing results have a
// reason.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mc/report/run_report.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/study/study.hpp"
#include "tests/report/report_cases.hpp"
#include "tests/test.hpp"

namespace gearpod::test_report_json {

using Json = nlohmann::json;

Json json_of(const mc::Results& results) {
    const mc::ColumnRows rows(results);
    return mc::report_json(results, rows, mc::reliability_of(results, rows, "", 2));
}

Json case_json(const std::string& name) {
    const auto cases = tests::report_cases();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.name == name; });
    REQUIRE(found != cases.end());
    return json_of(found->results);
}

// Checks that the screen of a report fits, and that its first 12 lines have the answer, the
// condition and the next step.
void check_screen(const mc::Results& results, bool curves) {
    const mc::ColumnRows rows(results);
    const auto reliability = curves ? mc::reliability_of(results, rows, "", 2) : std::nullopt;
    const mc::RunFindings run = mc::findings_of_run(results, rows, reliability);
    std::istringstream screen(screen_text(run.report, mc::screen_end("results.h5", false)));
    std::string first;
    std::size_t lines = 0;
    for (std::string line; std::getline(screen, line); ++lines) {
        INFO(line);
        CHECK(line.size() <= analysis::kScreenColumns);
        first += lines < 12 ? line.substr(line.starts_with("  ") ? 2 : 0) + " " : "";
    }
    INFO(first);
    CHECK(lines <= analysis::kScreenLines);
    for (const char* key : {"headline", "assumptions", "next"}) {
        CHECK_THAT(first, Catch::Contains(statement_text(run.report, key)));
    }
    for (const analysis::Section& section : run.report.sections) {
        INFO(section.key);
        CHECK(std::ranges::count(mc::kRunSections, section.key) == 1);
    }
}

TEST_CASE("The first screen of any results has 40 lines of 80 columns") {
    for (const tests::ReportCase& each : tests::report_cases()) {
        INFO(each.name);
        check_screen(each.results, true);
    }
}

TEST_CASE("The screen of every shipped study begins with answer, condition and next step") {
    const auto cases = tests::report_cases();
    const auto usual = std::ranges::find(cases, std::string("usual"), &tests::ReportCase::name);
    std::size_t studies = 0;
    for (const auto& file :
         std::filesystem::recursive_directory_iterator(GEARPOD_SOURCE_DIR "/studies")) {
        if (file.path().extension() != ".toml") {
            continue;
        }
        INFO(file.path().string());
        const mc::StudyReading reading = mc::read_study(file.path().string(), {});
        REQUIRE(reading.study);
        mc::Results results = usual->results;
        std::erase_if(results.provenance, [](const auto& entry) { return entry.first == "study"; });
        results.provenance.emplace_back("study", mc::resolved_text(*reading.study));
        check_screen(results, false);
        ++studies;
    }
    CHECK(studies > 30);
}

void check_numbers(const Json& json) {
    if (json.is_number_float()) {
        CHECK(std::isfinite(json.get<double>()));
    }
    if (json.is_structured()) {
        for (const Json& part : json) {
            check_numbers(part);
        }
    }
}

// Checks that every test gearbox is in one cell, as tested or as failed.
void check_cells(const Json& json, std::size_t test) {
    for (const Json& feature : json["detection"]["features"]) {
        for (const Json& level : feature["levels"]) {
            std::size_t counted = 0;
            for (const Json& cell : level["sizes"]) {
                counted += cell["tested"].get<std::size_t>() + cell["failed"].get<std::size_t>();
                CHECK(cell["detected"] <= cell["tested"]);
                CHECK(cell["pd"].is_null() ==
                      (cell["tested"] == 0 || level["threshold"].is_null()));
            }
            CHECK(counted == test);
        }
    }
}

void check_roc(const Json& json) {
    for (const Json& feature : json["reliability"]["features"]) {
        for (const Json& level : feature["levels"]) {
            const Json& roc = level["roc"];
            REQUIRE(roc["detection_rate"].size() == roc["false_alarm_rate"].size());
            CHECK(roc["detection_rate"].empty() == level["auc"]["auc"].is_null());
            if (!roc["detection_rate"].empty()) {
                CHECK(roc["detection_rate"].front() == 0.0);
                CHECK(roc["detection_rate"].back() == 1.0);
                CHECK(roc["false_alarm_rate"].back() == 1.0);
            }
        }
    }
}

TEST_CASE("For any results the JSON is complete, its numbers are finite and its counts add up") {
    for (const tests::ReportCase& each : tests::report_cases()) {
        INFO(each.name);
        const Json json = json_of(each.results);
        for (const char* key :
             {"title", "detection", "reliability", "features", "noise", "failures", "gearboxes",
              "failed", "provenance", "timing", "examples", "stiffness"}) {
            CHECK(json.contains(key));
        }
        check_numbers(json);
        check_cells(json, static_cast<std::size_t>(
                              std::count(each.results.group.begin(), each.results.group.end(), 1)));
        check_roc(json);
        CHECK(json["gearboxes"] == each.results.status.size());
        CHECK(json["failures"]["no_value"].size() == each.results.features.size());
        CHECK(json["noise"]["levels"].size() == each.results.noise_levels.size());
        CHECK(json["examples"]["refusal"].is_string());  // this program cannot build the study
        CHECK(json["examples"]["gearboxes"].empty());
        CHECK(json["stiffness"]["refusal"].is_string());
        CHECK_NOTHROW(json.dump());
    }
}

TEST_CASE("The smallest fault is the least one demonstrated by a feature's own entry") {
    const Json json = case_json("usual");
    const std::size_t n = json["noise"]["reference"];
    CHECK(json["noise"]["levels"][n] == 1.0);
    const Json& found = json["reliability"]["levels"][n]["smallest_fault"];
    REQUIRE(found.is_object());
    double least = HUGE_VAL;
    for (const Json& feature : json["reliability"]["features"]) {
        const Json& own = feature["levels"][n]["smallest_fault"];
        if (own.is_object()) {
            CHECK(own["feature"] == feature["name"]);
            least = std::min(least, own["size"].get<double>());
            if (own["from_curve"].get<bool>()) {
                CHECK(own["size"] == feature["levels"][n]["hit_miss"]["a90"]["upper"]["size"]);
            }
        }
    }
    CHECK(found["size"] == least);
}

TEST_CASE("Missing values are null or refused, never a number") {
    const Json failed = case_json("all_failed");
    CHECK(failed["failures"]["diverged"] == 500);
    CHECK(failed["failures"]["not_settled"] == 500);
    CHECK(failed["failures"]["first_rows"].size() == 20);
    CHECK(failed["failed"] == 1000);
    const Json nan = case_json("nan_feature");
    CHECK(nan["failures"]["no_value"][0]["gearboxes"] == Json({1000, 1000, 1000}));
    CHECK(nan["failures"]["no_value"][1]["gearboxes"] == Json({0, 0, 0}));
    for (const Json* json : {&failed, &nan}) {
        const Json& level = (*json)["reliability"]["features"][0]["levels"][1];
        CHECK((*json)["detection"]["features"][0]["levels"][1]["threshold"].is_null());
        CHECK(level["auc"]["auc"].is_null());
        CHECK(level["hit_miss"]["refusal"].is_string());
        CHECK(level["smallest_fault"].is_null());
    }
    for (const char* name : {"no_fault", "only_faulty", "none_detected", "all_failed", "no_rows",
                             "no_graded", "few"}) {
        INFO(name);
        const Json json = case_json(name);
        for (const Json& level : json["reliability"]["levels"]) {
            CHECK(level["smallest_fault"].is_null());
        }
    }
}

TEST_CASE("A feature that detects all or nothing, or is constant, has the corresponding area") {
    const auto area = [](const Json& json) {
        return json["reliability"]["features"][0]["levels"][1]["auc"]["auc"].get<double>();
    };
    CHECK(area(case_json("all_detected")) == 1.0);
    CHECK(area(case_json("none_detected")) == 0.0);
    CHECK(area(case_json("constant_feature")) == 0.5);
    const Json all = case_json("all_detected");
    CHECK(
        all["reliability"]["levels"][1]["smallest_fault"] ==
        Json(
            {{"feature", "te_fm0"}, {"size", 0.5e-3}, {"from_curve", false}, {"source", nullptr}}));
}

TEST_CASE("The default noise level is 1, else the least noise, else the first") {
    CHECK(case_json("usual")["noise"]["reference"] == 1);
    CHECK(case_json("no_noise")["noise"]["reference"] == 0);
    CHECK(case_json("many")["noise"]["reference"] == 4);
}

}  // namespace gearpod::test_report_json
