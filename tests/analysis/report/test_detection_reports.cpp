#include <nlohmann/json.hpp>

#include "analysis/report/detection_json.hpp"
#include "analysis/report/findings/findings.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_detection_reports {

FeatureDetection example(const std::string& name, double scale) {
    FeatureDetection feature;
    feature.feature = name;
    feature.alarm = name == "te_fc" ? Alarm::low : Alarm::high;
    for (const double noise : {1.0, 4.0}) {
        LevelDetection level;
        level.noise_level = noise;
        level.threshold = 1.2345e-5 * scale;
        level.threshold_sample = 400;
        level.threshold_alarms = 19;
        for (const double size : {0.0, 1e-3, 2e-3, 4.3e-3}) {
            const double pd = std::min(1.0, 0.05 + 300.0 * size * scale / noise);
            level.cells.push_back({{size, size},
                                   398,
                                   static_cast<long>(pd * 398),
                                   2,
                                   pd,
                                   std::max(0.0, pd - 0.03),
                                   std::min(1.0, pd + 0.03)});
        }
        feature.levels.push_back(level);
    }
    return feature;
}

std::vector<FeatureDetection> examples() {
    std::vector<FeatureDetection> features;
    double scale = 0.3;
    for (const char* name :
         {"te_rms", "te_kurtosis", "te_fc", "te_fm0", "sensor_rms", "window_ratio", "window_z"}) {
        features.push_back(example(name, scale));
        scale += 0.4;
    }
    return features;
}

DetectionRequest request() {
    DetectionRequest out;
    out.noise_levels = {1.0, 4.0};
    return out;
}

std::string detection_text(const std::vector<FeatureDetection>& features,
                           const DetectionRequest& requested) {
    const Findings findings({features, nullptr, requested});
    Report report;
    report.add(headline_section(findings, "", "", ""));
    add_detection_sections(report, findings);
    return report_text(report);
}

TEST_CASE("The detection table is aligned and at most 120 columns wide") {
    auto features = examples();
    features[1].warnings = features[2].warnings = {"something to know"};
    const std::string text = detection_text(features, request());
    INFO(text);
    std::istringstream lines(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);) {
        CHECK(line.size() <= 120);
        all.push_back(line);
    }
    // Rows of one block have equal lengths: cells are aligned to their column's right edge.
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].starts_with("size mm ")) {
            for (std::size_t row = 1; row <= 4; ++row) {
                CHECK(all[i + row].size() == all[i].size());
            }
        }
    }
    CHECK_THAT(text, Catch::Contains("1.00 [0.97, 1.00]"));
    CHECK_THAT(text, Catch::Contains("> 3.7035e-06"));
    CHECK_THAT(text, Catch::Contains("< 1.358e-05"));
    CHECK_THAT(text, Catch::Contains("19/400"));
    CHECK_THAT(text, Catch::Contains("Warning: something to know (te_kurtosis and te_fc)."));
    CHECK(text.back() == '\n');
}

TEST_CASE("Sizes that are pure numbers are shown without a unit") {
    DetectionRequest shares = request();
    shares.size.unit = "1";
    const std::string text = detection_text(examples(), shares);
    CHECK_THAT(text, !Catch::Contains("mm"));
    CHECK_THAT(text, Catch::Contains("\n0.0043 "));
    const auto json = nlohmann::json::parse(detection_json(examples(), shares).dump());
    CHECK(json["size"]["unit"] == "1");
    CHECK(json["features"][0]["levels"][0]["sizes"][3]["size_high"] == 4.3e-3);
}

TEST_CASE("A table without a threshold or without features states this") {
    auto features = examples();
    features.resize(1);
    features[0].levels[0].threshold = std::numeric_limits<double>::quiet_NaN();
    features[0].levels[0].cells[1].pd = std::numeric_limits<double>::quiet_NaN();
    const std::string text = detection_text(features, request());
    CHECK_THAT(text, Catch::Contains("none"));
    CHECK_THAT(text, !Catch::Contains("nan"));
    CHECK_THAT(detection_text({}, request()), Catch::Contains("computes no feature"));
}

TEST_CASE("The JSON holds every number of the detection, and null where there is none") {
    auto features = examples();
    features[2].levels[1].threshold = std::numeric_limits<double>::quiet_NaN();
    features[2].levels[1].cells[3].pd = std::numeric_limits<double>::quiet_NaN();
    const auto json = nlohmann::json::parse(detection_json(features, request()).dump());
    CHECK(json["confidence"] == 0.95);
    REQUIRE(json["features"].size() == 7);
    const auto& fc = json["features"][2];
    CHECK(fc["name"] == "te_fc");
    CHECK(fc["alarm"] == "low");
    CHECK(fc["levels"][1]["threshold"].is_null());
    CHECK(fc["levels"][1]["sizes"][3]["pd"].is_null());
    CHECK(fc["levels"][0]["threshold_sample"] == 400);
    CHECK(fc["levels"][0]["sizes"][3]["size_high"] == 4.3e-3);
    CHECK(fc["levels"][0]["sizes"][3]["failed"] == 2);
    CHECK(json["features"][6]["levels"][0]["reliable_size"] == std::vector{2e-3, 2e-3});
    CHECK(json["features"][0]["levels"][1]["reliable_size"].is_null());
}

