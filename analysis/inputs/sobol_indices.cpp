#include "analysis/inputs/sobol_indices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/inputs/polynomial_surrogate.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/midranks.hpp"

namespace gearpod::analysis {
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
        const std::vector<double> own = midranks(column);
        const Eigen::VectorXd all =
            Eigen::Map<const Eigen::VectorXd>(own.data(), static_cast<Eigen::Index>(own.size()));
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

}  // namespace gearpod::analysis
