#include <boost/math/distributions/normal.hpp>

#include "analysis/detection/detection.hpp"
#include "analysis/detection/threshold.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_detection {

const double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> counted(int n) {
    return test::tabulated(n, [](int i) { return i + 1.0; });
}

TEST_CASE("The threshold is the order statistic that keeps the false-alarm rate") {
    // For 99 values at 5 %, (n+1)(1-rate) = 95 exactly: the 95th value, with 4 of the sample
    // beyond.
    const Threshold high = SortedSample(counted(99), Alarm::high).threshold(0.05);
    CHECK(high.value == 95.0);
    CHECK(high.alarms == 4);
    const Threshold low = SortedSample(counted(99), Alarm::low).threshold(0.05);
    CHECK(low.value == 5.0);
    CHECK(low.alarms == 4);
    CHECK(SortedSample(counted(100), Alarm::high).threshold(0.05).value == 96.0);
    CHECK(SortedSample(counted(19), Alarm::high).threshold(0.05).value == 19.0);
    CHECK(std::isnan(SortedSample(counted(18), Alarm::high).threshold(0.05).value));
    CHECK(std::isnan(SortedSample({}, Alarm::high).threshold(0.05).value));
}

TEST_CASE(
    "The expected false-alarm rate of a threshold equals the requested rate and does not exceed "
    "it") {
    std::mt19937_64 engine(21);
    std::normal_distribution<double> draw;
    const boost::math::normal normal;
    double sum = 0.0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
        const std::vector<double> healthy =
            test::tabulated(39, [&](auto) { return draw(engine); });
        sum += cdf(complement(normal, SortedSample(healthy, Alarm::high).threshold(0.05).value));
    }
    // (n+1)(1-rate) = 38 is an integer, so the rate is met exactly: 2/40. Its standard deviation in
    // one trial is that of Beta(2, 38), 0.034; that of the mean is 5.4e-4.
    CHECK(sum / kTrials == Approx(0.05).margin(4 * 5.4e-4));
}

TEST_CASE("Values at the threshold and values that are not numbers raise no alarm") {
    CHECK(!is_alarm(2.0, 2.0, Alarm::high));
    CHECK(is_alarm(2.1, 2.0, Alarm::high));
    CHECK(!is_alarm(2.0, 2.0, Alarm::low));
    CHECK(is_alarm(1.9, 2.0, Alarm::low));
    CHECK(!is_alarm(kNan, 2.0, Alarm::low));
    CHECK(!is_alarm(3.0, kNan, Alarm::high));
}

DetectionRequest request_for(std::vector<SizeGroup> groups, std::vector<double> levels) {
    DetectionRequest request;
    request.groups = std::move(groups);
    request.noise_levels = std::move(levels);
    return request;
}

TEST_CASE("Alarms are counted per size and noise level, failures apart") {
    // Two noise levels: the values, and the values shifted so that none alarms.
    std::vector<double> healthy;
    for (const double value : counted(99)) {
        healthy.push_back(value);
        healthy.push_back(value + 1000.0);
    }
    const std::vector<double> none(99, 0.0);
    const std::vector<double> size{0.0, 1e-3, 1e-3, 2e-3, 2e-3, 2e-3};
    const std::vector<double> values{1.0,  0.0, 95.0, 0.0, 95.5,  0.0,
                                     96.0, 0.0, kNan, 0.0, 200.0, 0.0};
    const FeatureDetection result =
        detect("f", Alarm::high, {none, healthy}, {size, values},
               request_for({{0.0, 0.0}, {1e-3, 1e-3}, {2e-3, 2e-3}}, {1.0, 2.0}));
    REQUIRE(result.levels.size() == 2);
    CHECK(result.levels[0].threshold == 95.0);
    CHECK(result.levels[1].threshold == 1095.0);
    CHECK(result.levels[0].threshold_sample == 99);
    const auto& cells = result.levels[0].cells;
    REQUIRE(cells.size() == 3);
    CHECK((cells[0].tested == 1 && cells[0].detected == 0));
    CHECK((cells[1].tested == 2 && cells[1].detected == 1 && cells[1].pd == 0.5));
    CHECK((cells[2].tested == 2 && cells[2].detected == 2 && cells[2].failed == 1));
    CHECK(cells[2].lower == Approx(2.0 / (2.0 + 3.841458820694124)));  // n/(n + z^2) at p = 1
    CHECK(result.levels[1].cells[2].detected == 0);
    REQUIRE(result.warnings.size() == 2);  // one per noise level
    CHECK_THAT(result.warnings[0], Catch::Contains("100 are needed"));
}

