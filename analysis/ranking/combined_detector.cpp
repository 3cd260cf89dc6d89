#include "analysis/ranking/combined_detector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/ranking/feature_ranking.hpp"
#include "analysis/statistics/binary_regression.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kRidge = 1.0;
constexpr long kFewestTraining = 50;
constexpr int kCombinedBandPoints = 5;

// Row indices of one half of the gearboxes, in the threshold sample and among the test gearboxes.
struct Half {
    std::vector<std::size_t> healthy, test;
};

Half half_of(std::size_t healthy, std::size_t test, bool training) {
    Half half;
    const auto pick = [training](std::size_t count, std::vector<std::size_t>& rows) {
        for (std::size_t i = 0; i < count; ++i) {
            if (in_training_half(i) == training) {
                rows.push_back(i);
            }
        }
    };
    pick(healthy, half.healthy);
    pick(test, half.test);
    return half;
}

std::vector<double> picked(std::span<const double> values, const std::vector<std::size_t>& rows) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        out.push_back(values[row]);
    }
    return out;
}

// Values of one feature for a half, healthy gearboxes first, then test gearboxes.
std::vector<double> values_of(const CombinedFeature& feature, const Half& half) {
    std::vector<double> values = picked(feature.healthy, half.healthy);
    const std::vector<double> test = picked(feature.test, half.test);
    values.insert(values.end(), test.begin(), test.end());
    return values;
}

// One feature as a covariate of the regression.
struct Covariate {
    const CombinedFeature* feature = nullptr;
    std::vector<double> healthy;  // of the training half, ascending
    double centre = 0.0, spread = 1.0;

    // Scaled normal score; NaN where there is no value.
    double scaled(double value) const {
        if (!std::isfinite(value)) {
            return kNan;
        }
        const auto [first, last] = std::equal_range(healthy.begin(), healthy.end(), value);
        const double rank =
            0.5 * static_cast<double>((first - healthy.begin()) + (last - healthy.begin()));
        const double share = (rank + 0.5) / (static_cast<double>(healthy.size()) + 1.0);
        return (link_quantile(Link::probit, share) - centre) / spread;
    }
};

// Fits the scaling; returns the reason why the feature cannot be used, or "".
std::string fit_covariate(Covariate& covariate, const Half& half,
                          std::span<const double> test_size) {
    std::vector<double> values = values_of(*covariate.feature, half);
    const std::size_t all = values.size();
    for (std::size_t i = 0; i < all; ++i) {
        const bool healthy =
            i < half.healthy.size() || test_size[half.test[i - half.healthy.size()]] <= 0.0;
        if (healthy && std::isfinite(values[i])) {
            covariate.healthy.push_back(values[i]);
        }
    }
    std::sort(covariate.healthy.begin(), covariate.healthy.end());
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    const std::size_t missing = all - values.size();
    if (values.empty() || static_cast<double>(missing) > kMostMissing * static_cast<double>(all)) {
        return fmt::format("no value for {} of {} training gearboxes", missing, all);
    }
    const auto count = static_cast<double>(values.size());
    double mean = 0.0, square = 0.0;
    for (double& value : values) {
        value = covariate.scaled(value);
        mean += value / count;
    }
    for (const double value : values) {
        square += (value - mean) * (value - mean) / count;
    }
    if (!(square > 1e-20)) {
        return "constant";
    }
    covariate.centre = mean;
    covariate.spread = std::sqrt(square);
    return "";
}

std::string sample_refusal(long healthy, long faulty) {
    return std::min(healthy, faulty) >= kFewestTraining
               ? ""
               : fmt::format("{} healthy and {} faulty training gearboxes, {} of each are needed",
                             healthy, faulty, kFewestTraining);
}

// Design matrix and outcomes of the training gearboxes that have a value of every feature.
struct Training {
    Eigen::MatrixXd design;
    std::vector<char> faulty;
};

