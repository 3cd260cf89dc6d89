// Checks run lengths of detectors on independent normal numbers against published values, integral
// equations and Markov chains.
#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>

#include "analysis/monitoring/detector.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_run_lengths {

double phi(double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::acos(-1.0));
}
double Phi(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

// Mean of many runs. Its standard error in control is 1 / sqrt(runs) of the mean.
double simulated_length(const std::string& text, double threshold, double shift,
                        int runs = 20'000) {
    const auto detector = parse_detector(text);
    REQUIRE(detector);
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal(shift);
    DetectorState state(*detector);
    double values = 0.0;
    for (int run = 0; run < runs; ++run) {
        state.reset();
        do {
            values += 1.0;
        } while (!(state.next(normal(engine)) > threshold));
    }
    return values / runs;
}

struct Rule {
    std::vector<double> nodes, weights;
};

// Gauss-Legendre nodes on [low, high].
Rule gauss_on(double low, double high) {
    using Gauss = boost::math::quadrature::gauss<double, 60>;
    Rule rule;
    const double half = 0.5 * (high - low), middle = 0.5 * (high + low);
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
        for (const double side : {-1.0, 1.0}) {
            rule.nodes.push_back(middle + side * half * Gauss::abscissa()[i]);
            rule.weights.push_back(half * Gauss::weights()[i]);
        }
    }
    return rule;
}

// Solves L(x) = 1 + atom(x) L(0) + integral of kernel(x, y) L(y) dy at x = `start`; 0 is the first
// unknown.
template <class Kernel, class Atom>
double integral_equation(const Rule& rule, Kernel kernel, Atom atom) {
    const auto n = static_cast<Eigen::Index>(rule.nodes.size()) + 1;
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double x = i == 0 ? 0.0 : rule.nodes[static_cast<std::size_t>(i - 1)];
        a(i, 0) -= atom(x);
        for (Eigen::Index j = 1; j < n; ++j) {
            const auto at = static_cast<std::size_t>(j - 1);
            a(i, j) -= rule.weights[at] * kernel(x, rule.nodes[at]);
        }
    }
    return a.partialPivLu().solve(Eigen::VectorXd::Ones(n))(0);
}

// One-sided run length from 0 (E. S. Page 1954).
double cusum_length(double k, double h, double shift) {
    return integral_equation(
        gauss_on(0.0, h), [&](double x, double y) { return phi(y - x + k - shift); },
        [&](double x) { return Phi(k - x - shift); });
}

// Two-sided run length (S. V. Crowder, Technometrics 29 (1987), 401-407).
double ewma_length(double lambda, double limit, double shift) {
    const double h = limit * std::sqrt(lambda / (2.0 - lambda));
    return integral_equation(
        gauss_on(-h, h),
        [&](double x, double y) { return phi((y - (1.0 - lambda) * x) / lambda - shift) / lambda; },
        [](double /*x*/) { return 0.0; });
}

// Run length of both sides together (K. W. Kemp, J. R. Stat. Soc. B 23 (1961), 149-153).
double two_sided(double up, double down) {
    return 1.0 / (1.0 / up + 1.0 / down);
}