TEST_CASE("Continuous sizes fall into half-open groups, the last one closed") {
    const std::vector<double> none(19, 0.0);
    const std::vector<double> size{0.0, 0.5e-3, 1e-3, 1.5e-3, 2e-3, 2.1e-3};
    const std::vector<double> values(6, 50.0);
    const FeatureDetection result = detect("f", Alarm::high, {none, counted(19)}, {size, values},
                                           request_for({{0.0, 1e-3}, {1e-3, 2e-3}}, {1.0}));
    CHECK(result.levels[0].cells[0].tested == 2);
    CHECK(result.levels[0].cells[1].tested == 3);
    REQUIRE(result.warnings.size() == 2);
    CHECK_THAT(result.warnings[0], Catch::Contains("19 healthy records determine"));
    CHECK_THAT(result.warnings[1], Catch::Contains("1 of 6 gearboxes"));
}

TEST_CASE("A healthy sample too small for the rate gives no rates and a reason") {
    const std::vector<double> none(10, 0.0);
    const std::vector<double> size{1e-3, 1e-3};
    const std::vector<double> values{5.0, 50.0};
    const FeatureDetection result = detect("f", Alarm::high, {none, counted(10)}, {size, values},
                                           request_for({{1e-3, 1e-3}}, {1.0}));
    CHECK(std::isnan(result.levels[0].threshold));
    CHECK(std::isnan(result.levels[0].cells[0].pd));
    CHECK(result.levels[0].cells[0].tested == 2);
    REQUIRE(result.warnings.size() == 1);
    CHECK_THAT(result.warnings[0], Catch::Contains("at least 19 are needed"));
}

TEST_CASE("Failed healthy gearboxes leave the threshold sample and are reported") {
    std::vector<double> healthy = counted(20);
    healthy[4] = kNan;
    const std::vector<double> none(20, 0.0);
    const FeatureDetection result =
        detect("f", Alarm::low, {none, healthy}, {{}, {}}, request_for({{1e-3, 1e-3}}, {1.0}));
    CHECK(result.levels[0].threshold_sample == 19);
    CHECK(result.levels[0].threshold == 1.0);
    REQUIRE(result.warnings.size() == 2);
    CHECK_THAT(result.warnings[0], Catch::Contains("1 of 20 healthy"));
    CHECK_THAT(result.warnings[1], Catch::Contains("19 healthy records determine"));
}

TEST_CASE("Samples and groups of inconsistent shape are refused") {
    const std::vector<double> two(2, 0.0);
    const std::vector<double> three(3, 0.0);
    CHECK_THROWS_AS(detect("f", Alarm::high, {two, three}, {two, two}, request_for({}, {1.0})),
                    std::invalid_argument);
    CHECK_THROWS_AS(detect("f", Alarm::high, {two, two}, {two, two},
                           request_for({{2e-3, 3e-3}, {1e-3, 2e-3}}, {1.0})),
                    std::invalid_argument);
}

TEST_CASE("The reliable size needs all larger sizes above it and is never the healthy group") {
    const auto cell = [](double size, double lower) {
        DetectionCell c;
        c.size = {size, size};
        c.lower = lower;
        return c;
    };
    LevelDetection level;
    level.cells = {cell(0.0, 0.0), cell(1e-3, 0.95), cell(2e-3, 0.85), cell(3e-3, 0.92),
                   cell(4e-3, 0.99)};
    CHECK(reliable_size(level, 0.9)->high == 3e-3);
    level.cells.back().lower = 0.5;
    CHECK(!reliable_size(level, 0.9));
    level.cells = {cell(0.0, 0.99), cell(1e-3, 0.95)};
    CHECK(reliable_size(level, 0.9)->high == 1e-3);
    level.cells.back().lower = kNan;
    CHECK(!reliable_size(level, 0.9));
}

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

}  // namespace gearpod::analysis::test_detection
