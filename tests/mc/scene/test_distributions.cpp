// Laws that a study may draw its inputs from, against their closed forms.
#include "tests/mc/scene/draws.hpp"

using namespace gearpod::tests;

TEST_CASE("Draws of Weibull and beta laws follow their distribution functions") {
    for (const double shape : {0.7, 2.0, 9.0}) {
        const std::string text =
            "{distribution='weibull', scale=3, shape=" + std::to_string(shape) + "}";
        CHECK(kolmogorov_smirnov(draws_of(text, kDraws), [&](double x) {
                  return 1.0 - std::exp(-std::pow(x / 3.0, shape));
              }) < kKsLimit);
    }
    // alpha = 2, beta = 1: F = u^2; alpha = beta = 1/2: the arcsine law.
    CHECK(kolmogorov_smirnov(
              draws_of("{distribution='beta', low=-1, high=3, alpha=2, beta=1}", kDraws),
              [](double x) { return std::pow((x + 1) / 4, 2); }) < kKsLimit);
    CHECK(kolmogorov_smirnov(
              draws_of("{distribution='beta', low=0, high=2, alpha=0.5, beta=0.5}", kDraws),
              [](double x) { return 2 / 3.14159265358979324 * std::asin(std::sqrt(x / 2)); }) <
          kKsLimit);
}

TEST_CASE("Discrete values come as often as their weights say") {
    const auto draws =
        draws_of("{distribution='discrete', values=[30, 10, 20], weights=[1, 2, 5]}", kDraws);
    for (const auto& [value, share] : {std::pair{30.0, 0.125}, {10.0, 0.25}, {20.0, 0.625}}) {
        const double found = static_cast<double>(std::count(draws.begin(), draws.end(), value));
        CHECK(found / kDraws == Approx(share).margin(4 * std::sqrt(share * (1 - share) / kDraws)));
    }
    const Distribution discrete =
        distribution_of("{distribution='discrete', values=[30, 10, 20], weights=[1, 2, 5]}");
    CHECK(discrete.median() == 20.0);
    CHECK(discrete.support().low == 10.0);
    CHECK(discrete.support().high == 30.0);
    for (const char* bad : {"{distribution='discrete', values=[1, 2], weights=[1]}",
                            "{distribution='discrete', values=[1, 2], weights=[1, 0]}",
                            "{distribution='weibull', scale=1, shape=0.1}",
                            "{distribution='beta', low=1, high=1, alpha=1, beta=1}"}) {
        Problems problems;
        const Value document = parse_document(std::string("x = ") + bad, "test.toml", problems);
        CHECK(!Distribution::read(document.find("x")->value, "x", problems));
        CHECK(problems.size() == 1);
    }
}

TEST_CASE("Medians of Weibull and beta laws are those of the distribution function") {
    const auto median_of = [](const std::string& text) { return distribution_of(text).median(); };
    CHECK(median_of("{distribution='weibull', scale=2, shape=3}") ==
          Approx(2 * std::cbrt(std::log(2.0))));
    CHECK(median_of("{distribution='beta', low=0, high=4, alpha=3, beta=3}") == Approx(2));
}
