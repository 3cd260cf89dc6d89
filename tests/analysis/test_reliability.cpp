#include <nlohmann/json.hpp>

#include "analysis/reliability.hpp"
#include "analysis/report/detection_json.hpp"
#include "analysis/report/findings/findings.hpp"
#include "analysis/report/report.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_reliability {

const double kNan = std::numeric_limits<double>::quiet_NaN();

// Features over gearboxes at two noise levels: a good one, one without values, one constant, one
// that detects all and one that detects none.
struct Study {
    DetectionRequest request;
    std::vector<double> healthy_size, test_size, torque, healthy_torque;
    std::vector<std::string> names{"good", "failed", "flat", "all", "none"};
    std::vector<std::vector<double>> healthy{5}, test{5};

    explicit Study(int healthy_count = 400, int graded_count = 1400) {
        request.noise_levels = {1.0, 4.0};
        for (const double size : {0.0, 0.5e-3, 1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3}) {
            request.groups.push_back({size, size});
        }
        std::mt19937_64 engine(31);
        std::normal_distribution<double> draw;
        const auto add = [&](std::vector<std::vector<double>>& columns, double size,
                             double drawn_torque) {
            for (const double noise : request.noise_levels) {
                columns[0].push_back(
                    std::exp(1e3 * size / noise + 0.3 * drawn_torque + draw(engine)));
                columns[1].push_back(kNan);
                columns[2].push_back(2.0);
                columns[3].push_back(draw(engine) + (size > 0.0 ? 100.0 : 0.0));
                columns[4].push_back(draw(engine) - (size > 0.0 ? 100.0 : 0.0));
            }
        };
        for (int i = 0; i < healthy_count; ++i) {
            healthy_size.push_back(0.0);
            healthy_torque.push_back(i % 2);
            add(healthy, 0.0, healthy_torque.back());
        }
        for (int i = 0; i < graded_count; ++i) {
            test_size.push_back(request.groups[i % request.groups.size()].high);
            torque.push_back((i / 7) % 2);
            add(test, test_size.back(), torque.back());
        }
    }

    std::vector<FeatureDetection> detections() const {
        return test::tabulated(names.size(), [&](std::size_t f) {
            return detect(names[f], Alarm::high, {healthy_size, healthy[f]}, {test_size, test[f]},
                          request);
        });
    }

    Reliability assess(bool by_torque = false, int threads = 2, std::size_t shares = 1) const {
        ReliabilityData data;
        data.healthy_size = healthy_size;
        data.test_size = test_size;
        data.inputs = {{"torque", "1", torque}};
        if (by_torque) {
            data.condition = {{"torque", "1", healthy_torque, torque}};
        }
        for (std::size_t f = 0; f < names.size(); ++f) {
            data.features.push_back({names[f], Alarm::high, healthy[f], test[f]});
        }
        const auto found = detections();
        std::vector<LevelReliability> pairs(names.size() * request.noise_levels.size());
        // Shares in an arbitrary number, as on several machines.
        for (std::size_t first = 0; first < shares; ++first) {
            auto share = assess_pairs(data, found, request, {first, shares}, threads);
            for (std::size_t i = 0; i < share.size(); ++i) {
                pairs[first + i * shares] = std::move(share[i]);
            }
        }
        return assess_reliability(data, request, std::move(pairs));
    }
};

std::string text_of(const Study& study, const Reliability& reliability) {
    const auto detections = study.detections();
    const Findings findings({detections, &reliability, study.request});
    Report report;
    report.add(headline_section(findings, "", "", ""));
    report.add(limits_section(findings));
    add_detection_sections(report, findings);
    return report_text(report);
}

TEST_CASE("A good feature gets a curve, the others the reason for having none") {
    const Study study;
    const Reliability result = study.assess();
    REQUIRE(result.features.size() == 5);
    const LevelReliability& good = result.features[0].levels[0];
    CHECK(good.hit_miss.refusal == "");
    CHECK(good.hit_miss.chosen.curve.form.floor >= 0.0);
    // ln(feature) = a/mm + torque's part + normal scatter. Half of the gearboxes alarm where the
    // mean meets the threshold, the 95 % quantile of the healthy ones, about 1.7 + 0.15 in the
    // mean.
    CHECK(good.hit_miss.a50.estimate.size == Approx(1.7e-3).margin(0.15e-3));
    CHECK(good.hit_miss.a90.upper.size > good.hit_miss.a90.estimate.size);
    CHECK(good.signal_response.refusal == "");
    CHECK(good.signal_response.a90.estimate.size ==
          Approx(good.hit_miss.a90.estimate.size).margin(0.2e-3));
    CHECK(good.auc.healthy == 600);
    CHECK(good.auc.faulty == 1200);
    CHECK(std::isnan(good.auc_by_size[0].auc));
    CHECK(good.auc_by_size[6].auc > good.auc_by_size[1].auc);
    CHECK(good.misses.inputs[0].larger_in_misses < 0.5);  // torque helps detection
    const auto refusal = [&](std::size_t f) {
        return result.features[f].levels[0].hit_miss.refusal;
    };
    CHECK(refusal(1) == "no threshold");
    CHECK_THAT(refusal(2), Catch::Contains("no faulty gearbox was detected"));
    CHECK_THAT(refusal(3), Catch::Contains("every faulty gearbox was detected"));
    CHECK_THAT(refusal(4), Catch::Contains("no faulty gearbox was detected"));
    CHECK(result.rankings[0].ranks[0].name == "all");
    CHECK(result.rankings[0].left_out.size() == 1);
    CHECK(smallest_fault(result, 0)->feature == "all");
    CHECK(smallest_fault(result, 0)->size == 0.5e-3);
    CHECK(!smallest_fault(result, 0)->from_curve);
    CHECK(!smallest_fault(result, 0, 4));
}

