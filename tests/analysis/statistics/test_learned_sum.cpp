// Checks the learned sum of several values against closed forms and against leaks between halves.
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "analysis/statistics/learned_sum.hpp"
#include "tests/test.hpp"

namespace gearpod::test_learned_sum {

using analysis::in_second_half;
using analysis::learned_sum;
using analysis::LearningSample;

// Values with a common part (standard deviation `common`) and own noise; faulty specimens are
// shifted by `shift`. Odd specimens are faulty, halves are pairs of specimens.
LearningSample sample_of(std::size_t specimens, const std::vector<double>& shift, double common,
                         unsigned seed) {
    boost::random::mt19937 engine(seed);
    boost::random::normal_distribution<double> unit;
    LearningSample sample;
    sample.values.resize(shift.size());
    for (std::size_t i = 0; i < specimens; ++i) {
        const double both = common * unit(engine);
        sample.faulty.push_back(i % 2 == 1);
        sample.half.push_back(static_cast<int>(i / 2 % 2));
        for (std::size_t v = 0; v < shift.size(); ++v) {
            sample.values[v].push_back(both + unit(engine) + (i % 2 == 1 ? shift[v] : 0.0));
        }
    }
    return sample;
}

// Difference of means over the standard deviation of the healthy ones.
double separation(const LearningSample& sample, const std::vector<double>& sums) {
    double mean[2] = {}, squares = 0.0;
    const double n = static_cast<double>(sums.size()) / 2.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        mean[sample.faulty[i] ? 1 : 0] += sums[i] / n;
        squares += sample.faulty[i] ? 0.0 : sums[i] * sums[i] / n;
    }
    return (mean[1] - mean[0]) / std::sqrt(squares - mean[0] * mean[0]);
}

TEST_CASE("A learned sum of independent values separates as their discriminant does") {
    // The separation of the best sum is the root of the sum of squares, 2.5; the equal sum has
    // (2 + 1.5 + 0) / sqrt(3).
    const LearningSample sample = sample_of(20000, {2.0, 1.5, 0.0}, 0.0, 1);
    CHECK(separation(sample, learned_sum(sample).value()) == Approx(2.5).epsilon(0.02));
}

TEST_CASE("A learned sum subtracts what healthy values have in common") {
    // Two values with common scatter 3, of which one shows the fault. The covariance is
    // [10 9; 9 10]. The share of its diagonal costs a part of the best separation.
    const LearningSample sample = sample_of(40000, {1.0, 0.0}, 3.0, 2);
    const double alone = 1.0 / std::sqrt(10.0);
    const double best = std::sqrt(10.0 / 19.0);  // from element (1, 1) of its inverse
    const double found = separation(sample, learned_sum(sample).value());
    CHECK(found > 1.8 * alone);
    CHECK(found < 1.02 * best);
}

TEST_CASE("Values that show nothing do not separate, however many there are") {
    // Weights that were learned from the graded specimens themselves would find 0.9.
    const LearningSample sample = sample_of(120, std::vector<double>(20, 0.0), 0.0, 3);
    CHECK(std::abs(separation(sample, learned_sum(sample).value())) < 0.5);
}

TEST_CASE("A learned sum needs specimens, and keeps missing values") {
    CHECK(!learned_sum(sample_of(36, {1.0, 1.0}, 0.0, 4)).has_value());
    LearningSample sample = sample_of(400, {1.0, 1.0}, 0.0, 5);
    sample.values[1][7] = std::nan("");
    const auto sums = learned_sum(sample).value();
    CHECK(std::isnan(sums[7]));
    CHECK(std::isfinite(sums[8]));
    sample.values[0].assign(400, 1.0);
    sample.values[1].assign(400, 1.0);
    CHECK(!learned_sum(sample).has_value());
}

TEST_CASE("Halves have equal sizes, and interleaved levels fall into both") {
    long all = 0, of_level[4] = {};
    for (std::size_t i = 0; i < 4000; ++i) {
        all += in_second_half(i);
        of_level[i % 4] += in_second_half(i);
    }
    CHECK(all == Approx(2000).margin(100));
    for (const long count : of_level) {
        CHECK(count == Approx(500).margin(75));
    }
}

}  // namespace gearpod::test_learned_sum
