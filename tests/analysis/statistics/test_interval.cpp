#include <boost/math/distributions/binomial.hpp>

#include "analysis/statistics/interval.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_interval {

// Source: Newcombe, Statistics in Medicine 17 (1998), 857-872, Table I, 95 %: score method without
// continuity correction, exact method.
TEST_CASE("Wilson and Clopper-Pearson intervals agree with the published examples") {
    struct Row {
        long detected, tested;
        Interval wilson, exact;
    };
    const auto check = [](const Interval& found, const Interval& published) {
        CHECK(found.lower == Approx(published.lower).margin(5.1e-5));
        CHECK(found.upper == Approx(published.upper).margin(5.1e-5));
    };
    for (const Row& row : {Row{81, 263, {0.2553, 0.3662}, {0.2527, 0.3676}},
                           Row{15, 148, {0.0624, 0.1605}, {0.0578, 0.1617}},
                           Row{0, 20, {0.0, 0.1611}, {0.0, 0.1684}},
                           Row{1, 29, {0.0061, 0.1718}, {0.0009, 0.1776}}}) {
        check(wilson_interval(row.detected, row.tested, 0.95), row.wilson);
        check(clopper_pearson_interval(row.detected, row.tested, 0.95), row.exact);
    }
    // R's binom.test to all its digits (reference/reference_R.txt).
    const Interval interval = clopper_pearson_interval(81, 263, 0.95);
    CHECK(interval.lower == Approx(0.2527367456).epsilon(1e-9));
    CHECK(interval.upper == Approx(0.3676219226).epsilon(1e-9));
}

TEST_CASE("The observation is z standard errors away from Wilson's bounds") {
    const double z = 2.5758293035489004;  // 99 %
    for (const int detected : {3, 50, 97}) {
        const Interval interval = wilson_interval(detected, 100, 0.99);
        for (const double p : {interval.lower, interval.upper}) {
            CHECK(std::abs(detected / 100.0 - p) == Approx(z * std::sqrt(p * (1.0 - p) / 100.0)));
        }
    }
}

TEST_CASE("Wilson intervals are symmetric, end exactly at 0 and 1, and require a sample") {
    const Interval low = wilson_interval(7, 40, 0.9);
    const Interval high = wilson_interval(33, 40, 0.9);
    CHECK(low.lower == Approx(1.0 - high.upper));
    CHECK(low.upper == Approx(1.0 - high.lower));
    CHECK(wilson_interval(0, 12, 0.95).lower == 0.0);
    CHECK(wilson_interval(12, 12, 0.95).upper == 1.0);
    CHECK(std::isnan(wilson_interval(0, 0, 0.95).lower));
    CHECK_THROWS_AS(wilson_interval(5, 4, 0.95), std::invalid_argument);
    CHECK_THROWS_AS(wilson_interval(1, 4, 1.0), std::invalid_argument);
}

TEST_CASE("29 detections of 29 show a rate of 90 % at 95 %, 28 of 28 do not") {
    // The 29-of-29 rule of demonstration tests has a one-sided confidence.
    CHECK(clopper_pearson_interval(29, 29, 0.9).lower > 0.9);
    CHECK(clopper_pearson_interval(28, 28, 0.9).lower < 0.9);
}

TEST_CASE("Clopper-Pearson bounds leave half the error in each tail") {
    for (const int detected : {1, 7, 39}) {
        const Interval interval = clopper_pearson_interval(detected, 40, 0.99);
        using boost::math::binomial;
        CHECK(cdf(complement(binomial(40, interval.lower), detected - 1)) == Approx(0.005));
        CHECK(cdf(binomial(40, interval.upper), detected) == Approx(0.005));
    }
    CHECK(std::isnan(clopper_pearson_interval(0, 0, 0.95).lower));
    CHECK_THROWS_AS(clopper_pearson_interval(5, 4, 0.95), std::invalid_argument);
}

}  // namespace gearpod::analysis::test_interval
