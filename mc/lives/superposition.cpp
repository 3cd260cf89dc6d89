#include "mc/lives/superposition.hpp"

#include <algorithm>
#include <cmath>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

constexpr double kPolynomialReach = 2.5;  // standard deviations
// Where the error of linear interpolation between -1.5 and 1.5 is as large as in the middle, for a
// quadratic function.
constexpr double kExtrapolated = 2.1213203435596424;

void add(std::span<const double> values, double factor, std::vector<double>& sum) {
    if (factor == 0.0 || values.empty()) {
        return;
    }
    sum.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum[i] += factor * values[i];
    }
}

}  // namespace

std::vector<double> interpolation_weights(const std::vector<double>& integrated, double factor) {
    if (integrated.size() == 1) {
        return {1.0};
    }
    const auto above = std::upper_bound(integrated.begin() + 1, integrated.end() - 1, factor);
    const auto i = static_cast<std::size_t>(above - integrated.begin());
    std::vector<double> shares(integrated.size(), 0.0);
    shares[i] = (factor - integrated[i - 1]) / (integrated[i] - integrated[i - 1]);
    shares[i - 1] = 1.0 - shares[i];
    return shares;
}

std::vector<double> leja_nodes(int count) {
    constexpr int kGrid = 4000;
    std::vector<double> nodes{0.0, 1.0, -1.0};
    while (static_cast<int>(nodes.size()) < count) {
        double best = 0.0, largest = 0.0;
        for (int i = 1; i < kGrid; ++i) {
            const double x = static_cast<double>(i) / kGrid;
            double product = 1.0;
            for (const double node : nodes) {
                product *= 2.0 * std::abs(x - node);
            }
            if (product > largest) {
                largest = product;
                best = x;
            }
        }
        nodes.insert(nodes.end(), {best, -best});
    }
    nodes.resize(static_cast<std::size_t>(count));
    return nodes;
}

LoadAxis::LoadAxis(const RecordDistribution& distribution, const LoadNumber& number) {
    if (!distribution.varies()) {
        factors_ = between_ = {1.0};
        return;
    }
    factors_ = distribution.distinct_factors();
    if (!factors_.empty()) {
        between_ = {factors_[factors_.size() / 2]};
        return;
    }
    const double low = distribution.factor(-kPolynomialReach),
                 high = distribution.factor(kPolynomialReach);
    if (!number.nodes || !(low < high)) {
        factors_ = distribution.integrated_factors();
        checks_ = between_ = {distribution.factor(0.0)};
        checks_.insert(checks_.end(),
                       {distribution.factor(-kExtrapolated), distribution.factor(kExtrapolated)});
        return;
    }
    const std::vector<double> sequence = leja_nodes(*number.nodes + 2);
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const double factor = 0.5 * (low + high) + 0.5 * (high - low) * sequence[i];
        (i < static_cast<std::size_t>(*number.nodes) ? factors_ : checks_).push_back(factor);
    }
    std::ranges::sort(factors_);
    for (std::size_t i = 0; i + 1 < factors_.size(); ++i) {
        between_.push_back(0.5 * (factors_[i] + factors_[i + 1]));
    }
    for (const double node : factors_) {
        double weight = 1.0;
        for (const double other : factors_) {
            weight *= other == node ? 1.0 : 0.25 * (high - low) / (node - other);
        }
        barycentric_.push_back(weight);
    }
}

// Derivative of the polynomial at one of its nodes (Berrut and Trefethen, SIAM Rev. 46 (2004),
// equations 9.4 and 9.5).
std::vector<double> LoadAxis::derivative_weights(std::size_t node) const {
    std::vector<double> all(factors_.size(), 0.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i != node) {
            all[i] = barycentric_[i] / barycentric_[node] / (factors_[node] - factors_[i]);
            all[node] -= all[i];
        }
    }
    return all;
}

std::vector<double> LoadAxis::weights(double factor) const {
    if (barycentric_.empty()) {
        return interpolation_weights(factors_, factor);
    }
    const std::size_t end = factor < factors_.front() ? 0 : factors_.size() - 1;
    if (factor < factors_.front() || factor > factors_.back()) {
        std::vector<double> all = derivative_weights(end);
        for (double& weight : all) {
            weight *= factor - factors_[end];
        }
        all[end] += 1.0;
        return all;
    }
    std::vector<double> all(factors_.size(), 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (factor == factors_[i]) {
            std::ranges::fill(all, 0.0);
            all[i] = 1.0;
            return all;
        }
        all[i] = barycentric_[i] / (factor - factors_[i]);
        sum += all[i];
    }
    for (double& weight : all) {
        weight /= sum;
    }
    return all;
}

SuperposedSignals::SuperposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins,
                                     bool folds)
    : bins_(bins), count_(basis.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
        samples_.emplace_back(basis[k]->sensor);
        te_turns_.push_back(basis[k]->te_turn);
        for (std::size_t l = k; folds && l < count_; ++l) {
            products_.push_back(
                signals::fold_of_products(basis[k]->sensor, basis[l]->sensor, bins));
        }
    }
}

LaneSignals SuperposedSignals::at(std::span<const double> coefficients) const {
    LaneSignals sum;
    sum.folded.assign(products_.empty() ? 0 : bins_, 0.0);
    std::size_t product = 0;
    for (std::size_t k = 0; k < count_; ++k) {
        add(te_turns_[k], coefficients[k], sum.te_turn);
        for (std::size_t l = k; product < products_.size() && l < count_; ++l, ++product) {
            const double twice = k == l ? 1.0 : 2.0;
            add(products_[product], twice * coefficients[k] * coefficients[l], sum.folded);
        }
    }
    // The sum of squares may become negative by rounding.
    for (double& value : sum.folded) {
        value = std::max(0.0, value);
    }
    return sum;
}

// The turns continue periodically.
std::vector<double> SuperposedSignals::turn(std::span<const double> coefficients,
                                            std::size_t number) const {
    const std::size_t begin = number % (samples_.front().size() / bins_) * bins_;
    std::vector<double> sum(bins_, 0.0);
    for (std::size_t k = 0; k < count_; ++k) {
        add(samples_[k].subspan(begin, bins_), coefficients[k], sum);
    }
    return sum;
}

void SuperposedSignals::add_turns(std::span<const double> coefficients, std::size_t first,
                                  std::size_t turns, std::vector<double>& folded) const {
    folded.resize(bins_, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        for (std::size_t b = 0; b < bins_; ++b) {
            folded[b] += one[b] * one[b];
        }
    }
}

void SuperposedSignals::append_turns(std::span<const double> coefficients, std::size_t first,
                                     std::size_t turns, std::vector<double>& samples) const {
    samples.reserve(samples.size() + turns * bins_);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        samples.insert(samples.end(), one.begin(), one.end());
    }
}

}  // namespace gearpod::mc
