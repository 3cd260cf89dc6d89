#include "analysis/detection/condition_detection.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_condition_detection {

// A feature that is torque plus fault, in small steps, with no scatter beyond `step`.
struct Sample {
    std::vector<double> size, torque, value;
};

Sample sample(int count, double fault) {
    Sample out;
    for (int i = 0; i < count; ++i) {
        const double torque = 100.0 * (1 + i % 3);
        out.size.push_back(fault > 0.0 ? 1e-3 : 0.0);
        out.torque.push_back(torque);
        out.value.push_back(torque + fault + 0.1 * (i / 3));
    }
    return out;
}

DetectionRequest request() {
    DetectionRequest out;
    out.noise_levels = {1.0};
    out.groups = {{1e-3, 1e-3}};
    return out;
}

TEST_CASE("Thresholds by condition reveal faults that the scatter of torque hides") {
    const Sample healthy = sample(597, 0.0);
    const Sample faulty = sample(90, 30.0);
    const FeatureSample one{healthy.size, healthy.value}, other{faulty.size, faulty.value};
    // With one threshold only the highest torque alarms, healthy or not.
    const FeatureDetection global = detect("f", Alarm::high, one, other, request());
    CHECK(global.levels[0].cells[0].detected == 30);
    const ConditionDetection own =
        detect_by_condition("f", Alarm::high, one, other,
                            {"torque_N_m", "N m", healthy.torque, faulty.torque}, request());
    CHECK(own.refusal == "");
    CHECK(own.warnings.empty());
    REQUIRE(own.levels[0].thresholds.size() == 3);
    // Each torque has 199 values; the threshold is the 190th.
    CHECK(own.levels[0].thresholds[0].threshold == Approx(100.0 + 18.9));
    CHECK(own.levels[0].thresholds[2].threshold == Approx(300.0 + 18.9));
    CHECK(own.levels[0].thresholds[1].sample == 199);
    CHECK(own.levels[0].cells[0].detected == 90);
    CHECK(own.levels[0].cells[0].tested == 90);
    std::vector<double> unknown(healthy.torque);
    unknown[7] = std::nan("");
    CHECK(detect_by_condition("f", Alarm::high, one, other,
                              {"torque_N_m", "N m", unknown, faulty.torque}, request())
              .refusal == "torque_N_m is not known of every healthy gearbox");
}

// Seventy recordings of ten gearboxes, interleaved; the last gearbox has the highest values. Ten
// gearboxes show only that at most a fraction 0.31 of gearboxes is like it (Clopper-Pearson: 1 -
// 0.025^(1/10)).
TEST_CASE(
    "Recordings of few gearboxes at one condition bound its rate no better than gearboxes do") {
    std::vector<double> values;
    std::vector<std::size_t> gearbox;
    for (std::size_t i = 0; i < 70; ++i) {
        gearbox.push_back(i % 10);
        values.push_back(static_cast<double>(i % 10) + 1e-3 * static_cast<double>(i));
    }
    const std::vector<double> no_fault(70, 0.0), load(70, 1.0), fault{1e-3}, value{20.0}, at{1.0};
    const auto upper = [&](std::span<const std::size_t> of) {
        const ConditionDetection found =
            detect_by_condition("f", Alarm::high, {no_fault, values}, {fault, value},
                                {"load", "1", load, at, of}, request());
        return found.levels[0].thresholds[0].rate.upper;
    };
    CHECK(upper({}) < 0.11);
    CHECK(upper(gearbox) >= 0.308);
}

TEST_CASE("Conditions without a threshold do not count; continuous inputs are not conditions") {
    const Sample healthy = sample(60, 0.0);
    Sample faulty = sample(9, 5.0);
    faulty.torque[0] = 700.0;
    const FeatureSample one{healthy.size, healthy.value}, other{faulty.size, faulty.value};
    const ConditionColumn column{"torque_N_m", "N m", healthy.torque, faulty.torque};
    const ConditionDetection own =
        detect_by_condition("f", Alarm::high, one, other, column, request());
    CHECK(own.levels[0].without == 1);
    CHECK(own.levels[0].cells[0].tested == 8);
    REQUIRE(own.warnings.size() == 2);
    CHECK_THAT(own.warnings[0], Catch::Contains("3 of 3 values of torque_N_m have too few"));
    const ConditionColumn continuous{"f", "1", healthy.value, faulty.value};
    CHECK_THAT(detect_by_condition("f", Alarm::high, one, other, continuous, request()).refusal,
               Catch::Contains("must have few levels"));
    const ConditionColumn none{"torque_N_m", "N m", {}, {}};
    CHECK(detect_by_condition("f", Alarm::high, {}, {}, none, request()).refusal ==
          "no healthy gearboxes");
    CHECK_THROWS_AS(detect_by_condition("f", Alarm::high, one, other, none, request()),
                    std::invalid_argument);
}

}  // namespace gearpod::analysis::test_condition_detection
