#include <boost/math/quadrature/gauss.hpp>

#include "analysis/statistics/distributions.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_distributions {

using std::numbers::pi;

// Plackett, Biometrika 41 (1954), 351-360: integral over the correlation, with sin t = correlation.
// All terms are positive, so that small probabilities keep their digits.
double plackett(double rate, double correlation) {
    const double limit = normal_upper_quantile(rate);
    const auto integrand = [&](double t) { return std::exp(-limit * limit / (1.0 + std::sin(t))); };
    return rate * rate + boost::math::quadrature::gauss<double, 60>::integrate(
                             integrand, 0.0, std::asin(correlation)) /
                             (2.0 * pi);
}

TEST_CASE("Two standard normals exceed their medians with Sheppard's probability") {
    for (const double r : {0.0, 1e-6, 0.3, 0.5, 0.9, 0.999, 0.999999, 1.0}) {
        CHECK(both_exceed(0.5, r) == Approx(0.25 + std::asin(r) / (2.0 * pi)).epsilon(1e-14));
    }
}

TEST_CASE("Independent normals multiply their probabilities, equal ones exceed together") {
    for (const double rate : {0.9, 0.5, 0.1, 1e-3, 1e-6, 1e-9, 1e-12}) {
        CHECK(both_exceed(rate, 0.0) == rate * rate);
        CHECK(both_exceed(rate, 1.0) == Approx(rate).epsilon(1e-13));
        // P(both exceed) - P(neither exceeds) = 2 rate - 1 for limits of opposite sign.
        CHECK(both_exceed(rate, 0.7) - both_exceed(1.0 - rate, 0.7) ==
              Approx(2.0 * rate - 1.0).margin(1e-14));
    }
    CHECK(both_exceed(0.0, 0.5) == 0.0);
    CHECK(both_exceed(1.0, 0.5) == 1.0);
}

TEST_CASE("Small probabilities of common exceedance keep their digits") {
    for (const double rate : {0.9, 0.1, 1e-3, 1e-6, 1e-9, 1e-12}) {
        for (const double r : {0.01, 0.1, 0.3, 0.5, 0.9, 0.99, 0.999, 0.999999}) {
            CAPTURE(rate, r);
            const double expected = plackett(rate, r);
            CHECK(both_exceed(rate, r) == Approx(expected).margin(2e-14 * rate).epsilon(1e-13));
            CHECK(both_exceed(rate, r) >= rate * rate);
        }
    }
}

}  // namespace gearpod::analysis::test_distributions
