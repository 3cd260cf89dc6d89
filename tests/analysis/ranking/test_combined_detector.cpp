#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "analysis/ranking/combined_detector.hpp"
#include "tests/analysis/reference_data.hpp"

namespace test_combined_detector {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

// Threshold sample and test gearboxes of a study with any number of features.
struct Study {
    std::vector<double> healthy_size, test_size;
    std::vector<std::vector<double>> healthy, test;
    DetectionRequest request;

    Study(std::size_t features, const std::vector<double>& sizes)
        : healthy(features), test(features) {
        request.noise_levels = {1.0};
        for (const double size : sizes) {
            request.groups.push_back({size, size});
        }
    }
    CombinedDetector combine() const {
        std::vector<CombinedFeature> features;
        for (std::size_t f = 0; f < healthy.size(); ++f) {
            features.push_back({"f" + std::to_string(f + 1), Alarm::high, healthy[f], test[f]});
        }
        return combine_features(features, healthy_size, test_size, request);
    }
};

TEST_CASE("The combined detector agrees with scikit-learn on the same halves") {
    const auto columns = reference_columns("combined_600");
    Study study(3, {0.0, 1.0, 2.0});
    study.request.false_alarm_rate = 0.1;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        const bool test = columns[0][i] == 1.0;
        (test ? study.test_size : study.healthy_size).push_back(columns[1][i]);
        for (std::size_t f = 0; f < 3; ++f) {
            (test ? study.test : study.healthy)[f].push_back(columns[2 + f][i]);
        }
    }
    const CombinedDetector result = study.combine();
    // Reference: reference/robustness_py.txt.
    CHECK(result.refusal == "");
    CHECK(result.trained_healthy == 183);
    CHECK(result.trained_faulty == 126);
    CHECK(result.intercept == Approx(-0.4180529064).epsilon(1e-8));
    const double weights[] = {1.008452254, 0.4552623695, 0.02473485933};
    for (std::size_t f = 0; f < 3; ++f) {
        CHECK(result.weights.at(f).weight == Approx(weights[f]).epsilon(1e-8));
    }
    CHECK(result.combined.auc.auc == Approx(0.7257409059).epsilon(1e-9));
    CHECK(result.single.name == "f1");
    CHECK(result.single.auc.auc == Approx(0.7025473288).epsilon(1e-9));
    CHECK(result.combined.detection.threshold == Approx(0.3164017062).epsilon(1e-8));
    const long detected[] = {2, 9, 15}, tested[] = {62, 57, 57};
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(result.combined.detection.cells.at(c).detected == detected[c]);
        CHECK(result.combined.detection.cells.at(c).tested == tested[c]);
    }
}

// Two features with a common disturbance d: a / 2 + d and d. Their difference detects the fault.
Study disturbed(int count, double gain, unsigned seed) {
    Study study(2, {0.0, 1.0, 2.0, 3.0});
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> draw;
    const auto add = [&](std::vector<std::vector<double>>& columns, double size) {
        const double disturbance = 2.0 * draw(engine);
        columns[0].push_back(size * gain + disturbance + 0.5 * draw(engine));
        columns[1].push_back(disturbance + 0.5 * draw(engine));
    };
    for (int i = 0; i < count; ++i) {
        study.healthy_size.push_back(0.0);
        add(study.healthy, 0.0);
        study.test_size.push_back(i % 4);
        add(study.test, i % 4);
    }
    return study;
}

TEST_CASE("Features with a common disturbance detect together a fault that neither detects alone") {
    const CombinedDetector result = disturbed(4000, 0.7, 2).combine();
    REQUIRE(result.refusal == "");
    // Mean of Phi(difference) for differences of 0.7, 1.4, 2.1 with a scatter of sqrt(0.5).
    const auto area = [](double d) { return 0.5 * std::erfc(-d / std::sqrt(2.0)); };
    CHECK(result.combined.auc.auc ==
          Approx((area(0.7) + area(1.4) + area(2.1)) / 3.0).margin(0.02));
    CHECK(result.single.auc.auc < 0.75);
    CHECK(result.p_value < 1e-10);
    CHECK(result.weights[1].weight < 0.0);
    CHECK(result.combined.pod.refusal == "");
    CHECK(result.combined.pod.a90.estimate.where == SizeEstimate::Where::reached);
    // Healthy held-out gearboxes alarm at the requested rate.
    CHECK(result.combined.detection.cells[0].pd == Approx(0.05).margin(0.03));
}

TEST_CASE("A combination of features without a fault in them gains nothing") {
    int significant = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const CombinedDetector result = disturbed(600, 0.0, seed).combine();
        significant += result.p_value < 0.05;
        CHECK(std::abs(result.combined.auc.auc - 0.5) < 0.12);
    }
    CHECK(significant <= 9);  // of 60 at 5 %: 3 expected, more than 9 in 1 of 1000
}

TEST_CASE("Halves have equal sizes, and interleaved levels fall into both") {
    long all = 0, of_level[4] = {};
    for (std::size_t i = 0; i < 4000; ++i) {
        all += in_training_half(i);
        of_level[i % 4] += in_training_half(i);
    }
    CHECK(all == Approx(2000).margin(100));
    for (const long count : of_level) {
        CHECK(count == Approx(500).margin(75));
    }
}

TEST_CASE("Constant or missing features and single classes are reported") {
    Study study = disturbed(600, 0.7, 4);
    study.healthy.push_back(std::vector<double>(600, 3.0));
    study.test.push_back(std::vector<double>(600, 3.0));
    study.healthy.push_back(std::vector<double>(600, kNan));
    study.test.push_back(std::vector<double>(600, kNan));
    CombinedDetector result = study.combine();
    CHECK(result.refusal == "");
    CHECK(result.weights.size() == 2);
    REQUIRE(result.left_out.size() == 2);
    CHECK(result.left_out[0] == "f3: constant");
    CHECK_THAT(result.left_out[1], Catch::Contains("f4: no value for"));

    // A gearbox with a missing feature has no combined value: it counts as failed.
    study = disturbed(600, 0.7, 4);
    for (std::size_t i = 0; i < 600; i += 20) {
        study.test[0][i] = kNan;
    }
    result = study.combine();
    long failed = 0, missing = 0;
    for (const DetectionCell& cell : result.combined.detection.cells) {
        failed += cell.failed;
    }
    for (std::size_t i = 0; i < 600; i += 20) {
        missing += !in_training_half(i);
    }
    CHECK(failed == missing);

    study = disturbed(600, 0.7, 4);
    study.healthy.pop_back();
    study.test.pop_back();
    CHECK_THAT(study.combine().refusal, Catch::Contains("1 usable feature, two are needed"));

    study = disturbed(600, 0.7, 4);
    study.test_size.assign(600, 0.0);
    CHECK_THAT(study.combine().refusal, Catch::Contains("0 faulty training gearboxes"));

    CHECK_THAT(Study(2, {1.0}).combine().refusal, Catch::Contains("0 healthy and 0 faulty"));
}

TEST_CASE("Complete separation keeps finite weights") {
    const CombinedDetector result = disturbed(600, 1000.0, 6).combine();
    REQUIRE(result.refusal == "");
    for (const FeatureWeight& weight : result.weights) {
        CHECK(std::isfinite(weight.weight));
    }
    CHECK(result.combined.auc.auc > 0.999);
    CHECK_THAT(result.combined.pod.refusal, Catch::Contains("every faulty gearbox was detected"));
}

}  // namespace

}  // namespace test_combined_detector
