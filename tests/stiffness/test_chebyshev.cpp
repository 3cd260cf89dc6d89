#include "stiffness/teeth/chebyshev.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_chebyshev {

TEST_CASE("a Chebyshev series reproduces polynomials exactly and an exponential to rounding") {
    const ChebyshevSeries cubic([](double t) { return t * t * t - 2 * t + 5; }, -1, 3, 12, 1e-14);
    CHECK(cubic.coefficients().size() == 4);
    CHECK(cubic(2.5) == Approx(15.625));
    CHECK(cubic.integral() == Approx(32));  // [t^4/4 - t^2 + 5 t] from -1 to 3
    const ChebyshevSeries wave([](double t) { return std::exp(t); }, 0, 2, 24, 1e-15);
    for (const double t : {0.0, 0.3, 1.1, 2.0})
        CHECK(wave(t) == Approx(std::exp(t)).epsilon(1e-14));
    CHECK(wave.integral() == Approx(std::exp(2.0) - 1).epsilon(1e-14));
}

TEST_CASE("the coefficients of T_3 are one") {
    const ChebyshevTransform transform(8);
    std::vector<double> values, coefficients(8);
    for (const double x : transform.points())
        values.push_back(4 * x * x * x - 3 * x);
    transform.fit(values, coefficients);
    for (int j = 0; j < 8; ++j)
        CHECK(coefficients[j] == Approx(j == 3 ? 1 : 0).margin(1e-15));
    CHECK(chebyshev_terms(coefficients, 1e-12) == 4);
}

TEST_CASE("values are raised to a given minimum") {
    const double line[] = {0, 1};
    const std::vector<double> t{-1, -0.5, 0.5};
    std::vector<double> values(3);
    evaluate_chebyshev(line, -1, 1, t, values, 0);
    CHECK(values == std::vector<double>{0, 0, 0.5});
}

}  // namespace gearpod::stiffness::test_chebyshev
