#include "analysis/statistics/regression_line.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {
namespace {

std::vector<double> residuals(std::span<const double> x, std::span<const double> y,
                              const RegressionLine& line) {
    std::vector<double> out;
    for (std::size_t i = 0; i < x.size(); ++i) {
        out.push_back(y[i] - line.at(x[i]));
    }
    return out;
}

double sum_of_squares(const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

CheckResult quadratic_term(std::span<const double> x, std::span<const double> y,
                           const RegressionLine& line, double line_squares) {
    // Centred square made orthogonal to the line. Its coefficient explains part of the residual sum
    // of squares.
    const double spread = std::sqrt(line.sum_xx / static_cast<double>(x.size()));
    std::vector<double> square;
    for (const double value : x) {
        square.push_back(std::pow((value - line.mean_x) / spread, 2));
    }
    const std::vector<double> left = residuals(x, square, regression_line(x, square));
    const double with_y = std::inner_product(left.begin(), left.end(), y.begin(), 0.0);
    const double taken = with_y * with_y / sum_of_squares(left);
    const double freedom = static_cast<double>(x.size()) - 3.0;
    const double statistic = taken / ((line_squares - taken) / freedom);
    return {"quadratic term (F)", statistic, f_upper_tail(statistic, 1.0, freedom)};
}

}  // namespace

double RegressionLine::leverage(double x) const {
    return 1.0 / static_cast<double>(count) + (x - mean_x) * (x - mean_x) / sum_xx;
}

RegressionLine regression_line(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 3) {
        throw std::invalid_argument("regression line: needs at least three points");
    }
    const auto n = static_cast<double>(x.size());
    RegressionLine line;
    line.count = static_cast<long>(x.size());
    line.mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double sum_xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        line.sum_xx += (x[i] - line.mean_x) * (x[i] - line.mean_x);
        sum_xy += (x[i] - line.mean_x) * (y[i] - mean_y);
    }
    line.slope = sum_xy / line.sum_xx;
    line.intercept = mean_y - line.slope * line.mean_x;
    line.sigma = std::sqrt(sum_of_squares(residuals(x, y, line)) / (n - 2.0));
    return line;
}

CheckResult linearity_check(std::span<const double> x, std::span<const double> y,
                            const RegressionLine& line) {
    std::vector<double> distinct(x.begin(), x.end());
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    const double line_squares = sum_of_squares(residuals(x, y, line));
    const auto sizes = static_cast<double>(distinct.size());
    constexpr double kReplicates =
        5.0;  // mean number of points per x; with fewer the F test has little power
    if (distinct.size() < 3 || static_cast<double>(x.size()) < kReplicates * sizes) {
        return quadratic_term(x, y, line, line_squares);
    }
    struct Group {
        double count = 0.0, sum = 0.0;
    };
    std::map<double, Group> groups;
    for (std::size_t i = 0; i < x.size(); ++i) {
        groups[x[i]].count += 1.0;
        groups[x[i]].sum += y[i];
    }
    const double freedom = static_cast<double>(x.size()) - sizes;
    double pure = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Group& group = groups[x[i]];
        pure += std::pow(y[i] - group.sum / group.count, 2);
    }
    const double statistic = ((line_squares - pure) / (sizes - 2.0)) / (pure / freedom);
    return {"lack of fit (F)", statistic, f_upper_tail(statistic, sizes - 2.0, freedom)};
}

CheckResult constant_variance_check(std::span<const double> x, std::span<const double> y,
                                    const RegressionLine& line) {
    std::vector<double> squares = residuals(x, y, line);
    for (double& value : squares) {
        value *= value;
    }
    const auto n = static_cast<double>(x.size());
    const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
    double total = 0.0;
    for (const double value : squares) {
        total += (value - mean) * (value - mean);
    }
    const RegressionLine trend = regression_line(x, squares);
    const double explained = n * trend.slope * trend.slope * trend.sum_xx;
    const double statistic = total > 0.0 ? explained / total : 0.0;
    return {"Breusch-Pagan (studentised)", statistic, chi_squared_upper_tail(statistic, 1.0)};
}

CheckResult normality_check(std::span<const double> x, std::span<const double> y,
                            const RegressionLine& line) {
    std::vector<double> values = residuals(x, y, line);
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    const double sd = std::sqrt(sum_of_squares(values) / (n - 1.0));
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double low = link_probability(Link::probit, values[i] / sd);
        const double high = link_probability(Link::probit, -values[values.size() - 1 - i] / sd);
        sum += (2.0 * static_cast<double>(i) + 1.0) * (std::log(low) + std::log(high));
    }
    const double statistic = -n - sum / n;
    const double a = statistic * (1.0 + 0.75 / n + 2.25 / (n * n));
    double p = 0.0;
    if (a < 0.2) {
        p = 1.0 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
    } else if (a < 0.34) {
        p = 1.0 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
    } else if (a < 0.6) {
        p = std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
    } else if (a < 13.0) {  // beyond this the formula no longer falls
        p = std::exp(1.2937 - 5.709 * a + 0.0186 * a * a);
    }
    return {"Anderson-Darling", statistic, p};
}

}  // namespace gearpod::analysis
