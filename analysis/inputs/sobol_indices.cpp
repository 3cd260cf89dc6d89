#include "analysis/inputs/sobol_indices.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/inputs/input_effects.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/noncentral_distributions.hpp"
#include "analysis/statistics/quiet_policy.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kLeastUnit = std::numeric_limits<double>::min();

// Analysis of variance of y in bins of x; y has mean 0.
struct Variances {
    double count = 0.0, bins = 0.0;
    double between = 0.0, within = 0.0;  // sums of squares
    std::vector<double> fitted;          // bin mean of each value

    double total() const { return between + within; }
    double noise() const { return within / (count - bins); }
    double f() const { return between / (bins - 1.0) / noise(); }
    double share() const { return (between - (bins - 1.0) * noise()) / total(); }
};

Variances variances_of(std::span<const double> x, std::span<const double> y, std::size_t most) {
    const InputBins bins = equal_count_bins(x, most);
    std::vector<double> sum(bins.bins, 0.0), count(bins.bins, 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) {
        sum[bins.of[i]] += y[i];
        count[bins.of[i]] += 1.0;
    }
    Variances v;
    v.count = static_cast<double>(y.size());
    v.bins = static_cast<double>(bins.bins);
    v.fitted.resize(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
        const std::size_t b = bins.of[i];
        v.fitted[i] = sum[b] / count[b];
        v.between += v.fitted[i] * v.fitted[i];
        v.within += (y[i] - v.fitted[i]) * (y[i] - v.fitted[i]);
    }
    return v;
}

// Share of variance whose noncentrality gives the observed F or less with this probability.
double share_at(const Variances& v, double probability) {
    const auto beyond = [&](double share) {
        const double noncentrality = v.count * share / (1.0 - share);
        return noncentral_f_cdf(v.f(), v.bins - 1.0, v.count - v.bins, noncentrality) - probability;
    };
    constexpr double kLeast = 1e-9;
    if (!(beyond(kLeast) > 0.0)) {
        return 0.0;
    }
    const double most = 1.0 - 1e-6;
    if (beyond(most) > 0.0) {
        return 1.0;
    }
    std::uintmax_t steps = 60;
    const auto bracket = boost::math::tools::toms748_solve(
        beyond, kLeast, most, boost::math::tools::eps_tolerance<double>(20), steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

// Standard deviation of the estimate from its influence function relative to that under a normal
// distribution, at least 1.
double widening(const Variances& v, std::span<const double> y) {
    const double n = v.count, variance = v.total() / n;
    const double raw = v.between / v.total();
    double square = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double m = v.fitted[i];
        const double influence = (2.0 * m * y[i] - m * m - raw * y[i] * y[i]) / variance;
        square += influence * influence;
    }
    const double noise = std::pow(v.noise() / variance, 2);
    // Variance from bins without influence.
    const double chance = 2.0 * (v.bins - 1.0) * noise / (n * n);
    const double measured = std::max(0.0, square / (n * n) - 2.0 * chance) + chance;
    const double share = std::max(0.0, v.share());
    return std::sqrt(std::max(1.0, measured / (2.0 * noise * share * (2.0 - share) / n + chance)));
}

// Power of two near the largest value, by which division is exact, so that squares neither overflow
// nor underflow.
double power_of_two(std::span<const double> values) {
    double largest = 0.0;
    for (const double value : values) {
        largest = std::max(largest, std::abs(value));
    }
    return largest > 0.0 ? std::max(std::exp2(std::ilogb(largest)), kLeastUnit) : 1.0;
}

}  // namespace

CorrelationRatio correlation_ratio(std::span<const double> x, std::span<const double> y,
                                   double confidence) {
    constexpr std::size_t kFewest = 20;
    CorrelationRatio result{kNan, {kNan, kNan}};
    if (y.size() < kFewest) {
        return result;
    }
    const auto n = static_cast<double>(y.size());
    const double unit = power_of_two(y);
    double mean = 0.0;
    for (const double value : y) {
        mean += value / unit / n;
    }
    std::vector<double> centred;
    for (const double value : y) {
        centred.push_back(value / unit - mean);
    }
    const auto most = static_cast<std::size_t>(std::lround(2.0 * std::cbrt(n)));
    const Variances v = variances_of(x, centred, most);
    if (v.bins < 2.0 || !(v.total() > 1e-24 * mean * mean * n)) {
        return result;
    }
    constexpr double kRounding = 1e-24;
    if (!(v.within > kRounding * v.total())) {
        return {1.0, {kNan, 1.0}};  // no scatter within bins, so no lower bound
    }
    result.share = v.share();
    const double wide = widening(v, centred);
    const double tail = 0.5 * (1.0 - confidence);
    const double low = share_at(v, 1.0 - tail), high = share_at(v, tail);
    result.bounds.lower =
        low > 0.0 ? std::clamp(result.share - wide * (result.share - low), 0.0, 1.0) : 0.0;
    result.bounds.upper = std::clamp(result.share + wide * (high - result.share), 0.0, 1.0);
    return result;
}

