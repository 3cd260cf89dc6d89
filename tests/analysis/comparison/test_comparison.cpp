#include "analysis/comparison/comparison.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_comparison {

// Noise of the two sensors; the gearbox-to-gearbox part is 0.5.
constexpr double kNoiseA = 0.7, kNoiseB = 0.35;

// Feature of value size + gearbox + sensor. Alarms occur above the threshold, so detection rates,
// a90 and areas are normal integrals.
struct Synthetic {
    std::vector<double> healthy_a, healthy_b, size, a, b;

    Synthetic(std::mt19937_64& engine, bool same_gearboxes, int healthy = 600, int test = 600) {
        std::normal_distribution<double> draw;
        const auto add = [&](std::vector<double>& to_a, std::vector<double>& to_b, double fault) {
            const double gearbox_part = 0.5 * draw(engine);
            to_a.push_back(fault + gearbox_part + kNoiseA * draw(engine));
            to_b.push_back(fault + (same_gearboxes ? gearbox_part : 0.5 * draw(engine)) +
                           kNoiseB * draw(engine));
        };
        for (int i = 0; i < healthy; ++i) {
            add(healthy_a, healthy_b, 0.0);
        }
        for (int i = 0; i < test; ++i) {
            size.push_back(0.5 * (i % 7));
            add(a, b, size.back());
        }
    }
    Comparison compare(bool paired, int resamples) const {
        ComparisonRequest request;
        request.paired = paired;
        request.resamples = resamples;
        request.groups = test::tabulated(7, [](int g) { return SizeGroup{0.5 * g, 0.5 * g}; });
        return compare_detection({Alarm::high, healthy_a, size, a},
                                 {Alarm::high, healthy_b, size, b}, request, 2);
    }
};

double scatter(double noise) {
    return std::sqrt(0.25 + noise * noise);
}

double threshold(double noise) {
    return scatter(noise) * link_upper_quantile(Link::probit, 0.05);
}

double true_pd(double size, double noise) {
    return link_probability(Link::probit, (size - threshold(noise)) / scatter(noise));
}

double true_a90(double noise) {
    return threshold(noise) + scatter(noise) * link_quantile(Link::probit, 0.9);
}

// Area against size 0, averaged over the sizes above 0.
double true_auc(double noise) {
    double sum = 0.0;
    for (int g = 1; g < 7; ++g) {
        sum += link_probability(Link::probit, 0.5 * g / (std::sqrt(2.0) * scatter(noise)));
    }
    return sum / 6.0;
}

bool holds(const Interval& bounds, double truth) {
    return bounds.lower <= truth && truth <= bounds.upper;
}

TEST_CASE("The difference of two rates has Newcombe's published intervals") {
    // Stat. Med. 17 (1998), 873-890, table II, method 10: 56/70 - 48/80, 9/10 - 3/10, 10/10 - 0/10.
    const auto bounds = [](long found_b, long tested_b, long found_a, long tested_a) {
        return difference_interval(static_cast<double>(found_a) / static_cast<double>(tested_a),
                                   wilson_interval(found_a, tested_a, 0.95),
                                   static_cast<double>(found_b) / static_cast<double>(tested_b),
                                   wilson_interval(found_b, tested_b, 0.95), 0.0);
    };
    CHECK(bounds(56, 70, 48, 80).lower == Approx(0.0524).margin(5e-5));
    CHECK(bounds(56, 70, 48, 80).upper == Approx(0.3339).margin(5e-5));
    CHECK(bounds(9, 10, 3, 10).lower == Approx(0.1705).margin(5e-5));
    CHECK(bounds(9, 10, 3, 10).upper == Approx(0.8090).margin(5e-5));
    CHECK(bounds(10, 10, 0, 10).lower == Approx(0.6075).margin(5e-5));
    CHECK(bounds(10, 10, 0, 10).upper == Approx(1.0).margin(5e-5));
}

TEST_CASE("McNemar's test is the binomial law of the discordant pairs") {
    CHECK(mcnemar_p_value({100, 0, 6, 3}) == Approx(2.0 / 64.0));
    CHECK(mcnemar_p_value({0, 1, 3, 0}) == Approx(2.0 * 5.0 / 16.0));
    CHECK(mcnemar_p_value({4, 2, 2, 9}) == 1.0);
    CHECK(mcnemar_p_value({4, 0, 0, 9}) == 1.0);
    // Perfect agreement is a correlation of 1 without the continuity correction, and (20 20 - 20) /
    // 400 with it.
    CHECK(outcome_correlation({20, 0, 0, 20}) == Approx(0.95));
    CHECK(outcome_correlation({0, 20, 20, 0}) == Approx(-1.0));
    CHECK(outcome_correlation({40, 0, 0, 0}) == 0.0);
    CHECK(pooled_p_value(50, 100, 50, 100) == Approx(1.0));
    // (0.6 - 0.4) / sqrt(0.5 0.5 2 / 100) = 2.828: 0.00468.
    CHECK(pooled_p_value(40, 100, 60, 100) == Approx(0.00468).margin(1e-5));
}

