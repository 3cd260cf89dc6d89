// Checks the summary of a monitor's performance on lives whose detections are known.
#include "analysis/monitoring/monitor_performance.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_monitor_performance {

// Values are 0 except one `peak` in each healthy life, so that thresholds equal it.
std::vector<HealthyLife> healthy_lives(int lives, int records, double peak) {
    std::vector<HealthyLife> all;
    for (int i = 0; i < lives; ++i) {
        HealthyLife life{std::vector<double>(static_cast<std::size_t>(records), 0.0),
                         static_cast<double>(records)};
        life.values[3] = peak;
        all.push_back(std::move(life));
    }
    return all;
}

// Size grows by one per record from record 2 on; the life ends at record 10. Records alarm from the
// size `seen` on.
CrackedLife cracked_life(double seen) {
    CrackedLife life;
    for (int i = 0; i < 10; ++i) {
        const double size = std::max(0, i - 1);
        life.hours.push_back(i);
        life.sizes.push_back(size);
        life.values.push_back(size >= seen ? 5.0 : 0.0);
    }
    life.first = 2;
    life.end_hours = 10.0;
    return life;
}

TEST_CASE("Detection, depth and warning time are those of the first alarm after crack initiation") {
    const auto setting = healthy_lives(10, 100, 1.0), further = healthy_lives(5, 100, 2.0);
    std::vector<CrackedLife> cracked{cracked_life(1), cracked_life(3), cracked_life(5),
                                     cracked_life(99)};
    cracked[0].values[0] = 9.0;  // a false alarm, before the crack
    cracked.push_back(cracked_life(2));
    cracked.back().end_hours.reset();  // still running
    const auto got =
        monitor_performance(*parse_detector("single"), setting, further, cracked, 5.0, 0.95);
    CHECK(got.threshold.value == 1.0);
    CHECK(got.false_alarms.alarms == 5);
    CHECK(got.false_alarms.per_1000_h == Approx(10.0));
    CHECK(got.ended == 4);
    CHECK(got.found == 3);
    CHECK(got.share == 0.75);
    CHECK(got.share_by_chance == 1.0);  // every healthy life alarms at record 3
    CHECK(got.size_50.value == 3.0);
    CHECK(std::isinf(got.size_90.value));
    CHECK(std::isnan(got.size_90.bound));  // of four lives
    CHECK(got.warning_50 == 6.0);          // alarms at 2, 4 and 6 h
    CHECK(got.warning_90 == 4.0);
}

TEST_CASE("The share by chance is that of alarms among independent records") {
    // The records are independent and normal: at least one of n alarms with 1 - (1 - p)^n.
    std::mt19937_64 engine(12);
    std::normal_distribution<double> normal;
    const auto draw = [&](int lives, std::size_t records) {
        std::vector<HealthyLife> all;
        for (int i = 0; i < lives; ++i) {
            all.push_back({std::vector<double>(records), static_cast<double>(records)});
            std::ranges::generate(all.back().values, [&] { return normal(engine); });
        }
        return all;
    };
    const auto setting = draw(400, 100), further = draw(1600, 100);
    std::vector<CrackedLife> visible, blind;
    for (const HealthyLife& life : draw(1600, 50)) {
        blind.push_back({life.values, std::vector<double>(50), std::vector<double>(50), 20, 50.0});
        visible.push_back(blind.back());
        for (double& value : visible.back().values) {
            value += 2.0;
        }
    }
    const auto got =
        monitor_performance(*parse_detector("single"), setting, further, visible, 20.0, 0.95);
    const double expected = 1.0 - std::pow(1.0 - 0.02, 30.0);
    // The share among 1600 lives has a standard deviation of 0.012.
    CHECK(got.share_by_chance == Approx(expected).margin(0.06));
    CHECK(got.share > got.share_by_chance);
    // Alarms on a crack without effect are all false.
    const auto none =
        monitor_performance(*parse_detector("single"), setting, further, blind, 20.0, 0.95);
    CHECK(none.found == 0);
    CHECK(none.share_by_chance == 0.0);
    CHECK(static_cast<double>(none.early_alarms) == Approx(1600 * 30 * 0.02).margin(0.06 * 1600));
    CHECK(none.early_hours == 1600 * 50.0);  // from record 20, at 0 h, to the end
}

TEST_CASE("A quantile's bound has its nominal coverage") {
    // The largest of 28 values lies above the 90 % quantile with 1 - 0.9^28 = 94.8 %, the largest
    // of 29 with 95.3 % (W. J. Conover's 29 of 95/90).
    std::vector<double> values(28, 1.0);
    CHECK(std::isnan(quantile_bound(values, 0.9, 0.95)));
    values.push_back(2.0);
    CHECK(quantile_bound(values, 0.9, 0.95) == 2.0);
    std::mt19937_64 engine(9);
    std::uniform_real_distribution<double> uniform;
    int above = 0;
    constexpr int kSamples = 4000;
    for (int s = 0; s < kSamples; ++s) {
        std::vector<double> sample(60);
        for (double& value : sample) {
            value = uniform(engine);
        }
        above += quantile_bound(sample, 0.9, 0.95) >= 0.9 ? 1 : 0;
    }
    // The rank is an integer, so the bound is slightly conservative.
    const double share = static_cast<double>(above) / kSamples;
    CHECK(share >= 0.94);
    CHECK(share < 0.99);
}

}  // namespace gearpod::analysis::test_monitor_performance
