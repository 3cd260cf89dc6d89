// Checks the performance of monitored detectors, the size from which a crack has an effect, and the
// order of detectors: what false alarms alone find does not count.
#include "analysis/monitoring/monitor_performance.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_monitor_ranking {

constexpr double kStated = 2.0;  // false alarms in 1000 h
constexpr int kRecords = 100;    // of a life, one an hour

// Values that are 0 except at alarms, where they are 1.
std::vector<double> alarms_at_random(std::mt19937& engine, double probability) {
    std::bernoulli_distribution alarm(probability);
    std::vector<double> values(kRecords);
    std::ranges::generate(values, [&] { return alarm(engine) ? 1.0 : 0.0; });
    return values;
}

std::vector<HealthyLife> healthy_lives(std::mt19937& engine, int lives, double probability) {
    return test::tabulated(lives, [&](int) {
        return HealthyLife{alarms_at_random(engine, probability), kRecords};
    });
}

// Cracks that begin at record 20 and end at record 99; the detector alarms from `seen` on with the
// probability `found`, and at random before.
std::vector<CrackedLife> cracked_lives(std::mt19937& engine, int lives, double found, int seen,
                                       double probability) {
    std::vector<CrackedLife> all;
    std::bernoulli_distribution sees(found);
    for (int i = 0; i < lives; ++i) {
        CrackedLife life;
        life.values = alarms_at_random(engine, probability);
        for (int r = 0; r < kRecords; ++r) {
            life.hours.push_back(r);
            life.sizes.push_back(std::max(0, r - 19));
        }
        life.first = 20;
        life.end_hours = 99.0;
        if (sees(engine)) {
            std::fill(life.values.begin() + seen, life.values.end(), 1.0);
        }
        all.push_back(std::move(life));
    }
    return all;
}

MonitorPerformance performance(std::mt19937& engine, double found, int seen, double per_1000_h) {
    const double probability = 1e-3 * per_1000_h;
    const auto setting = healthy_lives(engine, 200, 0.5 * probability),
               counting = healthy_lives(engine, 60, probability);
    auto out =
        monitor_performance(*parse_detector("single"), setting, counting,
                            cracked_lives(engine, 40, found, seen, probability), kStated, 0.95);
    return out;
}

// A performance with these numbers.
MonitorPerformance made(long found, long ended, double chance, double per_1000_h, double upper) {
    MonitorPerformance out;
    out.threshold.value = 1.0;
    out.ended = ended;
    out.found = found;
    out.share = static_cast<double>(found) / static_cast<double>(ended);
    out.share_by_chance = chance;
    out.share_at_stated_rate = 0.05;
    out.false_alarms.per_1000_h = per_1000_h;
    out.false_alarms.bounds = {0.5 * per_1000_h, upper};
    out.size_50.value = out.size_90.value = 1.0;
    return out;
}

TEST_CASE("A detector that finds everything by chance ranks after one without false alarms") {
    // Sixteen of sixteen each; false alarms alone find half of them with the first.
    const auto trend = made(16, 16, 0.5, 2.0, 3.0), two_of_three = made(16, 16, 0.0, 0.0, 0.4);
    CHECK(ranks_before(two_of_three, trend));
    CHECK_FALSE(ranks_before(trend, two_of_three));
    CHECK(net_share(trend) == 0.5);
    // Almost everything without chance is better than everything with it.
    CHECK(ranks_before(made(15, 16, 0.0, 0.0, 0.4), trend));
}

TEST_CASE("A detector that finds more with no more false alarms ranks first") {
    std::mt19937 engine(3);
    std::uniform_int_distribution<long> found(0, 30);
    std::uniform_real_distribution<double> chance(0.0, 1.0);
    for (int trial = 0; trial < 2000; ++trial) {
        const long fewer = found(engine), more = fewer + 1 + found(engine) % 5;
        const double high = chance(engine), low = high * chance(engine);
        const auto better = made(more, 40, low, 10 * low, 20 * low),
                   worse = made(fewer, 40, high, 10 * high, 20 * high);
        CHECK(ranks_before(better, worse));
        CHECK_FALSE(ranks_before(worse, better));
    }
}

TEST_CASE("Detectors without evidence have no rank, with the reason") {
    CHECK(why_unranked(made(16, 16, 0.0, 1.0, 2.0), kStated).empty());
    CHECK(why_unranked(made(16, 16, 0.5, 1.0, 2.0), kStated).empty());
    CHECK(why_unranked(made(16, 16, 0.0, 6.0, 9.0), kStated) == "more false alarms than stated");
    CHECK(why_unranked(made(3, 16, 0.2, 1.0, 2.0), kStated) ==
          "no significantly larger share found than by chance");
    // No healthy life was counted: the stated rate finds one in twenty.
    auto uncounted = made(1, 16, std::nan(""), std::nan(""), std::nan(""));
    uncounted.false_alarms.bounds = {std::nan(""), std::nan("")};
    CHECK(why_unranked(uncounted, kStated) == "no significantly larger share found than by chance");
    auto none = made(0, 16, 0.0, 1.0, 2.0);
    CHECK(why_unranked(none, kStated) == "no significantly larger share found than by chance");
    none.ended = 0;
    CHECK(why_unranked(none, kStated) == "no tooth fails");
    none.threshold.value = std::nan("");
    CHECK(why_unranked(none, kStated) == "no threshold");
}

TEST_CASE("Alarms at random never come first, and never where cracks are found") {
    std::mt19937 engine(11);
    int ranked = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const auto informative = performance(engine, 0.6, 60, 1.0);
        REQUIRE(why_unranked(informative, kStated).empty());
        const auto random = performance(engine, 0.0, 60, 0.5 + 0.02 * trial);
        const bool has_rank = why_unranked(random, kStated).empty();
        ranked += has_rank ? 1 : 0;
        CHECK((!has_rank || ranks_before(informative, random)));
    }
    CHECK(ranked <= 1);  // one in a thousand at most, each
}

// Independent standard normal values; those of cracked lives move by `slope` for each unit of size
// beyond 1, and the size grows from 0 to 4.
struct Lives {
    std::vector<HealthyLife> healthy;
    std::vector<CrackedLife> cracked;
};

Lives lives(double slope, int count) {
    constexpr std::size_t kBaseline = 20;
    std::mt19937_64 engine(4);
    std::normal_distribution<double> normal;
    Lives all;
    for (int i = 0; i < count; ++i) {
        all.healthy.push_back({std::vector<double>(kRecords), kRecords});
        CrackedLife life;
        life.first = kBaseline;
        life.end_hours = kRecords;
        for (std::size_t r = 0; r < std::size_t{kRecords}; ++r) {
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
        std::vector<double> sample = test::tabulated(60, [&](auto) { return uniform(engine); });
        above += quantile_bound(sample, 0.9, 0.95) >= 0.9 ? 1 : 0;
    }
    // The rank is an integer, so the bound is slightly conservative.
    const double share = static_cast<double>(above) / kSamples;
    CHECK(share >= 0.94);
    CHECK(share < 0.99);
}

}  // namespace gearpod::analysis::test_monitor_ranking