namespace {

constexpr int kDegree = 8;      // highest degree of a term of one input
constexpr int kPairDegree = 5;  // highest total degree of a term of two
constexpr int kMostTerms = 40;
constexpr int kRowsPerTerm = 10;

// Polynomials of the ranks of an input, orthonormal over the sample: column k - 1 has degree k.
// Fewer columns if the input has fewer values.
Eigen::MatrixXd orthonormal_powers(const std::vector<double>& input) {
    const std::vector<double> ranks = midranks(input);
    const auto n = static_cast<Eigen::Index>(input.size());
    const Eigen::VectorXd u =
        (2.0 * Eigen::VectorXd::Map(ranks.data(), n).array() - 1.0) / static_cast<double>(n) - 1.0;
    Eigen::MatrixXd basis(n, kDegree + 1);
    basis.col(0).setOnes();
    int degree = 0;
    for (; degree < kDegree; ++degree) {
        Eigen::VectorXd next = u.cwiseProduct(basis.col(degree));
        const double before = next.squaredNorm();
        for (int pass = 0; pass < 2; ++pass) {
            for (int k = 0; k <= degree; ++k) {
                next -= basis.col(k) * (basis.col(k).dot(next) / static_cast<double>(n));
            }
        }
        const double norm = next.squaredNorm();
        if (!(norm > 1e-12 * before)) {
            break;  // no more powers than values less one
        }
        basis.col(degree + 1) = next * std::sqrt(static_cast<double>(n) / norm);
    }
    return basis.middleCols(1, degree);
}

std::vector<SurrogateTerm> candidates(const std::vector<Eigen::MatrixXd>& powers) {
    std::vector<SurrogateTerm> all;
    const int inputs = static_cast<int>(powers.size());
    const auto degrees = [&](int i) { return static_cast<int>(powers[i].cols()); };
    for (int i = 0; i < inputs; ++i) {
        for (int j = 1; j <= degrees(i); ++j) {
            all.push_back({i, j});
        }
        for (int second = i + 1; second < inputs; ++second) {
            for (int j = 1; j <= degrees(i); ++j) {
                for (int k = 1; k <= degrees(second) && j + k <= kPairDegree; ++k) {
                    all.push_back({i, j, second, k});
                }
            }
        }
    }
    return all;
}

Eigen::VectorXd column_of(const SurrogateTerm& term, const std::vector<Eigen::MatrixXd>& powers) {
    const auto first = powers[term.input].col(term.degree - 1);
    if (term.second < 0) {
        return first;
    }
    return first.cwiseProduct(powers[term.second].col(term.second_degree - 1));
}

struct Best {
    std::size_t term = 0;
    double correlation = 0.0;  // absolute
};

Best best_term(const std::vector<SurrogateTerm>& all, const std::vector<Eigen::MatrixXd>& powers,
               const Eigen::VectorXd& residual) {
    Best best;
    const double norm = residual.norm();
    Eigen::VectorXd column;
    for (std::size_t t = 0; t < all.size(); ++t) {
        column = column_of(all[t], powers);
        const double length = column.norm();
        const double correlation =
            length > 0.0 ? std::abs(column.dot(residual)) / (length * norm) : 0.0;
        if (correlation > best.correlation) {
            best = {t, correlation};
        }
    }
    return best;
}

}  // namespace

