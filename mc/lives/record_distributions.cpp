#include "mc/lives/record_distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics/distributions.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr double kReach = 1.5;  // standard deviations

double nominal_of(const Study& study, const RandomInput& input) {
    const Key& key = *find_key(input.key);
    return std::get<NumberAccess>(key.access).get(study).value() / key.unit.to_si;
}

double normal_density(double z) {
    return std::isinf(z) ? 0.0 : std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

// Means of a normal number over equally probable parts of its range, with a spread of 1.
std::vector<double> means_of_parts(int parts) {
    std::vector<double> means;
    double square = 0.0, before = 0.0;
    for (int i = 1; i <= parts; ++i) {
        const double here =
            i < parts ? normal_density(analysis::normal_quantile(static_cast<double>(i) / parts))
                      : 0.0;
        means.push_back(parts * (before - here));
        square += means.back() * means.back() / parts;
        before = here;
    }
    for (double& mean : means) {
        mean /= std::sqrt(square);
    }
    return means;
}

}  // namespace

RecordDistribution::RecordDistribution(const Study& study, RecordQuantity quantity, double scatter,
                                       std::optional<int> distinct)
    : scatter_(scatter) {
    if (distinct) {
        distinct_ = means_of_parts(*distinct);
    }
    for (const RandomInput& input : study.random) {
        if (input.distribution.per_record() && input.quantity == quantity) {
            input_ = input;
            input_->distribution = input.distribution.in_unit_of_file();
            nominal_ = nominal_of(study, input);
        }
    }
}

double RecordDistribution::factor(double unit) const {
    if (distinct_.empty()) {
        return factor_of(unit);
    }
    const auto parts = static_cast<double>(distinct_.size());
    const double part = std::min(std::floor(parts * analysis::normal_cdf(unit)), parts - 1.0);
    return factor_of(distinct_[static_cast<std::size_t>(part)]);
}

std::vector<double> RecordDistribution::distinct_factors() const {
    std::vector<double> all;
    for (const double unit : distinct_) {
        const double next = factor_of(unit);
        if (all.empty() || next > all.back()) {
            all.push_back(next);
        }
    }
    return all;
}

double RecordDistribution::factor_of(double unit) const {
    if (!input_) {
        return std::exp(scatter_ * unit);
    }
    const double share = analysis::normal_cdf(unit);
    return input_->distribution.quantile(share) / nominal_;
}

double RecordDistribution::rms() const {
    if (!input_) {
        return std::exp(scatter_ * scatter_);
    }
    constexpr int kShares = 999;
    double sum = 0.0;
    for (int i = 0; i < kShares; ++i) {
        const double value = input_->distribution.quantile((i + 0.5) / kShares) / nominal_;
        sum += value * value / kShares;
    }
    return std::sqrt(sum);
}

std::vector<double> RecordDistribution::integrated_factors(int count) const {
    if (!varies()) {
        return {1.0};
    }
    std::vector<double> all;
    for (int i = 0; i < count; ++i) {
        const double next = factor(-kReach + 2.0 * kReach * i / (count - 1));
        if (all.empty() || next > all.back()) {
            all.push_back(next);
        }
    }
    if (all.size() > 1) {
        return all;
    }
    // The evenly spaced quantiles of a discrete distribution may coincide; then its limits are
    // used.
    const Support support = input_ ? input_->distribution.support() : Support{1.0, 1.0};
    return support.low < support.high
               ? std::vector<double>{support.low / nominal_, support.high / nominal_}
               : all;
}

std::vector<double> RecordDistribution::factors_between(int count) const {
    std::vector<double> all;
    for (int i = 0; i + 1 < count; ++i) {
        all.push_back(factor(-kReach + kReach * (2.0 * i + 1.0) / (count - 1)));
    }
    return all;
}

std::string RecordDistribution::text() const {
    if (input_) {
        return fmt::format("{} = {}", input_->key, input_->distribution.toml());
    }
    return scatter_ > 0.0
               ? fmt::format("varies by {:g} % (rms) about the gearbox's value", 100.0 * scatter_)
               : "the gearbox's";
}

RecordDistributions::RecordDistributions(const Study& study)
    : torque(study, RecordQuantity::torque, study.life.torque_scatter, study.life.distinct_torques),
      speed(study, RecordQuantity::speed, study.life.speed_scatter, study.life.distinct_speeds),
      gain(study, RecordQuantity::gain, study.life.gain_scatter),
      noise(study, RecordQuantity::noise, study.life.noise_scatter),
      sensor_noise_only(std::ranges::any_of(study.random, [](const RandomInput& input) {
          return input.distribution.per_record() && input.quantity == RecordQuantity::noise;
      })) {}

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

Study study_of_gearboxes(const Study& study) {
    Study all = study;
    std::erase_if(all.random,
                  [](const RandomInput& input) { return input.distribution.per_record(); });
    return all;
}

namespace {

constexpr double kPolynomialReach = 2.5;  // standard deviations
// Where the error of linear interpolation between -1.5 and 1.5 is as large as in the middle, for a
// quadratic function.
constexpr double kExtrapolated = 2.1213203435596424;

}  // namespace

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

LoadAxis::LoadAxis(const RecordDistribution& distribution, int evenly_spaced,
                   std::optional<int> nodes) {
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
    if (!nodes || !(low < high)) {
        factors_ = distribution.integrated_factors(evenly_spaced);
        checks_ = between_ = distribution.factors_between(evenly_spaced);
        checks_.insert(checks_.end(),
                       {distribution.factor(-kExtrapolated), distribution.factor(kExtrapolated)});
        return;
    }
    const std::vector<double> sequence = leja_nodes(*nodes + 2);
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const double factor = 0.5 * (low + high) + 0.5 * (high - low) * sequence[i];
        (i < static_cast<std::size_t>(*nodes) ? factors_ : checks_).push_back(factor);
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

}  // namespace gearpod::mc