TEST_CASE("The headline names the fault as the study does, or what finds most") {
    const auto features = examples();
    const DetectionRequest requested = request();
    for (const auto& [fault, found, none] :
         {std::tuple{"a fault", "A fault of ", "No tested fault is found"},
          std::tuple{"a chip", "A chip of ", "No tested chip is found"},
          std::tuple{"pitting", "Pitting of ", "No tested pitting is found"}}) {
        Findings findings({features, nullptr, requested, Subject::gearboxes, fault});
        CHECK(headline_text(findings, 0) ==
              std::string(found) +
                  "2 mm is found with 90 % probability at 95 % "
                  "confidence by the tooth z-score (window_z) at noise x 1.");
        findings.smallest[0].reset();
        CHECK_THAT(headline_text(findings, 0),
                   Catch::StartsWith(none) &&
                       Catch::EndsWith("finds 100 [97, 100] % of those of 4.3 mm."));
    }
}

TEST_CASE(
    "The headline comes first, with the size as a share of the tooth and the figure's "
    "description") {
    const auto features = examples();
    const DetectionRequest requested = request();
    const auto share = [](double size) {
        return size > 1e-3 ? std::string("70 % of the tooth section") : std::string();
    };
    const Findings findings({features,
                             nullptr,
                             requested,
                             Subject::gearboxes,
                             "a crack",
                             0,
                             {},
                             share,
                             "use real teeth"});
    const Section section = headline_section(findings, "Holds for steady torque.", "", "");
    std::vector<std::string> keys;
    for (const auto& block : section.blocks) {
        std::visit([&](const auto& shown) { keys.push_back(shown.key); }, block);
    }
    CHECK(std::vector<std::string>(keys.begin(), keys.begin() + 3) ==
          std::vector<std::string>{"headline", "figure", "assumptions"});
    const Report report{{section}};
    CHECK_THAT(statement_text(report, "headline"),
               Catch::StartsWith("A crack of 2 mm, 70 % of the tooth section, is found with 90 %"));
    CHECK_THAT(statement_text(report, "figure"),
               Catch::Contains("by window_z at noise x 1. Marks: detection rates"));
    CHECK_THAT(report_text(report), !Catch::Contains("Marks:"));
    CHECK(statement_text(report, "next") == "Next step: use real teeth.");
}

TEST_CASE("A threshold has the digits that distinguish it from the healthy median") {
    auto features = examples();
    LevelDetection& level = features[5].levels[0];
    level.threshold = 1.0003;
    level.healthy_median = 1.0001;
    features[2].levels[0].threshold = 0.99999998;
    features[2].levels[0].healthy_median = 1.0;
    const DetectionRequest requested = request();
    const Findings findings({features, nullptr, requested});
    CHECK(findings.alarm_if(5, 0, 4) == "> 1.0003");
    CHECK(findings.alarm_if(2, 0, 4) == "< 0.99999998");
    level.healthy_median = 1.0003;  // healthy records equal the threshold
    CHECK(findings.alarm_if(5, 0, 4) == "> 1");
}

TEST_CASE("The headline counts features without a threshold") {
    auto features = examples();
    features[0].levels[0].threshold = kNan;
    const DetectionRequest requested = request();
    Findings findings({features, nullptr, requested});
    findings.smallest[0].reset();
    CHECK_THAT(headline_text(findings, 0), Catch::EndsWith(" 1 of the 7 features has no threshold, "
                                                           "so their detection is unknown."));
}

TEST_CASE("A transferred bound names its origin") {
    const auto features = examples();
    const DetectionRequest requested = request();
    const Reliability curves{
        .features = {{"te_rms", Alarm::high, std::vector<LevelReliability>(2)}},
        .rankings = {},
        .conditions = {}};
    Findings findings({features, nullptr, requested});
    findings.smallest[0] = SmallestFault{"te_rms", 1e-3, true, {"te_fc", 5.0}, false};
    findings.reliability = &curves;
    findings.unassessable = "";
    const Report report{{limits_section(findings)}};
    CHECK_THAT(report_text(report),
               Catch::Contains("this is the bound of te_fc at noise x 5, which finds no more"));
    findings.reliability = nullptr;
    const Report headline{{headline_section(findings, "", "", "")}};
    CHECK_THAT(report_text(headline),
               Catch::Contains("+ Bound of another feature or noise level") &&
                   Catch::Contains(": te_fc at noise x 5."));
}

}  // namespace gearpod::analysis::test_detection_reports
