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

}  // namespace gearpod::analysis::test_false_alarms
