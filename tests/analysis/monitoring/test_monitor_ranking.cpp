// Checks the order of monitored detectors: what false alarms alone find does not count, and alarms
// at random never come first.
#include "analysis/monitoring/monitor_performance.hpp"
#include "tests/test.hpp"

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
    std::vector<HealthyLife> all;
    for (int i = 0; i < lives; ++i) {
        all.push_back({alarms_at_random(engine, probability), kRecords});
    }
    return all;
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

}  // namespace gearpod::analysis::test_monitor_ranking
