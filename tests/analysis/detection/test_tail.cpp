// Checks thresholds beyond the healthy sample against laws with known tails.
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include "analysis/detection/threshold.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_tail {

// A law by its upper tail: the value for a probability of exceedance, and that probability.
struct Law {
    const char* name;
    std::function<double(double)> value, beyond;
};

Law pareto(const char* name, double shape) {
    return {name, [=](double q) { return (std::pow(q, -shape) - 1.0) / shape; },
            [=](double x) { return std::pow(std::max(0.0, 1.0 + shape * x), -1.0 / shape); }};
}

std::vector<Law> laws() {
    namespace math = boost::math;
    static const math::normal normal;
    static const math::chi_squared chi(4.0);
    return {{"exponential", [](double q) { return -std::log(q); },
             [](double x) { return std::exp(-x); }},
            {"normal", [](double q) { return quantile(complement(normal, q)); },
             [](double x) { return cdf(complement(normal, x)); }},
            {"chi-squared of 4", [](double q) { return quantile(complement(chi, q)); },
             [](double x) { return cdf(complement(chi, x)); }},
            {"lognormal", [](double q) { return std::exp(0.3 * quantile(complement(normal, q))); },
             [](double x) { return cdf(complement(normal, std::log(x) / 0.3)); }},
            {"Gumbel", [](double q) { return -std::log(-std::log1p(-q)); },
             [](double x) { return -std::expm1(-std::exp(-x)); }},
            pareto("heavy Pareto", 0.2),
            pareto("bounded Pareto", -0.2)};
}

// The largest of n values and the next ones, ascending, drawn without the others. Probabilities
// beyond the order statistics are S_j / S_(n+1) with S sums of exponentials (A. Renyi 1953).
std::vector<double> largest_of(const Law& law, long sample, std::mt19937_64& engine) {
    const long k = exceedances_of(sample);
    std::exponential_distribution<double> step;
    std::gamma_distribution<double> rest(static_cast<double>(sample - k));
    std::vector<double> values;
    double sum = 0.0;
    for (long j = 0; j <= k; ++j) {
        values.push_back(sum += step(engine));
    }
    sum += rest(engine);
    std::transform(values.begin(), values.end(), values.begin(),
                   [&](double s) { return law.value(s / sum); });
    std::reverse(values.begin(), values.end());
    return values;
}

struct Covered {
    double interval = 0.0, mean_rate = 0.0, width = 0.0;
};

Covered coverage(const Law& law, long sample, double rate, int studies) {
    std::mt19937_64 engine(11);
    Covered covered;
    std::vector<double> widths;
    for (int s = 0; s < studies; ++s) {
        const TailFit tail(largest_of(law, sample, engine), sample);
        const double threshold = tail.threshold(rate), truth = law.beyond(threshold);
        const Interval bounds = tail.rate(threshold, 0, 0, 0.95).bounds;
        covered.interval += (bounds.lower <= truth && truth <= bounds.upper ? 1.0 : 0.0) / studies;
        covered.mean_rate += truth / rate / studies;
        widths.push_back(bounds.upper / rate);
    }
    std::sort(widths.begin(), widths.end());
    covered.width = widths[widths.size() / 2];
    return covered;
}

