// Checks false alarms per 1000 machine hours: thresholds, counts and the coverage of their
// intervals.
#include "analysis/detection/threshold.hpp"
#include "analysis/monitoring/baseline_deviations.hpp"
#include "analysis/monitoring/false_alarms.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_false_alarms {

using test::normal_values;
using Engine = std::mt19937_64;

// Hourly records of gearboxes whose baseline comes from the first `baseline` records (0: known
// baseline).
std::vector<HealthyLife> draw_lives(int gearboxes, std::size_t baseline, int records,
                                    Engine& engine) {
    std::normal_distribution<double> normal;
    std::vector<HealthyLife> lives;
    for (int g = 0; g < gearboxes; ++g) {
        std::vector<double> values(baseline + static_cast<std::size_t>(records));
        std::ranges::generate(values, [&] { return normal(engine); });
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
        std::vector<double> values =
            test::mapped(lives, [&](const HealthyLife& life) { return life.values[0]; });
        for (const double rate : {0.05, 0.1, 0.3}) {
            INFO(gearboxes << " " << rate);
            const Threshold single = SortedSample(values, Alarm::high).threshold(rate);
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

// A record a day, or a given number of records on each day.
HealthyRecords timed(const std::vector<double>& values, int a_day = 1) {
    HealthyRecords records;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int n = static_cast<int>(i);
        records.push_back({n / a_day + 0.01 * (n % a_day), values[i]});
    }
    return records;
}

// Sustained alarms with the threshold of 300 healthy records at this rate.
std::vector<SustainedAlarm> sustained(const char* detector, const std::vector<double>& values,
                                      double rate = 0.01) {
    const HealthyRecords healthy = timed(normal_values(300, 4));
    const auto parsed = *parse_detector(detector);
    return sustained_alarms(
        record_alarms(parsed, values, record_threshold(parsed, {&healthy, 1}, rate)), {10, 0.8});
}

TEST_CASE("A single bad record sustains no alarm of any detector, a lasting fault sustains one") {
    for (const char* detector : {"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 100"}) {
        INFO(detector);
        auto values = normal_values(200, 1);
        values[60] = 1e6;
        CHECK(sustained(detector, values).empty());
        // One record is bad in the other direction.
        for (std::size_t i = 100; i < values.size(); ++i) {
            values[i] += 20.0;
        }
        values[105] = -3.0;
        const auto found = sustained(detector, values);
        REQUIRE(!found.empty());
        CHECK(found.front().first >= 100);
        CHECK(found.front().first <= 103);
    }
    // A small lasting shift shows in an average, and goes on to show, but not in one record.
    auto values = normal_values(400, 2);
    for (std::size_t i = 200; i < values.size(); ++i) {
        values[i] += 1.5;
    }
    CHECK(sustained("single", values).empty());
    const auto found = sustained("ewma 0.1", values);
    REQUIRE(found.size() >= 10);
    CHECK(found.front().first >= 200);
    CHECK(found.front().first <= 220);
    // A fall is found by two sides only, as early as a rise of as much.
    for (double& value : values) {
        value = -value;
    }
    CHECK(sustained("ewma 0.1", values).empty());
    const auto falls = sustained("ewma 0.1 two-sided", values);
    REQUIRE(!falls.empty());
    CHECK(falls.front().first >= 200);
    CHECK(falls.front().first <= 240);
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

// Healthy records of a machine whose level differs from day to day.
std::vector<double> drifting(const char* kind, int days, int records, Engine& engine) {
    std::normal_distribution<double> normal;
    const std::string drift = kind;
    std::vector<double> values;
    double level = 0.0;
    for (int day = 0; day < days; ++day) {
        const double step = normal(engine);
        level = drift == "day" ? step : drift == "wandering" ? 0.9 * level + 0.44 * step : level;
        for (int i = 0; i < records; ++i) {
            values.push_back(level + normal(engine));
        }
    }
    return values;
}

TEST_CASE("Held-out healthy records alarm at the stated rate, with and without a drift") {
    // Expected rate of a threshold at the largest of n values: 1 / (n + 1).
    CHECK(smallest_rate(262) == Approx(1.0 / 263.0));
    Engine engine(7);
    for (const char* kind : {"none", "day", "wandering"}) {
        for (const char* detector :
             {"single", "2 of 3", "ewma 0.2", "ewma 0.05", "cusum 0.5", "trend 100"}) {
            INFO(kind << ' ' << detector);
            long alarms = 0, records = 0, unaware = 0;
            for (int machine = 0; machine < 400; ++machine) {
                const auto life = drifting(kind, 20, 12, engine);
                const HealthyRecords of_life = timed(life, 12);
                const auto held =
                    held_out_alarms(*parse_detector(detector), {&of_life, 1}, 0.02, 0.95);
                CHECK(held.rate == 0.02);
                CHECK(held.records == 120);
                alarms += held.alarms;
                records += held.records;
                // The 98th of the first 100 is the threshold without an allowance for drift.
                std::vector<double> first(life.begin(), life.begin() + 120);
                std::ranges::sort(first);
                unaware += std::count_if(life.begin() + 120, life.end(),
                                         [&](double value) { return value > first[117]; });
            }
            const double rate = static_cast<double>(alarms) / static_cast<double>(records);
            CHECK(rate > 0.007);
            CHECK(rate < 0.045);
            if (std::string(kind) == "wandering") {
                CHECK(static_cast<double>(unaware) / static_cast<double>(records) > 0.04);
            }
        }
    }
    auto rising = normal_values(100, 1);
    for (std::size_t i = 0; i < 100; ++i) {
        rising[i] += 0.1 * static_cast<double>(i);
    }
    const HealthyRecords trend = timed(rising);
    const auto held = held_out_alarms(*parse_detector("single"), {&trend, 1}, 0.02, 0.95);
    CHECK(held.alarms < 5);  // a trend of ten standard deviations
}

TEST_CASE("Run lengths without a fault are those of the rate, and longer where alarms cluster") {
    const HealthyRecords healthy = timed(normal_values(2000, 9));
    const auto length = [&](const char* text) {
        const auto detector = *parse_detector(text);
        return run_length(detector, {&healthy, 1}, record_threshold(detector, {&healthy, 1}, 0.02),
                          1000);
    };
    // Median of a geometric distribution: ln 2 / 0.02 = 34.7, and 20 % standard error of 101 runs.
    CHECK(length("single") > 20.0);
    CHECK(length("single") < 55.0);
    CHECK(length("ewma 0.1") > 1.2 * length("single"));
}

TEST_CASE("No held-out rate is given without a threshold") {
    // Nine of ten records need more than half of ten.
    const HealthyRecords records = timed(normal_values(10, 5));
    const auto none = held_out_alarms(*parse_detector("9 of 10"), {&records, 1}, 0.1, 0.95);
    CHECK(std::isnan(none.rate));
    CHECK(std::isnan(none.bounds.upper));
}

TEST_CASE("The level of another day allows for the scatter of four days") {
    // Three or four sessions are parts: the threshold is about t_3 s (1 + 1/4)^(1/2) above the
    // mean.
    std::vector<double> values;
    for (const double level : {0.0, 0.1, 0.3, 2.8}) {
        for (int i = 0; i < 50; ++i) {
            values.push_back(level + 1e-6 * i);
        }
    }
    const HealthyRecords records = timed(values, 50);
    const auto threshold = record_threshold(*parse_detector("single"), {&records, 1}, 0.01);
    const double drift = 1.339 * std::sqrt(1.25);  // standard deviation of the four levels
    CHECK(threshold.drift == Approx(drift).epsilon(1e-3));
    CHECK(threshold.value == Approx(0.8 + 4.541 * drift).epsilon(0.01));  // t_3 at 1 %
}

}  // namespace gearpod::analysis::test_false_alarms