PolynomialSurrogate fit_surrogate(const std::vector<std::vector<double>>& inputs,
                                  std::span<const double> output) {
    const auto n = static_cast<Eigen::Index>(output.size());
    const auto count = static_cast<double>(n);
    std::vector<Eigen::MatrixXd> powers;
    for (const std::vector<double>& input : inputs) {
        powers.push_back(orthonormal_powers(input));
    }
    const std::vector<SurrogateTerm> all = candidates(powers);
    PolynomialSurrogate result;
    Eigen::VectorXd y = Eigen::VectorXd::Map(output.data(), n);
    y.array() -= y.mean();
    result.variance = y.squaredNorm() / count;
    result.residual = y;
    const auto tests = static_cast<double>(std::max<std::size_t>(1, all.size()));
    const double critical = link_quantile(Link::probit, 1.0 - 0.025 / tests);
    const double found = critical + link_quantile(Link::probit, 0.95);
    result.resolution = std::min(1.0, found * found / count);
    const int most = std::min(kMostTerms, static_cast<int>(n) / kRowsPerTerm);
    Eigen::MatrixXd columns(n, most);
    Eigen::MatrixXd inverse;
    Eigen::VectorXd coefficients;
    int terms = 0;
    while (terms < most && result.residual.squaredNorm() > 1e-20 * y.squaredNorm()) {
        const Best best = best_term(all, powers, result.residual);
        const double left = 1.0 - best.correlation * best.correlation;
        if (!(best.correlation * std::sqrt(count - terms - 2.0) > critical * std::sqrt(left))) {
            break;
        }
        columns.col(terms) = column_of(all[best.term], powers);
        columns.col(terms).array() -= columns.col(terms).mean();
        const auto used = columns.leftCols(terms + 1);
        const Eigen::MatrixXd gram = used.transpose() * used;
        const Eigen::LDLT<Eigen::MatrixXd> solver(gram);
        if (solver.vectorD().minCoeff() < 1e-9 * solver.vectorD().maxCoeff()) {
            break;
        }
        coefficients = solver.solve(used.transpose() * y);
        inverse = solver.solve(Eigen::MatrixXd::Identity(terms + 1, terms + 1));
        result.residual = y - used * coefficients;
        result.terms.push_back(all[best.term]);
        ++terms;
    }
    result.columns = columns.leftCols(terms);
    const double noise = result.residual.squaredNorm() / std::max(1.0, count - terms - 1.0);
    for (int t = 0; t < terms; ++t) {
        result.terms[t].coefficient = coefficients[t];
        result.terms[t].variance = noise * inverse(t, t);
    }
    result.explained = 1.0 - noise * (count - 1.0) / count / result.variance;
    if (terms == 0) {
        result.explained = 0.0;
    }
    return result;
}

namespace {

constexpr std::size_t kFewestGearboxes = 100;
constexpr std::size_t kMost = 20000;

// Spearman's rank correlation of largest magnitude.
struct Dependence {
    std::size_t first = 0, second = 0;
    double rank = 0.0;
};

Dependence strongest_dependence(const std::vector<std::vector<double>>& columns) {
    std::vector<Eigen::VectorXd> ranks;
    for (const std::vector<double>& column : columns) {
        const std::vector<double> of_column = midranks(column);
        const Eigen::VectorXd all = Eigen::Map<const Eigen::VectorXd>(
            of_column.data(), static_cast<Eigen::Index>(of_column.size()));
        ranks.push_back((all.array() - all.mean()).matrix().normalized());
    }
    Dependence most;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        for (std::size_t j = i + 1; j < ranks.size(); ++j) {
            const double rank = ranks[i].dot(ranks[j]);
            if (std::abs(rank) > std::abs(most.rank)) {
                most = {i, j, rank};
            }
        }
    }
    return most;
}

// Sets the total index: the share of the terms that contain the input in the variance.
void add_total(SobolIndex& index, int input, const PolynomialSurrogate& surrogate,
               std::span<const double> output, double mean, double confidence) {
    const double variance = surrogate.variance;
    const auto n = static_cast<Eigen::Index>(output.size());
    Eigen::VectorXd influence = Eigen::VectorXd::Zero(n);
    bool any = false;
    for (std::size_t t = 0; t < surrogate.terms.size(); ++t) {
        const SurrogateTerm& term = surrogate.terms[t];
        if (!term.has(input)) {
            continue;
        }
        any = true;
        index.total += (term.coefficient * term.coefficient - term.variance) / variance;
        influence +=
            2.0 * term.coefficient / variance *
            surrogate.columns.col(static_cast<Eigen::Index>(t)).cwiseProduct(surrogate.residual);
    }
    if (!any) {
        index.total_bounds = {0.0, surrogate.resolution};
        return;
    }
    index.total = std::clamp(index.total, 0.0, 1.0);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double away = output[static_cast<std::size_t>(i)] - mean;
        influence[i] -= index.total * (away * away / variance - 1.0);
    }
    const double z = link_quantile(Link::probit, 0.5 * (1.0 + confidence));
    const double half = z * influence.norm() / static_cast<double>(n);
    index.total_bounds = {std::max(0.0, index.total - half), std::min(1.0, index.total + half)};
}

}  // namespace

