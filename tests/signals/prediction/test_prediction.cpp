// Checks Toeplitz equations, periodic filters and cepstral pre-whitening.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "signals/prediction/inverse_filters.hpp"

namespace test_prediction {

using namespace gearpod::signals;

namespace {

TEST_CASE("Levinson's recursion solves Toeplitz equations with known solutions") {
    for (const std::size_t size : {1U, 2U, 7U, 60U}) {
        std::vector<double> r, x, b(size, 0.0);
        for (std::size_t i = 0; i < size; ++i) {
            const auto k = static_cast<double>(i);
            r.push_back(std::pow(0.8, k) * std::cos(0.7 * k));
            x.push_back(std::sin(1.0 + k * k));
        }
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t j = 0; j < size; ++j) {
                b[i] += r[i > j ? i - j : j - i] * x[j];
            }
        }
        const std::vector<double> solution = solve_toeplitz(r, b);
        REQUIRE(solution.size() == size);
        for (std::size_t i = 0; i < size; ++i) {
            CHECK(solution[i] == Approx(x[i]).margin(1e-11));
        }
    }
}

TEST_CASE("Periodic filters and correlations equal their sums") {
    const std::vector<double> x{1.0, -2.0, 4.0, 0.5, 3.0, -1.0, 2.0}, f{2.0, 0.0, -1.0};
    PeriodicSignal signal(x);
    const std::vector<double> filtered = signal.filtered(f);
    const std::vector<double> related = signal.correlated(filtered, 3);
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(filtered[i] == Approx(2.0 * x[i] - x[(i + 5) % 7]));
    }
    const std::vector<double> r = signal.corrected_autocorrelation(3);
    for (std::size_t l = 0; l < 3; ++l) {
        double own = 0.0, both = 0.0;
        for (std::size_t i = 0; i < 7; ++i) {
            own += x[i] * x[(i + l) % 7] / 7.0;
            both += filtered[i] * x[(i + 7 - l) % 7] / 7.0;
        }
        CHECK(r[l] == Approx(own * (l == 0 ? 1.0 + 1e-9 : 1.0)).epsilon(1e-12));
        CHECK(related[l] == Approx(both));
    }
}

TEST_CASE("Pre-whitening keeps an impulse and makes tones as weak as every other order") {
    // An impulse has equal magnitudes; without its mean it is 1 - 1/n there and -1/n elsewhere.
    constexpr std::size_t kPoints = 420;
    const auto n = static_cast<double>(kPoints);
    Prewhitening prewhitening(kPoints);
    std::vector<double> x(kPoints, 0.0);
    x[37] = 0.02;
    std::vector<double> white = prewhitening.whitened(x);
    for (std::size_t i = 0; i < kPoints; ++i) {
        CHECK(white[i] == Approx((i == 37 ? 1.0 : 0.0) - 1.0 / n).margin(1e-12));
    }
    for (std::size_t i = 0; i < kPoints; ++i) {
        x[i] += 50.0 * std::cos(2.0 * std::numbers::pi * 20.0 * static_cast<double>(i) / n);
    }
    // The tone changes the phases of order 20 and its mirror only, by at most 2 each.
    white = prewhitening.whitened(x);
    CHECK(white[37] == Approx(1.0 - 1.0 / n).margin(4.0 / n + 1e-9));
    CHECK(std::abs(white[36]) < 6.0 / n);
    for (const double value : prewhitening.whitened(std::vector<double>(kPoints, 2.0))) {
        CHECK(value == 0.0);
    }
}

}  // namespace

}  // namespace test_prediction
