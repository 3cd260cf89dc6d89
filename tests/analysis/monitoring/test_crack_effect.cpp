// Checks the size from which a crack has an effect on monitored values.
#include "analysis/monitoring/monitor_performance.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_crack_effect {

// Independent standard normal values; those of cracked lives move by `slope` for each unit of size
// beyond 1, and the size grows from 0 to 4.
struct Lives {
    std::vector<HealthyLife> healthy;
    std::vector<CrackedLife> cracked;
};

Lives lives(double slope, int count) {
    constexpr std::size_t kRecords = 100, kBaseline = 20;
    std::mt19937_64 engine(4);
    std::normal_distribution<double> normal;
    Lives all;
    for (int i = 0; i < count; ++i) {
        all.healthy.push_back({std::vector<double>(kRecords), 100.0});
        CrackedLife life;
        life.first = kBaseline;
        life.end_hours = 100.0;
        for (std::size_t r = 0; r < kRecords; ++r) {
            all.healthy.back().values[r] = normal(engine);
            const double size = r < kBaseline ? 0.0 : 0.05 * static_cast<double>(r - kBaseline);
            life.hours.push_back(static_cast<double>(r));
            life.sizes.push_back(size);
            life.values.push_back(normal(engine) + slope * std::max(0.0, size - 1.0));
        }
        all.cracked.push_back(life);
    }
    return all;
}

TEST_CASE("A crack's effect begins where the median has moved by half a standard deviation") {
    // The mean moves by 0.5 at 1.25 for a slope of 2, in groups 0.2 wide.
    const Lives rising = lives(2.0, 40), falling = lives(-2.0, 40), none = lives(0.0, 40);
    CHECK(effect_size(rising.healthy, rising.cracked, false) == Approx(1.25).margin(0.2));
    CHECK(std::isinf(effect_size(falling.healthy, falling.cracked, false)));
    CHECK(effect_size(falling.healthy, falling.cracked, true) == Approx(1.25).margin(0.2));
    CHECK(std::isinf(effect_size(none.healthy, none.cracked, true)));
    CHECK(std::isnan(effect_size({}, rising.cracked, false)));
    CHECK(std::isinf(effect_size(rising.healthy, {}, false)));
    // Values that never vary show no effect, although they exceed a scatter of 0.
    Lives constant = lives(0.0, 40);
    for (HealthyLife& life : constant.healthy) {
        life.values.assign(life.values.size(), 3.0);
    }
    for (CrackedLife& life : constant.cracked) {
        life.values.assign(life.values.size(), 3.0);
    }
    CHECK(std::isinf(effect_size(constant.healthy, constant.cracked, true)));
    // Large cracks act at every size.
    const Lives steep = lives(1e3, 4);
    CHECK(effect_size(steep.healthy, steep.cracked, false) <= 1.2);
}

TEST_CASE("Alarms before the crack's effect are false, and give no warning") {
    Lives all = lives(20.0, 20);
    // A false alarm at a size of 0.25, long before the effect, in every life.
    for (CrackedLife& life : all.cracked) {
        life.values[25] = 9.0;
    }
    const auto got = monitor_performance(*parse_detector("single"), all.healthy, all.healthy,
                                         all.cracked, 1.0, 0.95);
    CHECK(got.effect_size == Approx(1.05).margin(0.2));
    CHECK(got.early_alarms >= 20);
    CHECK(got.early_hours == Approx(20 * (got.effect_size / 0.05)).margin(20.0));
    CHECK(got.found == 20);
    // The effect begins at 40 h and the life ends at 100 h; a record at 25 h would give 75 h.
    CHECK(got.warning_50 < 62.0);
    CHECK(got.warning_90 > 50.0);
    CHECK(got.size_50.value >= got.effect_size);
    for (const double hours : got.alarm_hours) {
        CHECK(hours > 35.0);
    }
}

}  // namespace gearpod::analysis::test_crack_effect
