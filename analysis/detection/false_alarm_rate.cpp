#include "analysis/detection/false_alarm_rate.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

// (n+1)(1-rate) is a whole number for the usual rates; this keeps rounding from adding one to it.
constexpr double kRounding = 1e-9;

Interval equal_tails(double a, double b, double confidence) {
    const double tail = 0.5 * (1.0 - confidence);
    return {beta_quantile(a, b, tail), beta_upper_quantile(a, b, tail)};
}

// P(count <= k) of the beta-binomial distribution, summed on k's side of the mean, where terms
// decrease outwards.
double beta_binomial_cdf(long k, long tested, double a, double b) {
    const auto m = static_cast<double>(tested);
    const bool below = static_cast<double>(k) < m * a / (a + b);
    if (k >= tested) {
        return 1.0;
    }
    auto i = static_cast<double>(below ? k : k + 1);
    double p = std::exp(log_gamma(m + 1.0) - log_gamma(i + 1.0) - log_gamma(m - i + 1.0) +
                        log_gamma(i + a) + log_gamma(m - i + b) - log_gamma(m + a + b) +
                        log_gamma(a + b) - log_gamma(a) - log_gamma(b));
    constexpr double kNoMore = 1e-18;
    double sum = 0.0;
    while (i >= 0.0 && i <= m && p > kNoMore * sum) {
        sum += p;
        p *= below ? i * (m - i + b) / ((m - i + 1.0) * (i - 1.0 + a))
                   : (m - i) * (i + a) / ((i + 1.0) * (m - i - 1.0 + b));
        i += below ? -1.0 : 1.0;
    }
    sum = std::min(sum, 1.0);
    return below ? sum : 1.0 - sum;
}

template <typename Tail>
double solve_rate(Tail tail, double target) {
    const auto miss = [&](double q) { return tail(q) - target; };
    double low = 1e-12, high = 1.0 - 1e-12;
    if (miss(low) * miss(high) > 0.0) {
        return std::abs(miss(low)) < std::abs(miss(high)) ? 0.0 : 1.0;
    }
    std::uintmax_t steps = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        miss, low, high, boost::math::tools::eps_tolerance<double>(40), steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

long threshold_rank(long sample, double false_alarm_rate) {
    const double exact = static_cast<double>(sample + 1) * (1.0 - false_alarm_rate);
    return std::max(1L, static_cast<long>(std::ceil(exact - kRounding)));
}

Interval threshold_rate_interval(long sample, double false_alarm_rate, double confidence) {
    const long rank = threshold_rank(sample, false_alarm_rate);
    if (rank > sample) {
        return {kNan, kNan};
    }
    return equal_tails(static_cast<double>(sample + 1 - rank), static_cast<double>(rank),
                       confidence);
}

long sample_for_threshold(double false_alarm_rate) {
    return static_cast<long>(std::ceil(1.0 / false_alarm_rate - 1.0 - kRounding));
}

long sample_for_rate(double false_alarm_rate, double confidence) {
    const auto enough = [&](long sample) {
        return threshold_rate_interval(sample, false_alarm_rate, confidence).upper <=
               2.0 * false_alarm_rate;
    };
    // With k values beyond the threshold the bound falls with the sample, and it jumps where k
    // grows. The smallest sample of every k is therefore its worst.
    const auto smallest = [&](long beyond) {
        return static_cast<long>(
            std::ceil(static_cast<double>(beyond) / false_alarm_rate - 1.0 - kRounding));
    };
    const auto first = [](long low, long high, auto holds) {
        while (high - low > 1) {
            const long middle = low + (high - low) / 2;
            (holds(middle) ? high : low) = middle;
        }
        return high;
    };
    long most = 1;
    while (!enough(smallest(most))) {
        most *= 2;
    }
    const long beyond = first(0, most, [&](long k) { return enough(smallest(k)); });
    return first(smallest(beyond - 1), smallest(beyond), enough);
}

HealthyRate healthy_rate(long sample, double false_alarm_rate, long alarms, long tested,
                         double confidence) {
    const long rank = threshold_rank(sample, false_alarm_rate);
    if (rank > sample) {
        return {kNan, {kNan, kNan}};
    }
    const auto a = static_cast<double>(sample + 1 - rank + alarms);
    const auto b = static_cast<double>(rank + tested - alarms);
    return {a / (a + b), equal_tails(a, b, confidence)};
}

Interval expected_rate_interval(long sample, long alarms, long tested, double confidence) {
    if (sample <= 0 || tested <= 0) {
        return {kNan, kNan};
    }
    const double tail = 0.5 * (1.0 - confidence);
    const auto whole = static_cast<double>(sample + 1);
    const auto at_most = [&](long k, double q) {
        return beta_binomial_cdf(k, tested, whole * q, whole * (1.0 - q));
    };
    Interval bounds{0.0, 1.0};
    if (alarms > 0) {
        bounds.lower = solve_rate([&](double q) { return 1.0 - at_most(alarms - 1, q); }, tail);
    }
    if (alarms < tested) {
        bounds.upper = solve_rate([&](double q) { return at_most(alarms, q); }, tail);
    }
    return bounds;
}

}  // namespace gearpod::analysis
