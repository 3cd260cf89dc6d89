#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/report/detection_json.hpp"
#include "analysis/report/detection_text.hpp"

namespace test_detection_reports {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

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
            for (std::size_t row = 1; row <= 6; ++row) {
                CHECK(all[i + row].size() == all[i].size());
            }
        }
    }
    CHECK_THAT(text, Catch::Contains("1.00 [0.97, 1.00]"));
    CHECK_THAT(text, Catch::Contains("> 3.7035e-06"));
    CHECK_THAT(text, Catch::Contains("< 1.358e-05"));
    CHECK_THAT(text, Catch::Contains("19/400"));
    CHECK_THAT(text, Catch::Contains("warning: something to know (te_kurtosis, te_fc)"));
    CHECK(text.back() == '\n');
}

TEST_CASE("The table ends with the reliable sizes or states that they were not reached") {
    const std::string text = detection_text(examples(), request());
    const std::string closing = text.substr(text.find("Smallest tested size"));
    INFO(closing);
    CHECK_THAT(closing, Catch::Contains("not reached"));
    CHECK_THAT(closing, Catch::Contains("4.3 mm"));
    CHECK_THAT(closing, Catch::Contains("x 4"));
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
    CHECK_THAT(detection_text({}, request()), Catch::Contains("no features"));
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

}  // namespace

}  // namespace test_detection_reports
