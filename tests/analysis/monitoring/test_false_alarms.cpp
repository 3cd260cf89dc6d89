// Checks false alarms per 1000 machine hours: thresholds, counts and the coverage of their
// intervals.
#include "analysis/detection/threshold.hpp"
#include "analysis/monitoring/baseline_deviations.hpp"
#include "analysis/monitoring/false_alarms.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_false_alarms {

using Engine = std::mt19937_64;

// Hourly records of gearboxes whose baseline comes from the first `baseline` records (0: known
// baseline).
std::vector<HealthyLife> draw_lives(int gearboxes, std::size_t baseline, int records,
                                    Engine& engine) {
    std::normal_distribution<double> normal;
    std::vector<HealthyLife> lives;
    for (int g = 0; g < gearboxes; ++g) {
        std::vector<double> values(baseline + static_cast<std::size_t>(records));
        for (double& value : values) {
            value = normal(engine);
        }
        lives.push_back(
            {baseline_deviations(values, {}, baseline, Alarm::high), static_cast<double>(records)});
    }
    return lives;
}

TEST_CASE("A detector that gives no statistic for such short lives has no threshold") {
    Engine engine(3);
    const auto lives = draw_lives(40, 0, 4, engine);
    const auto set = [&](const char* text) {
        return monitor_threshold(*parse_detector(text), lives, 100.0);
    };
    CHECK(std::isfinite(set("4 of 6").value));
    CHECK(std::isnan(set("5 of 6").value));  // of four records
    CHECK(set("5 of 6").least_per_1000_h < 100.0);
}

TEST_CASE("Lives of one record have the thresholds of single recordings") {
    Engine engine(1);
    for (const int gearboxes : {40, 100, 399}) {
        const auto lives = draw_lives(gearboxes, 0, 1, engine);
        std::vector<double> values;
        for (const HealthyLife& life : lives) {
            values.push_back(life.values[0]);
        }
        for (const double rate : {0.05, 0.1, 0.3}) {
            INFO(gearboxes << " " << rate);
            const Threshold single = alarm_threshold(values, Alarm::high, rate);
            const auto monitor = monitor_threshold(*parse_detector("single"), lives, 1000.0 * rate);
            CHECK(monitor.value == single.value);
            CHECK(monitor.alarms == single.alarms);
        }
    }
}

TEST_CASE("A threshold is the smallest that keeps the stated false-alarm rate") {
    Engine engine(2);
    const auto lives = draw_lives(30, 20, 100, engine);  // 3000 h
    for (const char* text : {"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 30"}) {
        INFO(text);
        const Detector detector = *parse_detector(text);
        const auto threshold = monitor_threshold(detector, lives, 4.0);
        // 3000 records, 3001 * 0.004 = 12.004: the twelfth largest, with eleven beyond it.
        CHECK(threshold.alarms <= 11);
        CHECK(false_alarms(detector, lives, threshold.value, 0.95).alarms == threshold.alarms);
        const double less = std::nextafter(threshold.value, -1e9);
        CHECK(false_alarms(detector, lives, less, 0.95).alarms > 11);
    }
    const auto none = monitor_threshold(*parse_detector("single"), lives, 0.3);
    CHECK(std::isnan(none.value));
    CHECK(none.least_per_1000_h == Approx(1000.0 / 3001.0));
    CHECK(std::isnan(monitor_threshold(*parse_detector("single"), {}, 0.3).value));
}

TEST_CASE("Intervals of independent counts are Garwood's") {
    // Source: 95 % limits of a Poisson mean (E. L. Crow, R. S. Gardner / F. Garwood).
    struct Row {
        int count;
        double lower, upper;
    };
    for (const Row& row : {Row{0, 0.0, 3.689}, Row{1, 0.0253, 5.572}, Row{10, 4.795, 18.390}}) {
        std::vector<HealthyLife> lives(1000, HealthyLife{{0.0}, 1.0});
        for (int i = 0; i < row.count; ++i) {
            lives[static_cast<std::size_t>(i)].values[0] = 1.0;
        }
        const auto seen = false_alarms(*parse_detector("single"), lives, 0.5, 0.95);
        CHECK(seen.alarms == row.count);
        CHECK(seen.dispersion == Approx(1.0).margin(1e-9));
        CHECK(seen.bounds.lower == Approx(row.lower).margin(6e-4));
        CHECK(seen.bounds.upper == Approx(row.upper).margin(6e-4));
    }
}

struct Coverage {
    double rate = 0.0, expected = 0.0;
};

// Shares of campaigns in which two intervals hold: that of the threshold's own rate, known from
// many more lives, and the one that should contain the stated rate.
Coverage coverage(const char* text, std::size_t baseline, int campaigns) {
    constexpr double kStated = 5.0;
    const Detector detector = *parse_detector(text);
    Engine engine(23);
    const auto many = draw_lives(1000, baseline, 200, engine);
    Coverage held;
    for (int c = 0; c < campaigns; ++c) {
        const auto setting = draw_lives(40, baseline, 200, engine);
        const auto further = draw_lives(40, baseline, 200, engine);
        const auto threshold = monitor_threshold(detector, setting, kStated);
        const auto seen = false_alarms(detector, further, threshold.value, 0.95);
        const double truth = false_alarms(detector, many, threshold.value, 0.95).per_1000_h;
        const Interval expected = expected_per_1000_h(threshold, seen);
        held.rate += truth >= seen.bounds.lower && truth <= seen.bounds.upper ? 1.0 : 0.0;
        held.expected += kStated >= expected.lower && kStated <= expected.upper ? 1.0 : 0.0;
    }
    return {held.rate / campaigns, held.expected / campaigns};
}

