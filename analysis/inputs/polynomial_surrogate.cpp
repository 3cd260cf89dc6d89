#include "analysis/inputs/polynomial_surrogate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "analysis/statistics/link.hpp"
#include "analysis/statistics/midranks.hpp"

namespace gearpod::analysis {
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

}  // namespace gearpod::analysis
