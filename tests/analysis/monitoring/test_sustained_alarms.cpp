// Checks sustained alarms, alarms of held-out healthy records, and the drift of a level.
#include "analysis/monitoring/sustained_alarms.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_sustained_alarms {

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

}  // namespace gearpod::analysis::test_sustained_alarms