TEST_CASE("Intervals of false alarms hold in nearly all of 100 campaigns") {
    // Three standard deviations of a coverage of 0.95 are 0.065.
    const Coverage held = coverage("single", 0, 100);
    CHECK(held.rate >= 0.885);
    CHECK(held.expected >= 0.885);
}

TEST_CASE("Intervals of false alarms hold in 95 of 100 campaigns", "[.rare-coverage]") {
    // Three standard deviations of a coverage of 0.95 in 1000 campaigns are 0.021.
    for (const char* text : {"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 30"}) {
        for (const std::size_t baseline : {0U, 20U}) {
            const Coverage held = coverage(text, baseline, 1000);
            INFO(text << " baseline " << baseline);
            CHECK(held.rate >= 0.929);
            CHECK(held.expected >= 0.929);
        }
    }
}

// Checks sustained alarms, alarms of held-out healthy records, and the drift of a level.

constexpr double kThreshold = 6.0;

std::vector<double> normal_values(std::size_t count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> values(count);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

std::vector<SustainedAlarm> sustained(const char* detector, const std::vector<double>& values) {
    return sustained_alarms(record_alarms(*parse_detector(detector), values, kThreshold),
                            {10, 0.8});
}

TEST_CASE("A single bad record sustains no alarm of any detector, in either state") {
    for (const char* detector : {"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 100"}) {
        INFO(detector);
        auto values = normal_values(200, 1);
        values[60] = 1e6;
        CHECK(sustained(detector, values).empty());
        // A lasting fault, with one record that is bad in the other direction.
        for (std::size_t i = 100; i < values.size(); ++i) {
            values[i] += 20.0;
        }
        values[105] = -3.0;
        const auto found = sustained(detector, values);
        REQUIRE(!found.empty());
        CHECK(found.front().first >= 100);
        CHECK(found.front().first <= 103);
    }
}

TEST_CASE("Eight of the next ten records sustain an alarm, seven do not") {
    std::vector<double> values(30, 0.0);
    values[5] = 9.0;
    for (std::size_t i = 8; i < 16; ++i) {
        values[i] = 9.0;  // eight of the ten records after record 5
    }
    auto found = sustained("single", values);
    REQUIRE(found.size() == 1);
    CHECK(found[0].first == 5);
    CHECK(found[0].confirmed == 15);
    values[15] = 0.0;
    CHECK(sustained("single", values).empty());
    // A record without a value does not count: the ten records then end one later.
    values[15] = 9.0;
    values[6] = std::nan("");
    values[15] = 0.0;
    values[16] = 9.0;
    found = sustained("single", values);
    REQUIRE(found.size() == 1);
    CHECK(found[0].confirmed == 16);
}

TEST_CASE("Held-out healthy records alarm at the smallest rate that the others can set") {
    // Expected rate of a threshold at the largest of n values: 1 / (n + 1).
    CHECK(smallest_rate(262) == Approx(1.0 / 263.0));
    long alarms = 0, records = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        const HealthyLife life{normal_values(100, seed), 100.0};
        const auto held = held_out_alarms(*parse_detector("single"), {&life, 1}, 0.001, 0.95);
        CHECK(held.rate == Approx(1.0 / 51.0));
        CHECK(held.records == 50);
        alarms += held.alarms;
        records += held.records;
    }
    const double rate = static_cast<double>(alarms) / static_cast<double>(records);
    CHECK(rate == Approx(1.0 / 51.0).epsilon(0.2));  // the standard error is 7 %

    HealthyLife drifting{normal_values(100, 1), 100.0};
    for (std::size_t i = 0; i < 100; ++i) {
        drifting.values[i] += 0.1 * static_cast<double>(i);
    }
    const auto held = held_out_alarms(*parse_detector("single"), {&drifting, 1}, 0.02, 0.95);
    CHECK(held.alarms > 15);
    CHECK(held.bounds.lower > 0.15);
}

TEST_CASE(
    "Held-out records without a value do not change the rate, and none is given without "
    "threshold") {
    HealthyLife life{normal_values(100, 5), 100.0}, gaps{{}, 200.0};
    for (const double value : life.values) {
        gaps.values.insert(gaps.values.end(), {value, std::nan("")});
    }
    const auto single = *parse_detector("single");
    const auto all = held_out_alarms(single, {&life, 1}, 0.1, 0.95),
               some = held_out_alarms(single, {&gaps, 1}, 0.1, 0.95);
    CHECK(some.records == all.records);
    CHECK(some.alarms == all.alarms);
    CHECK(some.rate == all.rate);
    life.values.resize(10);  // nine of ten records need more than the half of them
    const auto none = held_out_alarms(*parse_detector("9 of 10"), {&life, 1}, 0.1, 0.95);
    CHECK(std::isnan(none.rate));
    CHECK(std::isnan(none.bounds.upper));
}

TEST_CASE("A drift is found with its size, and white noise has none") {
    auto values = normal_values(200, 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = 10.0 + 0.1 * values[i];
    }
    CHECK(std::abs(drift_of(values).change) < 0.01);
    CHECK(drift_of(values).p_value > 0.01);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] += 2.0 * static_cast<double>(i) / 199.0;
    }
    CHECK(drift_of(values).change == Approx(2.0 / 11.0).epsilon(0.03));
    CHECK(drift_of(values).tau > 0.85);
    CHECK(drift_of(values).p_value < 1e-6);
    const std::vector<double> rising{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    CHECK(drift_of(rising).tau == Approx(1.0));
    // Score 45 of 10 values: (45 - 1) / sqrt(10 * 9 * 25 / 18) = 3.9355.
    CHECK(drift_of(rising).p_value == Approx(std::erfc(3.9354797 / std::sqrt(2.0))).epsilon(1e-6));
}

}  // namespace gearpod::analysis::test_false_alarms