TEST_CASE("The text is complete within its columns and contains no invented number") {
    Study study;
    study.request.size = {"fault_broken", "1"};
    std::string text;
    for (const std::size_t columns : {80, 100, 120}) {
        set_text_width(columns);
        text = text_of(study, study.assess(true));
        INFO(text);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            CHECK(line.size() <= columns);
        }
    }
    CHECK(text_width() == 120);
    CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("inf"));
    CHECK_THAT(text, Catch::Contains("no curve, because no threshold"));
    CHECK_THAT(text, Catch::Contains("A fault of 0.0005 is found with 90 % probability"));
    CHECK_THAT(text, Catch::Contains("Not ranked: failed: no value for 1800 of 1800"));
    CHECK_THAT(text, Catch::Contains("Thresholds by torque"));
    CHECK_THAT(text, !Catch::Contains(" mm"));
    CHECK(text.back() == '\n');
}

TEST_CASE("A handful of gearboxes gets no curve, no area and no rank") {
    for (const auto& [healthy, test, curves] :
         {std::tuple{1, 7, false}, std::tuple{400, 7, false}, std::tuple{400, 14, true}}) {
        const Study study(healthy, test);
        const std::string text = text_of(study, study.assess());
        INFO(text);
        CHECK((text.find("POD curve") != std::string::npos) == curves);
        CHECK((text.find("Only ") == 0 || text.find("Too few") == 0) == !curves);
    }
}

TEST_CASE("The JSON holds curves, bounds and tests, null where there is no number") {
    const Study study;
    const auto json =
        nlohmann::json::parse(reliability_json(study.assess(true), study.request).dump());
    const auto& good = json["features"][0]["levels"][0];
    CHECK(good["hit_miss"]["a90"]["upper"]["where"] == "reached");
    CHECK(good["hit_miss"]["a90"]["upper"]["size"].is_number());
    CHECK(good["hit_miss"]["refusal"].is_null());
    CHECK(good["hit_miss"]["band"]["lower"].size() == 41);
    CHECK(good["signal_response"]["candidates"].size() == 4);
    CHECK(good["auc_by_size"].size() == 7);
    const auto& failed = json["features"][1]["levels"][0];
    CHECK(failed["hit_miss"]["a90"].is_null());
    CHECK(failed["auc"]["auc"].is_null());
    CHECK(failed["hit_miss"]["refusal"] == "no threshold");
    CHECK(json["size"]["unit"] == "m");
    CHECK(json["levels"][1]["ranking"]["ranks"].size() == 4);
    CHECK(json["conditions"].size() == 5);
    CHECK(json["conditions"][0]["levels"][0]["thresholds"].size() == 2);
}

TEST_CASE("The JSON maps detection over every input and does not depend on the number of threads") {
    const Study study;
    const auto json = reliability_json(study.assess(false, 1), study.request);
    CHECK(json.dump() == reliability_json(study.assess(false, 4), study.request).dump());
    CHECK(json.dump() == reliability_json(study.assess(false, 2, 3), study.request).dump());
    const auto& torque = json["robustness"]["torque"]["features"];
    REQUIRE(torque.size() == 5);
    const auto& good = torque[0]["levels"][0];
    REQUIRE(good["bins"].size() == 2);  // torque 0 and 1
    CHECK(good["bins"][0]["pd"] < good["bins"][1]["pd"]);
    CHECK(good["p_value"] < 0.05);
    CHECK(torque[1]["levels"][0]["refusal"] == "no gearbox has a value of the feature");  // failed
    CHECK(torque[3]["levels"][0]["p_value"].is_null());  // detects all
    // Torque adds as much to the logarithm as 0.3 mm do.
    CHECK(good["a90"][0]["estimate"]["size"].get<double>() -
              good["a90"][1]["estimate"]["size"].get<double>() ==
          Approx(0.3e-3).margin(0.15e-3));
    CHECK(json["robustness"]["noise_level"]["features"][0]["bins"].size() == 2);
}

TEST_CASE("Studies without healthy or without faulty gearboxes are reported, not computed") {
    const std::pair<int, int> counts[] = {{0, 0}, {0, 70}, {50, 0}, {1, 7}, {400, 7}};
    for (const auto& [healthy, test] : counts) {
        Study study(healthy, test);
        const Reliability result = study.assess(true);
        const std::string text = text_of(study, result);
        INFO(text);
        CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("inf"));
        const std::string json = reliability_json(result, study.request).dump();
        CHECK(!json.empty());
        if (healthy == 0) {
            CHECK(result.features[0].levels[0].hit_miss.refusal == "no threshold");
        } else if (test == 0) {
            CHECK(!result.features[0].levels[0].hit_miss.refusal.empty());
        }
    }
}

}  // namespace gearpod::analysis::test_reliability