TEST_CASE("A sample compared with itself has zero differences") {
    std::mt19937_64 engine(5);
    Synthetic made(engine, true);
    made.healthy_b = made.healthy_a;
    made.b = made.a;
    const Comparison result = made.compare(true, 100);
    REQUIRE(result.rates.size() == 7);
    for (const RateDifference& rate : result.rates) {
        CHECK(rate.a == rate.b);
        CHECK(rate.p_value == 1.0);
        CHECK(rate.pairs.only_a + rate.pairs.only_b == 0);
        CHECK(holds(rate.bounds, 0.0));
    }
    CHECK(result.a90.refusal == "");
    CHECK(result.a90.difference() == 0.0);
    CHECK(result.a90.bounds.lower == 0.0);
    CHECK(result.a90.bounds.upper == 0.0);
    CHECK(result.auc.difference() == 0.0);
    CHECK(result.auc.p_value == 1.0);
    CHECK(holds(result.auc.bounds, 0.0));
}

TEST_CASE(
    "Pairing removes the part that gearboxes share, and missing values do not count as misses") {
    std::mt19937_64 engine(6);
    Synthetic made(engine, true, 600, 1400);
    const Comparison pairs = made.compare(true, 200), apart = made.compare(false, 200);
    const auto width = [](const Interval& bounds) { return bounds.upper - bounds.lower; };
    CHECK(width(pairs.auc.bounds) < 0.9 * width(apart.auc.bounds));
    CHECK(width(pairs.a90.bounds) < width(apart.a90.bounds));
    CHECK(pairs.a90.difference() == apart.a90.difference());
    for (std::size_t i = 0; i < made.b.size(); i += 2) {
        made.b[i] = std::nan("");
    }
    const Comparison half = made.compare(true, 50);
    CHECK(half.rates[3].tested_a == 100);
    CHECK(half.rates[3].b == Approx(pairs.rates[3].b).margin(0.15));
    std::fill(made.b.begin(), made.b.end(), std::nan(""));
    const Comparison none = made.compare(true, 50);
    CHECK(std::isnan(none.rates[3].b));
    CHECK(none.auc.refusal != "");
    CHECK_THAT(none.a90.refusal, Catch::StartsWith("B: "));
}

// Checks that the nominal 95 % interval holds the true difference in so many of `studies`.
void check_coverage(bool same_gearboxes, int studies, int resamples) {
    std::mt19937_64 engine(7);
    int pd = 0, rates = 0, a90 = 0, auc = 0;
    for (int s = 0; s < studies; ++s) {
        const Comparison result =
            Synthetic(engine, same_gearboxes).compare(same_gearboxes, resamples);
        for (std::size_t g = 1; g < 5; ++g) {
            const double size = 0.5 * static_cast<double>(g);
            pd += holds(result.rates[g].bounds, true_pd(size, kNoiseB) - true_pd(size, kNoiseA));
            ++rates;
        }
        a90 += holds(result.a90.bounds, true_a90(kNoiseB) - true_a90(kNoiseA));
        auc += holds(result.auc.bounds, true_auc(kNoiseB) - true_auc(kNoiseA));
    }
    CAPTURE(same_gearboxes, pd, rates, a90, auc, studies);
    if (studies > 1000) {
        WARN("of " << studies << " studies the intervals hold Pd in " << 100.0 * pd / rates
                   << " %, a90 in " << 100.0 * a90 / studies << " %, AUC in "
                   << 100.0 * auc / studies << " %");
    }
    CHECK(pd > 0.94 * rates);
    CHECK(a90 > 0.91 * studies);
    CHECK(auc > 0.92 * studies);
    CHECK(auc < 0.985 * studies);
}

TEST_CASE("Intervals hold the true difference at their nominal rate") {
    check_coverage(true, 300, 100);
    check_coverage(false, 300, 100);
}

TEST_CASE("Intervals of differences over many studies", "[.rare-coverage]") {
    check_coverage(true, 2000, 400);
    check_coverage(false, 2000, 400);
}

}  // namespace gearpod::analysis::test_comparison
