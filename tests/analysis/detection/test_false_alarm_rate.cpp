#include "analysis/detection/threshold.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_false_alarm_rate {

TEST_CASE("A threshold's rate interval is that of the order statistic") {
    // R: qbeta(c(0.025, 0.975), 100, 1901), reference/reference_R.txt.
    const Interval interval = threshold_rate_interval(2000, 0.05, 0.95);
    CHECK(interval.lower == Approx(0.04086426772).epsilon(1e-9));
    CHECK(interval.upper == Approx(0.05993731616).epsilon(1e-9));
    CHECK(std::isnan(threshold_rate_interval(18, 0.05, 0.95).lower));
    // With all 58 below: Wilks' first tolerance bound, 0.95 content at 0.95 confidence, needs 59.
    CHECK(std::pow(1.0 - threshold_rate_interval(59, 0.0167, 0.9).upper, 59) ==
          Approx(0.05).epsilon(1e-9));
}

TEST_CASE("The sample size for a rate keeps the upper bound below twice the rate") {
    const long sample = sample_for_rate(0.05, 0.95);
    CHECK(sample == 100);
    for (const double rate : {0.05, 0.01, 0.003}) {
        const long need = sample_for_rate(rate, 0.95);
        CHECK(threshold_rate_interval(need - 1, rate, 0.95).upper > 2.0 * rate);
        for (long n = need; n < 2 * need; n += 7) {
            CHECK(threshold_rate_interval(n, rate, 0.95).upper <= 2.0 * rate);
        }
    }
}

// Studies with uniform features: the rate beyond a threshold t is exactly 1 - t.
struct Coverage {
    double threshold = 0.0, healthy = 0.0, expected = 0.0;
};

Coverage coverage(int studies, int sample, int tested) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> draw;
    Coverage hits;
    for (int s = 0; s < studies; ++s) {
        std::vector<double> values(sample);
        std::generate(values.begin(), values.end(), [&] { return draw(engine); });
        const Threshold threshold = alarm_threshold(values, Alarm::high, 0.05);
        long alarms = 0;
        for (int i = 0; i < tested; ++i) {
            alarms += draw(engine) > threshold.value ? 1 : 0;
        }
        const double rate = 1.0 - threshold.value;
        const auto holds = [](const Interval& bounds, double truth) {
            return bounds.lower <= truth && truth <= bounds.upper ? 1.0 : 0.0;
        };
        hits.threshold += holds(threshold_rate_interval(sample, 0.05, 0.95), rate) / studies;
        hits.healthy +=
            holds(healthy_rate(sample, 0.05, alarms, tested, 0.95).bounds, rate) / studies;
        // (n + 1) 0.05 = 10 is an integer: the expected rate is 0.05.
        hits.expected +=
            holds(expected_rate_interval(sample, alarms, tested, 0.95), 0.05) / studies;
    }
    return hits;
}

TEST_CASE("Intervals of the false-alarm rate cover the truth over 4,000 studies") {
    // The standard deviation of a coverage of 0.95 in 4,000 studies is 0.0034.
    const Coverage covered = coverage(4000, 199, 300);
    CHECK(covered.threshold == Approx(0.95).margin(0.0138));
    CHECK(covered.healthy == Approx(0.95).margin(0.0138));
    // The count is discrete, so the interval is conservative.
    CHECK(covered.expected > 0.95 - 0.0138);
    CHECK(covered.expected < 0.98);
}

TEST_CASE("Healthy rates follow the count and the threshold's own law") {
    const HealthyRate none = healthy_rate(1999, 0.05, 0, 0, 0.95);
    CHECK(none.rate == Approx(0.05));
    CHECK(healthy_rate(1999, 0.05, 70, 500, 0.95).rate == Approx(170.0 / 2500.0));
    CHECK(std::isnan(healthy_rate(10, 0.05, 1, 5, 0.95).rate));
    CHECK(std::isnan(expected_rate_interval(100, 0, 0, 0.95).lower));
    CHECK(expected_rate_interval(100, 0, 50, 0.95).lower == 0.0);
    CHECK(expected_rate_interval(100, 50, 50, 0.95).upper == 1.0);
    // A threshold known exactly leaves only binomial scatter: Clopper-Pearson of 81 of 263.
    const Interval sharp = expected_rate_interval(100'000'000, 81, 263, 0.95);
    CHECK(sharp.lower == Approx(0.2527367456).epsilon(1e-4));
    CHECK(sharp.upper == Approx(0.3676219226).epsilon(1e-4));
}

}  // namespace gearpod::analysis::test_false_alarm_rate