SobolIndices sobol_indices(std::span<const double> output, const std::vector<InputColumn>& inputs,
                           double confidence) {
    EXPECTS(std::ranges::all_of(
        inputs, [&](const InputColumn& input) { return input.values.size() == output.size(); }));
    SobolIndices result;
    output = output.first(std::min(output.size(), kMost));
    result.count = static_cast<long>(output.size());
    if (output.size() < kFewestGearboxes) {
        result.refusal =
            fmt::format("only {} gearboxes, {} are needed", output.size(), kFewestGearboxes);
        return result;
    }
    if (!varies(output)) {
        result.refusal = "all gearboxes have the same value";
        return result;
    }
    std::vector<std::vector<double>> columns;
    for (const InputColumn& input : inputs) {
        const auto values = input.values.first(output.size());
        if (!varies(values)) {
            result.left_out.push_back(input.name);
            continue;
        }
        columns.emplace_back(values.begin(), values.end());
        result.inputs.push_back(
            {input.name, input.unit, correlation_ratio(values, output, confidence), 0.0, {}});
    }
    if (columns.empty()) {
        result.refusal = "no input varies";
        return result;
    }
    // One in 100,000 pairs of independent inputs exceeds this limit by chance.
    constexpr double kChance = 4.5, kSlight = 0.1;
    const Dependence most = strongest_dependence(columns);
    if (std::abs(most.rank) >
        std::max(kSlight, kChance / std::sqrt(static_cast<double>(output.size())))) {
        result.refusal = fmt::format(
            "{} and {} are correlated (rank correlation {:.2f}), but the indices need independent "
            "inputs",
            result.inputs[most.first].name, result.inputs[most.second].name, most.rank);
        result.inputs.clear();
        return result;
    }
    const PolynomialSurrogate surrogate = fit_surrogate(columns, output);
    result.explained = surrogate.explained;
    result.resolution = surrogate.resolution;
    result.terms = static_cast<int>(surrogate.terms.size());
    double mean = 0.0;
    for (const double value : output) {
        mean += value / static_cast<double>(output.size());
    }
    for (std::size_t i = 0; i < result.inputs.size(); ++i) {
        add_total(result.inputs[i], static_cast<int>(i), surrogate, output, mean, confidence);
    }
    std::stable_sort(
        result.inputs.begin(), result.inputs.end(), [](const SobolIndex& a, const SobolIndex& b) {
            return a.total != b.total ? a.total > b.total : a.first.share > b.first.share;
        });
    return result;
}

namespace {

std::vector<double> normal_scores(const std::vector<double>& values) {
    std::vector<double> scores = midranks(values);
    for (double& score : scores) {
        score = link_quantile(Link::probit, (score - 0.5) / static_cast<double>(values.size()));
    }
    return scores;
}

}  // namespace

LevelSensitivity level_sensitivity(const std::string& feature, std::span<const double> values,
                                   const std::vector<int>& hit, const InputColumn& size,
                                   const std::vector<InputColumn>& inputs,
                                   const LevelDetection& detection, double confidence) {
    LevelSensitivity result{feature, transition_sizes(detection.cells), {}, {}};
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i] >= 0 && in_range(size.values[i], result.sizes)) {
            rows.push_back(i);
        }
    }
    std::vector<InputColumn> columns{size};
    columns.insert(columns.end(), inputs.begin(), inputs.end());
    std::vector<std::vector<double>> picked;
    picked.reserve(columns.size());
    for (InputColumn& column : columns) {
        std::vector<double>& values_of = picked.emplace_back();
        for (const std::size_t row : rows) {
            values_of.push_back(column.values[row]);
        }
        column.values = values_of;
    }
    std::vector<double> misses, value;
    for (const std::size_t row : rows) {
        misses.push_back(hit[row] == 0 ? 1.0 : 0.0);
        value.push_back(values[row]);
    }
    if (std::isnan(detection.threshold)) {
        result.misses.refusal = result.values.refusal = "no threshold";
        return result;
    }
    result.misses = sobol_indices(misses, columns, confidence);
    result.values = sobol_indices(normal_scores(value), columns, confidence);
    return result;
}

}  // namespace gearpod::analysis