Training training_of(const std::vector<Covariate>& covariates, const Half& half,
                     std::span<const double> test_size) {
    std::vector<std::vector<double>> columns;
    for (const Covariate& covariate : covariates) {
        columns.push_back(values_of(*covariate.feature, half));
        for (double& value : columns.back()) {
            value = covariate.scaled(value);
        }
    }
    std::vector<std::size_t> rows;
    Training training;
    const std::size_t healthy = half.healthy.size();
    for (std::size_t i = 0; i < healthy + half.test.size(); ++i) {
        if (std::all_of(columns.begin(), columns.end(),
                        [i](const auto& column) { return !std::isnan(column[i]); })) {
            rows.push_back(i);
            const bool faulty = i >= healthy && test_size[half.test[i - healthy]] > 0.0;
            training.faulty.push_back(faulty ? 1 : 0);
        }
    }
    training.design.resize(static_cast<Eigen::Index>(rows.size()),
                           static_cast<Eigen::Index>(columns.size()) + 1);
    for (Eigen::Index i = 0; i < training.design.rows(); ++i) {
        training.design(i, 0) = 1.0;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            training.design(i, static_cast<Eigen::Index>(c) + 1) =
                columns[c][rows[static_cast<std::size_t>(i)]];
        }
    }
    return training;
}

// Log odds of a fault for the held-out gearboxes; NaN without a value of every feature.
std::vector<double> scores(const std::vector<Covariate>& covariates, const Eigen::VectorXd& b,
                           std::span<const double> CombinedFeature::*group,
                           const std::vector<std::size_t>& rows) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        double score = b[0];
        for (std::size_t c = 0; c < covariates.size(); ++c) {
            score += b[static_cast<Eigen::Index>(c) + 1] *
                     covariates[c].scaled((covariates[c].feature->*group)[row]);
        }
        out.push_back(score);
    }
    return out;
}

// Usable feature with the largest area on the training half.
const CombinedFeature* best_single(const std::vector<Covariate>& covariates, const Half& half,
                                   std::span<const double> test_size, double confidence) {
    const CombinedFeature* best = nullptr;
    double largest = -1.0;
    for (const Covariate& covariate : covariates) {
        const CombinedFeature& feature = *covariate.feature;
        std::vector<double> healthy = picked(feature.healthy, half.healthy), faulty;
        for (const std::size_t row : half.test) {
            (test_size[row] > 0.0 ? faulty : healthy).push_back(feature.test[row]);
        }
        const double area = auc(healthy, faulty, feature.alarm == Alarm::high, confidence).auc;
        if (area > largest) {
            largest = area;
            best = &feature;
        }
    }
    return best;
}

struct HeldOut {
    std::vector<double> healthy_size, test_size;
    std::vector<double> healthy, test;  // values
    Alarm alarm = Alarm::high;
};

HeldOutDetector grade(const std::string& name, const HeldOut& held, const DetectionRequest& request,
                      std::vector<std::string>* warnings) {
    HeldOutDetector detector;
    detector.name = name;
    FeatureDetection detection = detect(name, held.alarm, {held.healthy_size, held.healthy},
                                        {held.test_size, held.test}, request);
    detector.detection = detection.levels.front();
    if (warnings != nullptr) {
        *warnings = detection.warnings;
    }
    const auto hit = outcomes(held.test, detector.detection.threshold, held.alarm);
    detector.pod = pod_of_outcomes(held.test_size, hit, detector.detection, request.confidence,
                                   kCombinedBandPoints);
    return detector;
}

// Computes areas over the held-out gearboxes that have both values, and their paired test.
void compare(CombinedDetector& result, const HeldOut& combined, const HeldOut& single,
             double confidence) {
    std::vector<RankedFeature> pair;
    std::vector<double> healthy[2], faulty[2];
    const HeldOut* held[] = {&combined, &single};
    for (int d = 0; d < 2; ++d) {
        healthy[d] = held[d]->healthy;
        for (std::size_t i = 0; i < held[d]->test.size(); ++i) {
            (combined.test_size[i] > 0.0 ? faulty : healthy)[d].push_back(held[d]->test[i]);
        }
        // Numbers as names, because a feature might have the same name as the combined detector.
        pair.push_back({d == 0 ? "0" : "1", held[d]->alarm, healthy[d], faulty[d]});
    }
    const FeatureRanking ranking = rank_features(pair, confidence);
    if (ranking.ranks.size() != 2) {
        result.refusal = ranking.refusal.empty() ? ranking.left_out.front() : ranking.refusal;
        return;
    }
    for (const FeatureRank& rank : ranking.ranks) {
        (rank.name == "0" ? result.combined : result.single).auc = rank.auc;
    }
    result.p_value = ranking.ranks[0].p_values[1];
}

}  // namespace

