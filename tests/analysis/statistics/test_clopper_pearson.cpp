#include <boost/math/distributions/binomial.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/statistics/clopper_pearson.hpp"

namespace test_clopper_pearson {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

TEST_CASE("Clopper-Pearson intervals agree with the published examples") {
    struct Row {
        long detected, tested;
        double lower, upper;
    };
    // Sources: Newcombe, Statistics in Medicine 17 (1998), 857-872, Table I, exact method, 95 %;
    // R's binom.test to all its digits (reference/reference_R.txt).
    for (const Row& row : {Row{81, 263, 0.2527, 0.3676}, Row{15, 148, 0.0578, 0.1617},
                           Row{0, 20, 0.0, 0.1684}, Row{1, 29, 0.0009, 0.1776}}) {
        const Interval interval = clopper_pearson_interval(row.detected, row.tested, 0.95);
        CHECK(interval.lower == Approx(row.lower).margin(5.1e-5));
        CHECK(interval.upper == Approx(row.upper).margin(5.1e-5));
    }
    const Interval interval = clopper_pearson_interval(81, 263, 0.95);
    CHECK(interval.lower == Approx(0.2527367456).epsilon(1e-9));
    CHECK(interval.upper == Approx(0.3676219226).epsilon(1e-9));
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

}  // namespace

}  // namespace test_clopper_pearson
