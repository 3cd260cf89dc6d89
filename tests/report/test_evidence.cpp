// Checks the evidence of a report: nothing of the report is lost or said twice, absent evidence is
// named, the counts are those of the sample, and the hashes are SHA-256.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "mc/files/sha256.hpp"
#include "mc/report/evidence.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/report/report_cases.hpp"

namespace test_evidence {

using namespace gearpod;

namespace {

// Number of blocks with each key.
std::map<std::string, int> keys_of(const analysis::Report& report) {
    std::map<std::string, int> keys;
    for (const analysis::Section& section : report.sections) {
        for (const auto& block : section.blocks) {
            keys[std::visit([](const auto& shown) { return shown.key; }, block)]++;
        }
    }
    return keys;
}

analysis::Report findings_of(const tests::ReportCase& each) {
    const mc::ColumnRows rows(each.results);
    return mc::results_report(each.results, rows, mc::reliability_of(each.results, rows, "", 2));
}

std::vector<std::string> names_of(const mc::Results& results) {
    std::vector<std::string> names;
    for (const mc::FeatureResult& feature : results.features) {
        names.push_back(feature.name);
    }
    return names;
}

analysis::Report evidence_of(const tests::ReportCase& each) {
    const analysis::Report findings = findings_of(each);
    return analysis::evidence_report(
        {analysis::EvidenceKind::gearboxes, findings, names_of(each.results)});
}

}  // namespace

TEST_CASE("Each finding of every report is in its evidence once, under the subjects in order") {
    const std::vector<std::string> order{"scope",        "definition", "threshold",
                                         "false_alarms", "detection",  "limits",
                                         "data",         "software",   "further"};
    for (const tests::ReportCase& each : tests::report_cases()) {
        INFO(each.name);
        const analysis::Report evidence = evidence_of(each);
        const auto found = keys_of(evidence);
        std::map<std::string, int> statements;
        for (const analysis::Section& section : evidence.sections) {
            for (const auto& block : section.blocks) {
                if (const auto* statement = std::get_if<analysis::Statement>(&block)) {
                    statements[statement->text]++;
                }
            }
        }
        for (const analysis::Section& section : findings_of(each).sections) {
            for (const auto& block : section.blocks) {
                if (const auto* statement = std::get_if<analysis::Statement>(&block)) {
                    INFO(statement->text);
                    CHECK(statements[statement->text] == 1);
                } else {
                    CHECK(found.at(std::get<analysis::Table>(block).key) == 1);
                }
            }
        }
        auto place = order.begin();
        for (const analysis::Section& section : evidence.sections) {
            INFO(section.key);
            const auto next = std::find(place, order.end(), section.key);
            REQUIRE(next != order.end());
            CHECK_FALSE(section.title.empty());
            place = next + 1;
        }
    }
}

TEST_CASE("Findings stand under the subject that they are evidence for") {
    const auto cases = tests::report_cases();
    const auto usual = std::find_if(cases.begin(), cases.end(),
                                    [](const auto& each) { return each.name == "usual"; });
    REQUIRE(usual != cases.end());
    const analysis::Report evidence = evidence_of(*usual);
    const std::map<std::string, std::string> subjects{{"evidence.indicators", "definition"},
                                                      {"thresholds.0", "threshold"},
                                                      {"headline", "detection"},
                                                      {"curves.0", "detection"},
                                                      {"rates.0", "detection"},
                                                      {"smallest_fault", "detection"},
                                                      {"facts", "threshold"},
                                                      {"evidence.scope", "scope"},
                                                      {"ranking.0", "further"}};
    for (const analysis::Section& section : evidence.sections) {
        for (const auto& block : section.blocks) {
            const std::string key = std::visit([](const auto& shown) { return shown.key; }, block);
            if (const auto subject = subjects.find(key); subject != subjects.end()) {
                INFO(key);
                CHECK(section.key == subject->second);
            }
        }
    }
}

TEST_CASE("Evidence that the results do not provide is named, and only that") {
    const auto absent = [](const std::string& name, const std::string& subject) {
        const auto cases = tests::report_cases();
        const auto each = std::find_if(cases.begin(), cases.end(),
                                       [&](const auto& one) { return one.name == name; });
        REQUIRE(each != cases.end());
        return analysis::statement_text(evidence_of(*each), "evidence.absent." + subject);
    };
    const std::string curve = "a POD curve with a90 and its bound";
    CHECK(absent("usual", "detection").find(curve) == std::string::npos);
    CHECK(absent("usual", "detection").find("sustained alarms") != std::string::npos);
    CHECK(absent("usual", "threshold").empty());
    CHECK(absent("no_fault", "detection").find(curve) != std::string::npos);
    // A report without any finding: everything is absent.
    const analysis::Report nothing;
    const analysis::Report evidence =
        analysis::evidence_report({analysis::EvidenceKind::recordings, nothing, {}, {}, false});
    for (const char* subject : {"threshold", "false_alarms", "detection", "data"}) {
        INFO(subject);
        CHECK(analysis::statement_text(evidence, std::string("evidence.absent.") + subject)
                  .starts_with("Not provided by this study: "));
    }
    CHECK(analysis::statement_text(evidence, "evidence.absent.data").find("hashes") !=
          std::string::npos);
}

TEST_CASE("Healthy alarms are counted by part of the sample") {
    analysis::LevelDetection level;
    level.noise_level = 1.0;
    level.threshold = 2.0;
    level.threshold_sample = 262;
    level.threshold_alarms = 1;
    analysis::DetectionCell healthy, faulty;
    healthy.tested = 40;
    // Clopper-Pearson bounds of 0 of 40: 0 and 1 - 0.025^(1/40) = 0.0881.
    healthy.exact = {0.0, 1.0 - std::pow(0.025, 1.0 / 40.0)};
    faulty.size = {1e-3, 1e-3};
    faulty.tested = faulty.detected = 40;
    level.cells = {healthy, faulty};
    analysis::LevelDetection alone = level;
    alone.cells = {faulty};
    const analysis::Table table = analysis::healthy_alarms_table(
        {{"fm4", analysis::Alarm::high, {level, alone}, {}}}, {}, "gearboxes");
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0] == std::vector<std::string>{"fm4", "x 1", "1 of 262", "1 in 263", "0 of 40",
                                                    "[0.00, 0.09]"});
    CHECK(table.rows[1][4] == "-");
    CHECK(table.rows[1][5] == "-");
}

TEST_CASE("Hashes are SHA-256 (FIPS 180-4; vectors of NIST's examples)") {
    CHECK(mc::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(mc::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(mc::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(mc::sha256(std::string(1000000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    CHECK(mc::file_sha256("/nonexistent/file").empty());
}

}  // namespace test_evidence