bool in_training_half(std::size_t instance) {
    // Mixing function of splitmix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014, 453-472.
    std::uint64_t z = static_cast<std::uint64_t>(instance) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return ((z ^ (z >> 31)) & 1u) != 0;
}

CombinedDetector combine_features(const std::vector<CombinedFeature>& features,
                                  std::span<const double> healthy_size,
                                  std::span<const double> test_size,
                                  const DetectionRequest& request) {
    EXPECTS(request.noise_levels.size() == 1);
    CombinedDetector result;
    result.noise_level = request.noise_levels.front();
    const Half training_half = half_of(healthy_size.size(), test_size.size(), true);
    const Half held_out_half = half_of(healthy_size.size(), test_size.size(), false);
    const long faulty = std::count_if(training_half.test.begin(), training_half.test.end(),
                                      [&](std::size_t row) { return test_size[row] > 0.0; });
    const auto all = static_cast<long>(training_half.healthy.size() + training_half.test.size());
    result.refusal = sample_refusal(all - faulty, faulty);
    if (!result.refusal.empty()) {
        return result;
    }
    std::vector<Covariate> covariates;
    for (const CombinedFeature& feature : features) {
        Covariate covariate{&feature, {}, 0.0, 1.0};
        if (const std::string reason = fit_covariate(covariate, training_half, test_size);
            reason.empty()) {
            covariates.push_back(std::move(covariate));
        } else {
            result.left_out.push_back(feature.name + ": " + reason);
        }
    }
    if (covariates.size() < 2) {
        result.refusal = fmt::format("{} usable feature{}, two are needed", covariates.size(),
                                     covariates.size() == 1 ? "" : "s");
        return result;
    }
    const Training training = training_of(covariates, training_half, test_size);
    result.trained_faulty = std::count(training.faulty.begin(), training.faulty.end(), 1);
    result.trained_healthy = static_cast<long>(training.faulty.size()) - result.trained_faulty;
    result.refusal = sample_refusal(result.trained_healthy, result.trained_faulty);
    if (!result.refusal.empty()) {
        return result;
    }
    const BinaryFit fit =
        fit_binary(training.design, training.faulty, {Link::logit, 0.0, 1.0, kRidge});
    if (!fit.refusal.empty()) {
        result.refusal = fit.refusal;
        return result;
    }
    result.intercept = fit.coefficients[0];
    for (std::size_t c = 0; c < covariates.size(); ++c) {
        result.weights.push_back(
            {covariates[c].feature->name, fit.coefficients[static_cast<Eigen::Index>(c) + 1]});
    }
    HeldOut combined{
        picked(healthy_size, held_out_half.healthy), picked(test_size, held_out_half.test),
        scores(covariates, fit.coefficients, &CombinedFeature::healthy, held_out_half.healthy),
        scores(covariates, fit.coefficients, &CombinedFeature::test, held_out_half.test),
        Alarm::high};
    const CombinedFeature* best =
        best_single(covariates, training_half, test_size, request.confidence);
    HeldOut single = combined;
    single.healthy = picked(best->healthy, held_out_half.healthy);
    single.test = picked(best->test, held_out_half.test);
    single.alarm = best->alarm;
    result.combined = grade("combined", combined, request, &result.warnings);
    result.single = grade(best->name, single, request, nullptr);
    compare(result, combined, single, request.confidence);
    return result;
}

}  // namespace gearpod::analysis