TEST_CASE("Thresholds extend to five times beyond a sample with a hundred exceedances or more") {
    CHECK(tail_reaches(2000, 1e-4));
    CHECK(!tail_reaches(1999, 1e-4));
    CHECK(!tail_reaches(999, 0.0009));
    CHECK(sample_for_tail(1e-6) == 200'000);
    CHECK(sample_for_tail(0.01) == 1000);
    CHECK(exceedances_of(1500) == 150);
    CHECK(exceedances_of(1'000'000) == kMostExceedances);
}

TEST_CASE("The posterior is that of the generalised Pareto law under Jeffreys' prior") {
    // Computes the same integrals over shape and scale, as published, by a plain sum.
    std::mt19937_64 engine(3);
    std::exponential_distribution<double> draw(0.5);
    std::vector<double> largest{1.0};
    for (int i = 0; i < 100; ++i) {
        largest.push_back(1.0 + draw(engine));
    }
    std::sort(largest.begin(), largest.end());
    const TailFit tail(largest, 1000);
    const double value = tail.threshold(2e-4);
    double total = 0.0, shape_sum = 0.0, beyond = 0.0;
    for (double shape = -0.4985; shape < 1.0; shape += 0.003) {
        for (double scale = 0.8; scale < 4.5; scale += 0.01) {
            double log_density = -std::log(scale * (1.0 + shape) * std::sqrt(1.0 + 2.0 * shape));
            for (std::size_t i = 1; i < largest.size() && std::isfinite(log_density); ++i) {
                const double base = 1.0 + shape * (largest[i] - 1.0) / scale;
                log_density += base > 0.0 ? -std::log(scale) - (1.0 + 1.0 / shape) * std::log(base)
                                          : -std::numeric_limits<double>::infinity();
            }
            const double density = std::exp(log_density + 175.0);
            const double base = 1.0 + shape * (value - 1.0) / scale;
            total += density;
            shape_sum += shape * density;
            beyond += base > 0.0 ? density * std::pow(base, -1.0 / shape) : 0.0;
        }
    }
    CHECK(tail.shape() == Approx(shape_sum / total).margin(2e-3));
    CHECK(tail.rate(value) == Approx(2e-4).epsilon(1e-8));
    CHECK(beyond / total * 101.0 / 1001.0 == Approx(2e-4).epsilon(0.01));
}

TEST_CASE("Intervals of rates beyond the sample cover the truth over 500 studies") {
    // The standard deviation of a coverage of 0.95 in 500 studies is 0.0097. All laws, more studies
    // and 1e-6 are under [.rare-coverage].
    for (const Law& law : {laws()[0], laws()[1]}) {
        const Covered covered = coverage(law, 2000, 1e-4, 500);
        INFO(law.name);
        CHECK(covered.interval == Approx(0.95).margin(0.02));
    }
}

TEST_CASE("Intervals beyond the sample cover the truth, and expected rates equal those requested",
          "[.rare-coverage]") {
    for (const auto& [sample, rate] :
         {std::pair{1000L, 2e-4}, std::pair{2000L, 1e-4}, std::pair{200'000L, 1e-6}}) {
        for (const Law& law : laws()) {
            const Covered covered = coverage(law, sample, rate, 1000);
            WARN(law.name << ", " << sample << " at " << rate << ": covered " << covered.interval
                          << ", mean rate / asked " << covered.mean_rate
                          << ", median upper bound / asked " << covered.width);
            CHECK(covered.interval == Approx(0.95).margin(0.02));
            CHECK(covered.mean_rate < 2.0);
        }
    }
}

TEST_CASE("A threshold beyond the sample comes from the fitted tail, for either alarm side") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> draw;
    std::vector<double> high(2000), low;
    for (double& value : high) {
        value = draw(engine);
        low.push_back(-value);
    }
    const Threshold above = SortedSample(high, Alarm::high).threshold(1e-4);
    const Threshold below = SortedSample(low, Alarm::low).threshold(1e-4);
    REQUIRE(above.tail);
    CHECK(above.tail->exceedances() == 200);
    CHECK(above.value == -below.value);
    CHECK(above.value > *std::max_element(high.begin(), high.end()) - 1.0);
    const boost::math::normal normal;
    const double truth = cdf(complement(normal, above.value));
    const Interval own = rate_of(above, Alarm::high, 1e-4, 0, 0, 0.95).bounds;
    CHECK((own.lower <= truth && truth <= own.upper));
    // A long count takes precedence: 500 of 5 million.
    const HealthyRate counted = rate_of(above, Alarm::high, 1e-4, 500, 5'000'000, 0.95);
    CHECK(counted.rate == Approx(1e-4).epsilon(0.05));
    CHECK(counted.bounds.upper < 1.12e-4);
    CHECK(counted.bounds.lower > 0.90e-4);
    // A threshold within the sample stays an order statistic.
    CHECK(!SortedSample(high, Alarm::high).threshold(1e-3).tail);
    CHECK(std::isnan(SortedSample(high, Alarm::high).threshold(0.9e-4).value));
    std::fill(high.begin(), high.begin() + 300, 4.0);
    CHECK(std::isnan(SortedSample(high, Alarm::high).threshold(1e-4).value));
}

}  // namespace gearpod::analysis::test_tail
