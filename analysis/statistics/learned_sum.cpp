#include "analysis/statistics/learned_sum.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "machine/no_value.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kDiagonal = 0.1;  // share of the covariance that its diagonal replaces

Eigen::VectorXd values_of(const LearningSample& sample, std::size_t specimen) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(sample.values.size()));
    for (Eigen::Index v = 0; v < values.size(); ++v) {
        values(v) = sample.values[static_cast<std::size_t>(v)][specimen];
    }
    return values;
}

// Score of a specimen: weights . values - offset.
struct Weights {
    Eigen::VectorXd weights;
    double offset = 0.0;
};

std::optional<Weights> learned_in(const LearningSample& sample, int half) {
    const auto size = static_cast<Eigen::Index>(sample.values.size());
    Eigen::VectorXd mean[2] = {Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size)};
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(size, size);
    int count[2] = {0, 0};
    for (std::size_t i = 0; i < sample.faulty.size(); ++i) {
        const Eigen::VectorXd values = values_of(sample, i);
        if (sample.half[i] != half || !values.allFinite()) {
            continue;
        }
        const int kind = sample.faulty[i] ? 1 : 0;
        ++count[kind];
        const Eigen::VectorXd before = values - mean[kind];
        mean[kind] += before / count[kind];
        if (kind == 0) {
            squares += before * (values - mean[0]).transpose();
        }
    }
    if (count[0] < kLeastLearned || count[1] < kLeastLearned) {
        return std::nullopt;
    }
    Eigen::MatrixXd covariance = squares / (count[0] - 1);
    const Eigen::VectorXd diagonal = covariance.diagonal();
    covariance *= 1.0 - kDiagonal;
    covariance.diagonal() = diagonal;
    const Eigen::LDLT<Eigen::MatrixXd> solver(covariance);
    const Eigen::VectorXd weights = solver.solve(mean[1] - mean[0]);
    const double scatter = std::sqrt(weights.dot(covariance * weights));
    if (!(scatter > 0.0) || !std::isfinite(scatter)) {
        return std::nullopt;
    }
    return Weights{weights / scatter, weights.dot(mean[0]) / scatter};
}

}  // namespace

bool in_second_half(std::size_t gearbox) {
    // Mixing function of splitmix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014, 453-472.
    std::uint64_t z = static_cast<std::uint64_t>(gearbox) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return ((z ^ (z >> 31)) & 1u) != 0;
}

std::optional<std::vector<double>> learned_sum(const LearningSample& sample) {
    const std::optional<Weights> of[2] = {learned_in(sample, 1), learned_in(sample, 0)};
    if (!of[0] || !of[1]) {
        return std::nullopt;
    }
    std::vector<double> sums;
    for (std::size_t i = 0; i < sample.faulty.size(); ++i) {
        const Eigen::VectorXd values = values_of(sample, i);
        const Weights& half_weights = *of[sample.half[i]];
        sums.push_back(values.allFinite() ? half_weights.weights.dot(values) - half_weights.offset
                                          : kNan);
    }
    return sums;
}

}  // namespace gearpod::analysis
