// Checks given-data Sobol indices against functions whose indices are known in closed form.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/inputs/sobol_indices.hpp"

namespace test_sobol_indices {

using namespace gearpod;
using namespace gearpod::analysis;

namespace {

using Inputs = std::vector<std::vector<double>>;

Inputs uniform_inputs(int inputs, int count, double low, double high, std::mt19937_64& engine) {
    std::uniform_real_distribution<double> draw(low, high);
    Inputs columns(inputs);
    for (int i = 0; i < count; ++i) {
        for (std::vector<double>& column : columns) {
            column.push_back(draw(engine));
        }
    }
    return columns;
}

template <typename Function>
std::vector<double> outputs(const Inputs& inputs, Function f) {
    std::vector<double> y;
    for (std::size_t i = 0; i < inputs[0].size(); ++i) {
        std::vector<double> x;
        for (const std::vector<double>& column : inputs) {
            x.push_back(column[i]);
        }
        y.push_back(f(x));
    }
    return y;
}

SobolIndices indices(const Inputs& inputs, const std::vector<double>& y) {
    std::vector<InputColumn> columns;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        columns.push_back({"x" + std::to_string(i + 1), "1", inputs[i]});
    }
    return sobol_indices(y, columns, 0.95);
}

const SobolIndex& index_of(const SobolIndices& all, const std::string& name) {
    for (const SobolIndex& index : all.inputs) {
        if (index.name == name) {
            return index;
        }
    }
    throw std::invalid_argument(name);
}

TEST_CASE("Dependent inputs get no separate indices") {
    std::mt19937_64 engine(5);
    Inputs inputs = uniform_inputs(3, 1000, 0.0, 1.0, engine);
    const auto sum = [](const std::vector<double>& x) { return x[0] + x[1] + x[2]; };
    CHECK(indices(inputs, outputs(inputs, sum)).refusal.empty());
    for (std::size_t i = 0; i < inputs[0].size(); ++i) {
        inputs[2][i] = std::exp(inputs[0][i] + 0.5 * inputs[2][i]);
    }
    const SobolIndices refused = indices(inputs, outputs(inputs, sum));
    CHECK(refused.refusal.find("x1 and x3 are correlated (rank correlation 0.") == 0);
    CHECK(refused.inputs.empty());
}

TEST_CASE("Ishigami's function has its known first-order and total indices") {
    // T. Ishigami, T. Homma (1990), a = 7, b = 0.1: closed forms in Sobol and Levitan (1999).
    constexpr double kPi = std::numbers::pi, kA = 7.0, kB = 0.1;
    const double v1 = 0.5 * std::pow(1.0 + kB * std::pow(kPi, 4) / 5.0, 2);
    const double v2 = kA * kA / 8.0;
    const double v13 = kB * kB * std::pow(kPi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
    const double all = v1 + v2 + v13;
    std::mt19937_64 engine(3);
    const Inputs x = uniform_inputs(4, 4000, -kPi, kPi, engine);
    const SobolIndices found = indices(x, outputs(x, [&](const std::vector<double>& v) {
                                           return std::sin(v[0]) +
                                                  kA * std::pow(std::sin(v[1]), 2) +
                                                  kB * std::pow(v[2], 4) * std::sin(v[0]);
                                       }));
    REQUIRE(found.inputs.size() == 4);
    CHECK(index_of(found, "x1").first.share == Approx(v1 / all).margin(0.03));
    CHECK(index_of(found, "x2").first.share == Approx(v2 / all).margin(0.03));
    CHECK(std::abs(index_of(found, "x3").first.share) < 0.02);
    CHECK(std::abs(index_of(found, "x4").first.share) < 0.02);
    CHECK(index_of(found, "x1").total == Approx((v1 + v13) / all).margin(0.04));
    CHECK(index_of(found, "x3").total == Approx(v13 / all).margin(0.04));
    CHECK(index_of(found, "x2").total == Approx(v2 / all).margin(0.04));
    CAPTURE(found.explained, found.terms);
    CHECK(found.explained > 0.95);
    CHECK(index_of(found, "x4").total < 0.01);
}

TEST_CASE("Sobol's g-function has its known indices") {
    // g = prod (|4 x_i - 2| + a_i) / (1 + a_i); V_i = 1 / (3 (1 + a_i)^2).
    const double a[] = {0.0, 1.0, 4.5, 9.0};
    double product = 1.0;
    for (const double ai : a) {
        product *= 1.0 + 1.0 / (3.0 * std::pow(1.0 + ai, 2));
    }
    std::mt19937_64 engine(5);
    const Inputs x = uniform_inputs(4, 4000, 0.0, 1.0, engine);
    const SobolIndices found =
        indices(x, outputs(x, [&](const std::vector<double>& v) {
                    double g = 1.0;
                    for (int i = 0; i < 4; ++i) {
                        g *= (std::abs(4.0 * v[i] - 2.0) + a[i]) / (1.0 + a[i]);
                    }
                    return g;
                }));
    CAPTURE(found.explained, found.terms);
    for (int i = 0; i < 4; ++i) {
        const double own = 1.0 / (3.0 * std::pow(1.0 + a[i], 2));
        const SobolIndex& index = index_of(found, "x" + std::to_string(i + 1));
        CAPTURE(index.name, index.first.share, index.total);
        CHECK(index.first.share == Approx(own / (product - 1.0)).margin(0.03));
        CHECK(index.total == Approx(own * product / (1.0 + own) / (product - 1.0)).margin(0.05));
    }
    CHECK(found.inputs[0].name == "x1");
    CHECK(found.inputs[1].name == "x2");
}

TEST_CASE("Misses with independent noise leave a share unexplained") {
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> draw;
    const Inputs x = uniform_inputs(3, 3000, 0.0, 1.0, engine);
    // P(miss) = 0.1 + 0.6 x1 x2 has mean 0.25 and variance 0.1875; x1 alone explains 0.36 / 48 of
    // it.
    const SobolIndices found = indices(x, outputs(x, [&](const std::vector<double>& v) {
                                           return draw(engine) < 0.1 + 0.6 * v[0] * v[1] ? 1. : 0.;
                                       }));
    const double alone = 0.36 / 48.0 / 0.1875, together = 0.36 / 144.0 / 0.1875;
    const SobolIndex& first = index_of(found, "x1");
    CHECK(first.first.bounds.lower < alone);
    CHECK(first.first.bounds.upper > alone);
    CHECK(first.total_bounds.lower < alone + together);
    CHECK(first.total_bounds.upper > alone);
    CHECK(index_of(found, "x3").first.share < 0.015);
    CHECK(index_of(found, "x3").total == 0.0);
    CHECK(found.explained < 0.2);
}

TEST_CASE("Inputs with few values are binned by value") {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> draw;
    Inputs x(2);
    std::vector<double> y;
    for (int i = 0; i < 3000; ++i) {
        x[0].push_back(i % 3);  // values 0, 1, 2 have means 0, 1, 0: variance 2/9
        x[1].push_back(i % 2);
        y.push_back((i % 3 == 1 ? 1.0 : 0.0) + std::sqrt(2.0 / 9.0) * draw(engine));
    }
    const SobolIndices found = indices(x, y);
    CHECK(index_of(found, "x1").first.share == Approx(0.5).margin(0.03));
    CHECK(index_of(found, "x1").total == Approx(0.5).margin(0.03));
    CHECK(index_of(found, "x2").total == 0.0);
}

TEST_CASE("Without variation there are no indices") {
    const std::vector<double> constant(200, 3.0), few(50, 1.0);
    std::vector<double> ramp;
    for (int i = 0; i < 200; ++i) {
        ramp.push_back(i);
    }
    CHECK(sobol_indices(constant, {{"x", "1", ramp}}, 0.95).refusal ==
          "all gearboxes have the same value");
    CHECK_THAT(sobol_indices(few, {}, 0.95).refusal, Catch::Contains("100 are needed"));
    CHECK_THAT(sobol_indices({}, {}, 0.95).refusal, Catch::Contains("100 are needed"));
    const SobolIndices none = sobol_indices(ramp, {{"x", "1", constant}}, 0.95);
    CHECK(none.refusal == "no input varies");
    CHECK(none.left_out.size() == 1);
    // A deterministic output has no scatter within bins for an interval, but the estimate is never
    // NaN.
    const SobolIndices sure = sobol_indices(ramp, {{"x", "1", ramp}}, 0.95);
    CHECK(sure.inputs[0].first.share > 0.95);
    CHECK(sure.inputs[0].total == Approx(1.0).margin(1e-6));
}

template <typename Draw>
void check_coverage(Draw draw_y, int count, double first, double total) {
    constexpr int kStudies = 2000;
    std::mt19937_64 engine(41);
    double covered_first = 0.0, covered_total = 0.0;
    for (int s = 0; s < kStudies; ++s) {
        const Inputs x =
            uniform_inputs(3, count, -std::numbers::sqrt3, std::numbers::sqrt3, engine);
        const SobolIndices found =
            indices(x, outputs(x, [&](const std::vector<double>& v) { return draw_y(v, engine); }));
        const SobolIndex& index = index_of(found, "x1");
        covered_first += index.first.bounds.lower <= first && index.first.bounds.upper >= first;
        covered_total += index.total_bounds.lower <= total && index.total_bounds.upper >= total;
    }
    CAPTURE(count, covered_first / kStudies, covered_total / kStudies);
    CHECK(covered_first / kStudies == Approx(0.95).margin(0.015));
    CHECK(covered_total / kStudies == Approx(0.95).margin(0.015));
}

TEST_CASE("Bounds of both indices cover the truth", "[.coverage]") {
    // y = 2 x1 + 2 x2 + x1 x2 + 2 e, inputs of variance 1: V = 4 + 4 + 1 + 4.
    const auto smooth = [](const std::vector<double>& v, std::mt19937_64& engine) {
        std::normal_distribution<double> e(0.0, 2.0);
        return 2.0 * v[0] + 2.0 * v[1] + v[0] * v[1] + e(engine);
    };
    check_coverage(smooth, 1000, 4.0 / 13.0, 5.0 / 13.0);
    // P(y = 1) = 0.3 + 0.12 x1: V = 0.21.
    const auto yes_no = [](const std::vector<double>& v, std::mt19937_64& engine) {
        std::uniform_real_distribution<double> u;
        return u(engine) < 0.3 + 0.12 * v[0] ? 1.0 : 0.0;
    };
    check_coverage(yes_no, 1000, 0.0144 / 0.21, 0.0144 / 0.21);
}

}  // namespace

}  // namespace test_sobol_indices
