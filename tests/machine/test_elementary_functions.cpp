// Checks the lanes' elementary functions against extended precision.
#include "machine/elementary_functions.hpp"
#include "tests/test.hpp"

namespace gearpod::machine::test_lane_math {

// Largest error of `function` on numbers uniform in a range, relative to `scale` of the exact
// value.
template <class Function, class Exact, class Scale>
double worst_error(double low, double high, Function function, Exact exact, Scale scale) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> uniform(low, high);
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double v = uniform(engine);
        const long double right = exact(static_cast<long double>(v));
        const long double error = (static_cast<long double>(function(v)) - right) / scale(right);
        worst = std::max(worst, std::abs(static_cast<double>(error)));
    }
    return worst;
}

constexpr auto kRelative = [](long double right) { return right; };
constexpr auto kAbsolute = [](long double) { return 1.0L; };
constexpr double kQuarterPi = 0.785398163397448309616;

TEST_CASE("The lanes' exponential agrees with an extended-precision one") {
    for (const double range : {0.5, 10.0, 700.0}) {
        CHECK(worst_error(
                  -range, range, [](double x) { return lane_exp(x); },
                  [](long double v) { return std::exp(v); }, kRelative) < 4e-16);
    }
    CHECK(lane_exp(0.0) == 1.0);
}

TEST_CASE("The lanes' logarithm agrees with an extended-precision one, also where it is zero") {
    const auto exact = [](long double x) { return -std::log(x * 0x1p-64L); };
    CHECK(worst_error(1.0, 1e6, lane_minus_log, exact, kRelative) < 4e-16);
    CHECK(worst_error(0x1p60, 0x1p64, lane_minus_log, exact, kRelative) < 4e-16);
    CHECK(lane_minus_log(0x1p64) == 0.0);
    const auto plain = [](long double x) { return std::log(x); };
    CHECK(worst_error(1e-300, 1e-290, lane_log, plain, kRelative) < 4e-16);
    CHECK(worst_error(0.0, 1.0, lane_log, plain, kRelative) < 4e-16);
    CHECK(lane_log(1.0) == 0.0);
    CHECK(lane_log(std::numeric_limits<double>::min()) ==
          Approx(std::log(std::numeric_limits<double>::min())));
}

TEST_CASE("The lanes' tail functions agree with extended-precision ones down to their ends") {
    const auto tail = [](double x) { return lane_erfc(x); };
    const auto exact_tail = [](long double x) { return std::erfc(x); };
    CHECK(worst_error(0.0, 1.0, tail, exact_tail, kRelative) < 2e-15);
    CHECK(worst_error(0.0, 26.0, tail, exact_tail, kRelative) < 2e-15);
    CHECK(lane_erfc(0.0) == Approx(1.0).epsilon(1e-15));
    CHECK(lane_erfc(40.0) < 1e-304);
    const auto share = [](double x) { return lane_one_minus_exp(x); };
    const auto exact_share = [](long double x) { return -std::expm1(-x); };
    CHECK(worst_error(0.0, 1e-6, share, exact_share, kRelative) < 4e-16);
    CHECK(worst_error(0.0, 40.0, share, exact_share, kRelative) < 4e-16);
    CHECK(lane_one_minus_exp(1e9) == 1.0);
}

TEST_CASE("The lanes' sine and cosine agree with extended-precision ones") {
    CHECK(worst_error(
              -kQuarterPi, kQuarterPi, [](double x) { return lane_sine(x); },
              [](long double x) { return std::sin(x); }, kRelative) < 3e-16);
    CHECK(worst_error(
              -kQuarterPi, kQuarterPi, [](double x) { return lane_cosine(x); },
              [](long double x) { return std::cos(x); }, kRelative) < 3e-16);
    const auto of_turns = [](long double z) {
        return std::sin(2 * 3.14159265358979323846264338327950288L * (z - std::round(z)));
    };
    CHECK(worst_error(-3.0, 3.0, lane_sine_of_turns, of_turns, kAbsolute) < 1e-15);
    CHECK(worst_error(-1e6, 1e6, lane_sine_of_turns, of_turns, kAbsolute) < 1e-15);
}

TEST_CASE("Sine and cosine along a flank agree with extended-precision ones") {
    const auto sine = [](double x) { return sine_cosine(x).sine; };
    const auto cosine = [](double x) { return sine_cosine(x).cosine; };
    CHECK(worst_error(
              -2.0, 2.0, sine, [](long double x) { return std::sin(x); }, kAbsolute) < 3e-16);
    CHECK(worst_error(
              -2.0, 2.0, cosine, [](long double x) { return std::cos(x); }, kAbsolute) < 3e-16);
}

}  // namespace gearpod::machine::test_lane_math
