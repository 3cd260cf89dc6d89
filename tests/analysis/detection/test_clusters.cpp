// Checks false-alarm rates of thresholds, set from one or several recordings of each gearbox.
#include "analysis/detection/detection.hpp"
#include "analysis/detection/threshold.hpp"
#include "tests/analysis/detection/gearbox_laws.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_clusters {

// Normal features of variance 1, of which a given share is between gearboxes. The rate beyond any
// threshold is therefore known.
struct Coverage {
    double clustered = 0.0, independent = 0.0;
};

Coverage coverage(double share, int gearboxes, int recordings, double rate, int studies) {
    std::mt19937_64 engine(6);
    std::normal_distribution<double> draw;
    const boost::math::normal normal;
    Coverage covered;
    for (int s = 0; s < studies; ++s) {
        std::vector<double> values;
        std::vector<std::size_t> gearbox;
        for (int g = 0; g < gearboxes; ++g) {
            const double own = std::sqrt(share) * draw(engine);
            for (int r = 0; r < recordings; ++r) {
                values.push_back(own + std::sqrt(1.0 - share) * draw(engine));
                gearbox.push_back(static_cast<std::size_t>(g));
            }
        }
        const double threshold = SortedSample(values, Alarm::high).threshold(rate).value;
        const double truth = cdf(complement(normal, threshold));
        const auto holds = [&](const Interval& bounds) {
            return bounds.lower <= truth && truth <= bounds.upper ? 1.0 / studies : 0.0;
        };
        covered.clustered +=
            holds(clustered_rate_interval(values, gearbox, Alarm::high, threshold, rate, 0.95));
        covered.independent +=
            holds(threshold_rate_interval(static_cast<long>(values.size()), rate, 0.95));
    }
    return covered;
}

TEST_CASE("Rates of thresholds from many recordings of few gearboxes are covered") {
    // The standard deviation of a coverage of 0.95 in 400 studies is 0.011.
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
        for (const auto& [gearboxes, recordings] :
             {std::pair{5, 60}, {20, 30}, {100, 10}, {200, 10}}) {
            const Coverage covered = coverage(share, gearboxes, recordings, 0.05, 400);
            INFO(share << " " << gearboxes);
            CHECK(covered.clustered > 0.95 - 0.03);
        }
    }
    // Intervals that treat recordings as independent fail at a share of 0.7. Clustered intervals
    // are hardly conservative for many similar gearboxes.
    CHECK(coverage(0.7, 20, 50, 0.05, 400).independent < 0.5);
    CHECK(coverage(0.0, 200, 10, 0.05, 400).clustered < 0.99);
}

// Studies of normal noise of variance 1 on gearboxes with normally or exponentially distributed
// means.
struct RareCoverage {
    double covered = 0.0, median_width = 0.0;
};

RareCoverage rare_coverage(double deviation, Law law, int gearboxes, int records, double rate,
                           int studies) {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> noise;
    std::exponential_distribution<double> skewed;
    RareCoverage result;
    std::vector<double> widths;
    for (int s = 0; s < studies; ++s) {
        std::vector<double> values;
        std::vector<std::size_t> gearbox;
        for (int g = 0; g < gearboxes; ++g) {
            const double own =
                deviation * (law == Law::exponential ? skewed(engine) - 1.0 : noise(engine));
            for (int r = 0; r < records; ++r) {
                values.push_back(own + noise(engine));
                gearbox.push_back(static_cast<std::size_t>(g));
            }
        }
        const double threshold = SortedSample(values, Alarm::high).threshold(rate).value;
        const Interval bounds =
            clustered_rate_interval(values, gearbox, Alarm::high, threshold, rate, 0.95);
        const double truth = rate_beyond(threshold, deviation, law);
        result.covered += bounds.lower <= truth && truth <= bounds.upper ? 1.0 / studies : 0.0;
        widths.push_back(bounds.upper / bounds.lower);
    }
    std::nth_element(widths.begin(), widths.begin() + studies / 2, widths.end());
    result.median_width = widths[static_cast<std::size_t>(studies / 2)];
    return result;
}

