// Checks the text about healthy samples that are too small for their false-alarm rate.
#include "analysis/detection/threshold.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_false_alarm_text {

FeatureDetection with_samples(const DetectionRequest& request, const std::vector<long>& samples) {
    FeatureDetection feature;
    feature.feature = "te_rms";
    for (std::size_t n = 0; n < samples.size(); ++n) {
        LevelDetection level;
        level.noise_level = request.noise_levels[n];
        level.threshold_sample = samples[n];
        level.threshold = sample_for_threshold(request.false_alarm_rate) <= samples[n] ? 1.0 : kNan;
        feature.levels.push_back(level);
    }
    return feature;
}

std::string shortage(const DetectionRequest& request, const std::vector<long>& samples) {
    const std::vector<FeatureDetection> features{with_samples(request, samples)};
    return sample_shortage(features, request, Subject::gearboxes);
}

TEST_CASE("The smallest sample with a threshold has the requested expected rate") {
    // The expected rate beyond the largest of n is 1 / (n + 1).
    CHECK(sample_for_threshold(0.05) == 19);
    CHECK(sample_for_threshold(0.001) == 999);
    CHECK(sample_for_threshold(1e-6) == 999'999);
    CHECK(threshold_rank(999, 0.001) == 999);
    CHECK(threshold_rank(998, 0.001) > 998);
}

TEST_CASE("A sample without a threshold reports the required number") {
    const std::string none = sample_shortage(200, 0.001, 0.95, Subject::gearboxes);
    CHECK_THAT(none, Catch::Contains("Too few healthy gearboxes") &&
                         Catch::Contains("At least 999 are needed"));
    const long enough = sample_for_rate(0.001, 0.95);
    CHECK_THAT(none, Catch::Contains("and " + std::to_string(enough)));
    CHECK_THAT(sample_shortage(999, 0.001, 0.95, Subject::recordings),
               Catch::StartsWith("Few healthy recordings"));
    CHECK_THAT(sample_shortage(enough - 1, 0.001, 0.95, Subject::gearboxes),
               Catch::StartsWith("Few"));
    CHECK(sample_shortage(enough, 0.001, 0.95, Subject::gearboxes).empty());
}

TEST_CASE("Several records of each gearbox count, and the text does not mention tail fits") {
    const auto of = [](long gearboxes, long records) {
        return sample_shortage(gearboxes, 1e-4, 0.95, Subject::gearboxes, records);
    };
    CHECK(of(2000, 400).empty());
    CHECK_THAT(of(2000, 4),
               Catch::StartsWith("Few records (4 of each of 2000 healthy gearboxes)") &&
                   Catch::Contains("rarer than one") && Catch::Contains("At least 5 of each"));
    CHECK_THAT(of(2000, 6), Catch::Contains("a false-alarm rate of 0.0001 only to between"));
}

TEST_CASE(
    "A report counts the thresholds whose rate is undetermined by the records of each gearbox") {
    DetectionRequest request;
    request.false_alarm_rate = 1e-4;
    request.noise_levels = {0.0, 1.0};
    request.threshold_records = 400;
    std::vector<FeatureDetection> features{with_samples(request, {800'000, 800'000})};
    features[0].levels[1].threshold_rate = {9e-5, 1.1e-4};
    features[0].levels[0].threshold_rate = {8e-5, 1.2e-4};
    CHECK(sample_shortage(features, request, Subject::gearboxes).empty());
    features[0].levels[0].threshold_rate = {0.0, 1.8e-3};
    CHECK_THAT(sample_shortage(features, request, Subject::gearboxes),
               Catch::StartsWith("Healthy gearboxes differ too much") &&
                   Catch::Contains("1 of the 2 thresholds") && Catch::Contains("0.0018"));
}

TEST_CASE("A report counts the exponentially tilted thresholds and the gearboxes of the others") {
    DetectionRequest request;
    request.false_alarm_rate = 1e-4;
    request.noise_levels = {0.0, 1.0};
    request.threshold_records = 32;
    request.importance_sampling = true;
    std::vector<FeatureDetection> features{with_samples(request, {640, 640})};
    features[0].feature = "window_ratio";
    CHECK_THAT(sample_shortage(features, request, Subject::gearboxes),
               Catch::StartsWith("Too few gearboxes have alarms") &&
                   Catch::Contains("640 give no threshold"));
    features[0].levels[1].threshold_sample = 640 * 32;
    features[0].levels[1].importance_sampled = {640, 100.0, 15.6};
    CHECK_THAT(
        sample_shortage(features, request, Subject::gearboxes),
        Catch::StartsWith(
            "1 of the 2 thresholds is from importance sampling with 32 records of each of 640") &&
            Catch::Contains("16 times rarer") && Catch::Contains("For 1 other, too"));
    CHECK_THAT(sample_shortage(640, 1e-4, 0.95, Subject::gearboxes, 32, true),
               Catch::StartsWith("Importance sampling supports") && Catch::Contains("640 give no"));
}

TEST_CASE("A rate is not claimed from exponentially tilted records of too few gearboxes") {
    CHECK_THAT(sample_shortage(19, 0.01, 0.95, Subject::gearboxes, 32, true),
               Catch::StartsWith(
                   "Importance sampling needs at least 20 gearboxes to set thresholds. Too few"));
    CHECK_THAT(sample_shortage(20, 0.01, 0.95, Subject::gearboxes, 32, true),
               Catch::StartsWith("Importance sampling supports"));
}

TEST_CASE(
    "A report does not take plain records without a threshold for exponentially tilted ones") {
    DetectionRequest request;
    request.false_alarm_rate = 1e-3;
    request.noise_levels = {1.0, 5.0};
    request.threshold_records = 32;
    request.importance_sampling = true;
    std::vector<FeatureDetection> features{with_samples(request, {6400, 6400}),
                                           with_samples(request, {6400, 6400})};
    features[1].feature = "window_ratio";
    for (LevelDetection& level : features[0].levels) {
        level.threshold_rate = {0.0, 0.018};
    }
    for (LevelDetection& level : features[1].levels) {
        level.importance_sampled = {200, 70.0, 5.0};
    }
    // All accelerometer thresholds exist; the rates of the te_rms thresholds are undetermined.
    CHECK(sample_shortage(features, request, Subject::gearboxes) ==
          "2 of the 4 thresholds are from importance sampling with 32 records of each of 200 "
          "healthy gearboxes, for a false-alarm rate 5 times rarer than one in these. 2 are from "
          "records without importance sampling: the rate may be up to 0.018.");
    features[0] = with_samples(request, {480, 480});
    CHECK_THAT(sample_shortage(features, request, Subject::gearboxes),
               Catch::EndsWith("2 for features without accelerometer noise have too few records."));
}

TEST_CASE("A report names the noise levels without a threshold") {
    DetectionRequest request;
    request.false_alarm_rate = 0.01;
    request.noise_levels = {0.0, 1.0};
    CHECK_THAT(shortage(request, {90, 90}), Catch::StartsWith("Too few"));
    CHECK_THAT(shortage(request, {5000, 90}), Catch::StartsWith("At noise x 1: Too few"));
    CHECK_THAT(shortage(request, {5000, 120}), Catch::StartsWith("Few"));
    CHECK(shortage(request, {5000, 5000}).empty());
    CHECK(sample_shortage({}, request, Subject::gearboxes).empty());
}

}  // namespace gearpod::analysis::test_false_alarm_text
