// Checks the noncentral F law against integrals over its two chi-squared variables, and the bounds
// of the correlation ratio where an input explains almost everything.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "analysis/inputs/sobol_indices.hpp"
#include "analysis/statistics/noncentral_distributions.hpp"
#include "tests/analysis/reference_data.hpp"

namespace test_noncentral_f {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

TEST_CASE("the noncentral F law agrees with its integral up to a noncentrality of 1e10") {
    const auto reference = reference_columns("noncentral_f");
    REQUIRE(reference[0].size() == 63);
    for (std::size_t i = 0; i < reference[0].size(); ++i) {
        CAPTURE(i, reference[0][i], reference[1][i], reference[2][i], reference[3][i]);
        CHECK(noncentral_f_cdf(reference[0][i], reference[1][i], reference[2][i],
                               reference[3][i]) == Approx(reference[4][i]).margin(2e-9));
    }
}

TEST_CASE("the noncentral F law has no step where the computation method changes") {
    for (const double numerator : {1.0, 4.0, 42.0}) {
        for (const double denominator : {15.0, 900.0, 9957.0, 2e5}) {
            const double change = std::max(1e5, 100.0 * denominator);
            const double f = (change + numerator) / numerator;
            const double below = noncentral_f_cdf(f, numerator, denominator, change);
            const double above =
                noncentral_f_cdf(f, numerator, denominator, std::nextafter(change, HUGE_VAL));
            CAPTURE(numerator, denominator, below, above);
            CHECK(std::abs(above - below) < 1e-9);
        }
    }
}

TEST_CASE("bounds of a share exist for any sample, for inputs that explain nothing to everything") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    for (const int count : {20, 21, 150, 2000, 10000, 20000}) {
        std::vector<double> x, noise;
        for (int i = 0; i < count; ++i) {
            x.push_back(static_cast<double>(i % 4));
            noise.push_back(normal(engine));
        }
        for (const double scatter : {0.0, 1e-150, 1e-14, 1e-7, 1e-5, 1e-3, 0.1, 1.0, 1e3, 1e200}) {
            std::vector<double> y;
            for (int i = 0; i < count; ++i) {
                y.push_back(x[static_cast<std::size_t>(i)] +
                            scatter * noise[static_cast<std::size_t>(i)]);
            }
            const CorrelationRatio found = correlation_ratio(x, y, 0.95);
            // Variance of x (5/4) over the total variance.
            const double share = 1.25 / (1.25 + scatter * scatter);
            CAPTURE(count, scatter, found.share, found.bounds.lower, found.bounds.upper);
            CHECK(found.share == Approx(share).margin(5.0 / std::sqrt(count)));
            CHECK(found.bounds.upper >= found.share - 1e-6);
            CHECK(found.bounds.upper <= 1.0);
            if (scatter > 1e-11) {
                CHECK(found.bounds.lower <= std::max(0.0, found.share) + 1e-6);
                CHECK(found.bounds.lower >= 0.0);
                CHECK(found.bounds.upper - found.bounds.lower < 8.0 / std::sqrt(count));
            } else {
                CHECK(found.share == Approx(1.0));
            }
        }
    }
}

}  // namespace

}  // namespace test_noncentral_f