TEST_CASE("Rates below one per number of gearboxes are covered by many records of each") {
    // The standard deviation of a coverage of 0.95 in 200 studies is 0.015.
    constexpr double kLow = 0.95 - 0.045;
    const RareCoverage alike = rare_coverage(0.0, Law::normal, 500, 100, 0.001, 200),
                       differing = rare_coverage(0.4, Law::normal, 500, 100, 0.001, 200),
                       apart = rare_coverage(1.5, Law::normal, 1000, 50, 0.001, 100),
                       skewed = rare_coverage(0.4, Law::exponential, 1000, 50, 0.001, 100);
    CHECK(alike.covered > kLow);
    CHECK(alike.median_width < 1.9);
    CHECK(differing.covered > kLow);
    CHECK(differing.median_width < 2.2);
    // Where the alarms come from the gearboxes themselves, each gearbox counts as one record.
    CHECK(apart.covered > kLow);
    CHECK(skewed.covered > kLow);
    CHECK(apart.median_width > 3.0);
}

TEST_CASE("Rates of 1e-4 from 400 records of each of 2,000 gearboxes",
          "[.rare-coverage][rare-rates]") {
    for (const auto& [deviation, law] : {std::pair{0.0, Law::normal},
                                         {0.3, Law::normal},
                                         {0.6, Law::normal},
                                         {1.0, Law::normal},
                                         {0.3, Law::exponential}}) {
        const RareCoverage found = rare_coverage(deviation, law, 2000, 400, 1e-4, 500);
        WARN((law == Law::exponential ? "exponential" : "normal")
             << " gearboxes of deviation " << deviation << ": covered " << found.covered
             << ", upper over lower " << found.median_width);
        CHECK(found.covered > 0.95 - 0.03);
        if (deviation <= 0.3 && law == Law::normal) {
            CHECK(found.median_width < 1.65);
        }
    }
}

TEST_CASE("Detection uses the gearbox of each recording for its intervals and reports this") {
    std::mt19937_64 engine(8);
    std::normal_distribution<double> draw;
    std::vector<double> values, none(200, 0.0);
    std::vector<std::size_t> gearbox, each;
    for (std::size_t i = 0; i < 200; ++i) {
        values.push_back(draw(engine));
        gearbox.push_back(i / 50);
        each.push_back(i);
    }
    DetectionRequest request;
    request.noise_levels = {1.0};
    request.groups = {{1.0, 1.0}};
    const auto detected = [&](const std::vector<std::size_t>& of) {
        return detect_clustered("f", Alarm::high, {none, values}, of, {{}, {}}, request);
    };
    const FeatureDetection apart = detected(each), four = detected(gearbox);
    CHECK(apart.levels[0].threshold_rate.upper == threshold_rate_interval(200, 0.05, 0.95).upper);
    CHECK(apart.warnings.empty());
    CHECK(four.levels[0].threshold == apart.levels[0].threshold);
    // The upper bound of the largest of four is 1 - 0.025^(1/4).
    CHECK(four.levels[0].threshold_rate.upper == Approx(1.0 - std::pow(0.025, 0.25)));
    REQUIRE(four.warnings.size() == 1);
    CHECK_THAT(four.warnings[0], Catch::Contains("200 healthy records come from only 4 gearboxes"));
}

TEST_CASE("Equal records of one gearbox do not make a feature constant") {
    // First 50 gearboxes of 8 records without noise; then gearboxes that are all equal.
    std::vector<double> values, zeros(400, 0.0), sizes{1.0}, test{60.0};
    std::vector<std::size_t> gearbox;
    for (std::size_t i = 0; i < 400; ++i) {
        gearbox.push_back(i / 8);
        values.push_back(static_cast<double>(i / 8));
    }
    DetectionRequest request;
    request.noise_levels = {0.0};
    request.groups = {{1.0, 1.0}};
    const auto warning_of = [&](std::span<const double> healthy) {
        std::string text;
        for (const std::string& warning :
             detect_clustered("f", Alarm::high, {zeros, healthy}, gearbox, {sizes, test}, request)
                 .warnings) {
            text += warning + "\n";
        }
        return text;
    };
    CHECK_THAT(warning_of(values), !Catch::Contains("constant") && Catch::Contains("50 gearboxes"));
    CHECK_THAT(warning_of(zeros), Catch::Contains("the feature is constant"));
}

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
struct UniformCoverage {
    double threshold = 0.0, healthy = 0.0, expected = 0.0;
};

UniformCoverage uniform_coverage(int studies, int sample, int tested) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> draw;
    UniformCoverage hits;
    for (int s = 0; s < studies; ++s) {
        std::vector<double> values(sample);
        std::generate(values.begin(), values.end(), [&] { return draw(engine); });
        const Threshold threshold = SortedSample(values, Alarm::high).threshold(0.05);
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
    const UniformCoverage covered = uniform_coverage(4000, 199, 300);
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

}  // namespace gearpod::analysis::test_clusters
