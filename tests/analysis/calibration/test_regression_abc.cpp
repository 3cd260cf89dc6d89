// Checks approximate Bayesian computation against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "analysis/calibration/regression_abc.hpp"

namespace test_regression_abc {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

// Synthetic calibration with two parameters, uniform from 0 to 1. The first is the mean of eight
// normal values of standard deviation kSd, summarized by their mean and spread. The second has no
// effect on the summaries.
constexpr double kSd = 0.3;
constexpr int kValues = 8;

std::vector<double> summaries_at(double mean, std::mt19937& engine) {
    std::normal_distribution<double> noise(mean, kSd);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kValues; ++i) {
        const double value = noise(engine);
        sum += value;
        squares += value * value;
    }
    return {sum / kValues, std::log(squares / kValues - sum * sum / kValues / kValues)};
}

AbcSamples simulate(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> prior;
    AbcSamples samples;
    samples.parameters = samples.summaries = 2;
    for (std::size_t i = 0; i < count; ++i) {
        const double mean = prior(engine);
        samples.unit.insert(samples.unit.end(), {mean, prior(engine)});
        const auto summary = summaries_at(mean, engine);
        samples.summary.insert(samples.summary.end(), summary.begin(), summary.end());
        samples.group.push_back(i);
    }
    return samples;
}

std::vector<double> parameter(const AbcPosterior& posterior, std::size_t which) {
    std::vector<double> values;
    for (std::size_t i = which; i < posterior.unit.size(); i += 2) {
        values.push_back(posterior.unit[i]);
    }
    return values;
}

double normal_cdf(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

TEST_CASE("The posterior of a mean is the normal one, cut off where the prior ends") {
    const AbcSamples samples = simulate(20000, 1);
    const double sd = kSd / std::sqrt(static_cast<double>(kValues));
    for (const double seen : {0.5, 0.1}) {
        INFO(seen);
        const std::vector<double> observed{seen, std::log(kSd * kSd)};
        const AbcPosterior posterior = regression_abc(samples, observed, 0.2);
        const auto values = parameter(posterior, 0);
        const double below = normal_cdf(-seen / sd), above = normal_cdf((1.0 - seen) / sd);
        for (const double p : {0.05, 0.5, 0.95}) {
            const double quantile = weighted_quantile(values, posterior.weight, p);
            const double exact = (normal_cdf((quantile - seen) / sd) - below) / (above - below);
            CHECK(exact == Approx(p).margin(0.03));
        }
    }
}

TEST_CASE("A parameter without effect keeps its prior; the mean is determined by the mean") {
    const AbcPosterior posterior =
        regression_abc(simulate(20000, 2), std::vector<double>{0.4, std::log(kSd * kSd)}, 0.2);
    const auto idle = parameter(posterior, 1);
    for (const double p : {0.05, 0.5, 0.95}) {
        CHECK(weighted_quantile(idle, posterior.weight, p) == Approx(p).margin(0.03));
    }
    CHECK(posterior.correlation[0] > 0.3);
    CHECK(std::abs(posterior.correlation[2]) < 0.1);
    CHECK(std::accumulate(posterior.weight.begin(), posterior.weight.end(), 0.0) == Approx(1.0));
}

TEST_CASE("Intervals have their nominal coverage, also with few simulations") {
    const AbcSamples samples = simulate(600, 3);
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> prior;
    int held = 0;
    constexpr int kSets = 1000;
    for (int set = 0; set < kSets; ++set) {
        const double truth = prior(engine);
        const AbcPosterior posterior = regression_abc(samples, summaries_at(truth, engine), 0.2);
        const auto values = parameter(posterior, 0);
        held += weighted_quantile(values, posterior.weight, 0.05) <= truth &&
                truth <= weighted_quantile(values, posterior.weight, 0.95);
    }
    // All sets share one set of simulations, so its error is common to them.
    CHECK(held == Approx(0.9 * kSets).margin(0.04 * kSets));
}

TEST_CASE("Quantiles of weighted values are those of the values repeated") {
    const std::vector<double> values{3.0, 1.0, 2.0}, weights{0.25, 0.5, 0.25};
    CHECK(weighted_quantile(values, weights, 0.0) == 1.0);
    CHECK(weighted_quantile(values, weights, 0.25) == 1.0);
    CHECK(weighted_quantile(values, weights, 0.625) == Approx(2.0));
    CHECK(weighted_quantile(values, weights, 1.0) == 3.0);
}

TEST_CASE("Simulations and observations of different shapes are refused") {
    const AbcSamples samples = simulate(100, 5);
    CHECK_THROWS_AS(regression_abc(samples, std::vector<double>{0.5}, 0.2), std::invalid_argument);
    CHECK_THROWS_AS(regression_abc(simulate(15, 5), std::vector<double>{0.5, 0.0}, 0.2),
                    std::invalid_argument);
}

}  // namespace

}  // namespace test_regression_abc