TEST_CASE("CUSUM and EWMA have their published run lengths", "[runlength]") {
    struct Row {
        const char* detector;
        double threshold, shift, published;
    };
    // Sources: for CUSUM D. C. Montgomery, Introduction to Statistical Quality Control, table of
    // two-sided run lengths at k = 1/2; for EWMA Lucas and Saccucci (1990), table 3.
    for (const Row& row :
         {Row{"cusum 0.5 two-sided", 5.0, 0.0, 465.0}, Row{"cusum 0.5 two-sided", 5.0, 1.0, 10.4},
          Row{"cusum 0.5 two-sided", 4.0, 0.0, 168.0}, Row{"cusum 0.5 two-sided", 4.0, 1.0, 8.38},
          Row{"ewma 0.1 two-sided", 2.814, 0.0, 500.0},
          Row{"ewma 0.1 two-sided", 2.814, 1.0, 10.3}}) {
        INFO(row.detector << " " << row.threshold << " " << row.shift);
        CHECK(simulated_length(row.detector, row.threshold, row.shift, 60'000) ==
              Approx(row.published).epsilon(0.01));
    }
}

TEST_CASE("Run lengths satisfy their integral equations", "[runlength]") {
    for (const double shift : {0.0, 0.5, 1.0, 2.0}) {
        INFO(shift);
        const double cusum =
            two_sided(cusum_length(0.5, 4.0, shift), cusum_length(0.5, 4.0, -shift));
        CHECK(simulated_length("cusum 0.5 two-sided", 4.0, shift) == Approx(cusum).epsilon(0.02));
        CHECK(simulated_length("cusum 0.5", 4.0, shift) ==
              Approx(cusum_length(0.5, 4.0, shift)).epsilon(0.02));
        CHECK(simulated_length("ewma 0.1 two-sided", 2.3, shift) ==
              Approx(ewma_length(0.1, 2.3, shift)).epsilon(0.02));
    }
    // The equations give the published digits.
    CHECK(two_sided(cusum_length(0.5, 5.0, 0.0), cusum_length(0.5, 5.0, 0.0)) ==
          Approx(465.0).margin(0.5));
    CHECK(two_sided(cusum_length(0.5, 4.0, 1.0), cusum_length(0.5, 4.0, -1.0)) ==
          Approx(8.38).margin(0.005));
    CHECK(ewma_length(0.1, 2.814, 0.0) == Approx(500.0).margin(0.5));
    CHECK(ewma_length(0.1, 2.814, 1.0) == Approx(10.3).margin(0.05));
}

// States are the bit patterns of which of the last n - 1 values lay beyond, the latest in bit 0;
// absorption is at m of n.
double m_of_n_length(int m, int n, double p) {
    const int states = 1 << (n - 1);
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(states, states);
    for (int state = 0; state < states; ++state) {
        for (const int beyond : {0, 1}) {
            if (__builtin_popcount(static_cast<unsigned>(state)) + beyond < m) {
                a(state, (state * 2 + beyond) % states) -= beyond == 1 ? p : 1.0 - p;
            }
        }
    }
    return a.partialPivLu().solve(Eigen::VectorXd::Ones(states))(0);
}

TEST_CASE("Rules of m of n and of single values have the run lengths of their Markov chains",
          "[runlength]") {
    const double threshold = 1.5, p = Phi(-threshold);
    CHECK(m_of_n_length(2, 2, p) == Approx((1.0 + p) / (p * p)));  // runs of two
    CHECK(simulated_length("single", 2.0, 0.0) == Approx(1.0 / Phi(-2.0)).epsilon(0.02));
    CHECK(simulated_length("2 of 2", threshold, 0.0) ==
          Approx(m_of_n_length(2, 2, p)).epsilon(0.02));
    CHECK(simulated_length("2 of 3", threshold, 0.0) ==
          Approx(m_of_n_length(2, 3, p)).epsilon(0.02));
    CHECK(simulated_length("3 of 5", 0.5, 0.0) ==
          Approx(m_of_n_length(3, 5, Phi(-0.5))).epsilon(0.02));
}

// P(no statistic beyond h) does not factor, but two values give a closed integral: the statistics
// are x and (x' + 2 x) / sqrt 5. L(x') = 1 + integral over the x without an alarm.
TEST_CASE("The trend's run lengths satisfy their integral equation", "[runlength]") {
    const double h = 2.0;
    CHECK(simulated_length("trend 1", h, 0.0) == Approx(1.0 / Phi(-h)).epsilon(0.02));
    // The lower limit is -8, below which values have negligible probability; many panels resolve
    // the kink of the region without an alarm.
    Rule rule;
    for (double low = -8.0; low < h - 1e-9; low += 0.25) {
        using Gauss = boost::math::quadrature::gauss<double, 10>;
        for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
            for (const double side : {-1.0, 1.0}) {
                rule.nodes.push_back(low + 0.125 * (1.0 + side * Gauss::abscissa()[i]));
                rule.weights.push_back(0.125 * Gauss::weights()[i]);
            }
        }
    }
    const auto n = static_cast<Eigen::Index>(rule.nodes.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd first(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto to = static_cast<std::size_t>(i);
        first(i) = rule.weights[to] * phi(rule.nodes[to]);
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto y = static_cast<std::size_t>(j);
            const bool quiet = rule.nodes[to] + 2.0 * rule.nodes[y] <= std::sqrt(5.0) * h;
            a(i, j) -= quiet ? rule.weights[y] * phi(rule.nodes[y]) : 0.0;
        }
    }
    // The first value can alarm by itself.
    const double length = 1.0 + first.dot(a.partialPivLu().solve(Eigen::VectorXd::Ones(n)));
    CHECK(simulated_length("trend 2", h, 0.0) == Approx(length).epsilon(0.02));
}

TEST_CASE("The trend's statistic is the likelihood ratio of the best ramp") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    const std::size_t window = 12;
    DetectorState state(*parse_detector("trend 12"));
    std::vector<double> values;
    for (int t = 0; t < 40; ++t) {
        values.push_back(normal(engine) + 0.05 * t);
        double best = 0.0;
        for (std::size_t begin = values.size() - std::min(values.size(), window);
             begin < values.size(); ++begin) {
            // Least squares of b j, j = 1, 2, ...; its reduction of the sum of squares is 2 ln
            // ratio.
            double xy = 0.0, xx = 0.0, without = 0.0, with = 0.0;
            for (std::size_t i = begin; i < values.size(); ++i) {
                const auto j = static_cast<double>(i - begin + 1);
                xy += j * values[i];
                xx += j * j;
            }
            const double slope = std::max(0.0, xy / xx);
            for (std::size_t i = begin; i < values.size(); ++i) {
                without += values[i] * values[i];
                with += std::pow(values[i] - slope * static_cast<double>(i - begin + 1), 2);
            }
            best = std::max(best, without - with);
        }
        CHECK(state.next(values.back()) == Approx(std::sqrt(best)).margin(1e-9));
    }
}

TEST_CASE("Detectors are parsed, and malformed ones are refused") {
    for (const char* text : {"single", "2 of 3", "ewma 0.1", "cusum 0.5", "trend 100",
                             "cusum 0.25 two-sided", "single two-sided"}) {
        INFO(text);
        CHECK(parse_detector(text));
    }
    for (const char* text : {"", "cusum", "cusum -1", "cusum x", "ewma 0", "ewma 1.5", "4 of 3",
                             "0 of 3", "2 of 99999999999", "trend 0", "trend 1.5", "two-sided",
                             "single  two-sided", "ewma nan", "cusum inf"}) {
        INFO(text);
        CHECK_FALSE(parse_detector(text));
    }
}

TEST_CASE("A missing value leaves a detector unchanged, and an alarm resets it") {
    const double nan = std::nan("");
    const Detector cusum = *parse_detector("cusum 0");
    const auto seen = detector_alarms(cusum, std::vector<double>{2, nan, 2, nan, 3, 2, 2}, 3.5);
    CHECK(seen.alarms == std::vector<std::size_t>{2, 5});
    CHECK(seen.largest_quiet == 3.0);
    CHECK(detector_alarms(cusum, std::vector<double>{1, 1}, nan).alarms.empty());
}

}  // namespace gearpod::analysis::test_run_lengths
