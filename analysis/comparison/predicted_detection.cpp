#include "analysis/comparison/predicted_detection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/reliability.hpp"
#include "machine/team.hpp"

namespace gearpod::analysis {
namespace {

constexpr int kResamples = 39;  // their least and largest are the 2.5 and 97.5 % points

// Line through the changed values of some pairs, with its residuals.
class Line {
  public:
    Line(const std::vector<ValuePair>& pairs, bool by_size)
        : known_(pairs.size(), by_size ? 3 : 2), changed_(pairs.size()) {
        for (Eigen::Index i = 0; i < known_.rows(); ++i) {
            const ValuePair& pair = pairs[static_cast<std::size_t>(i)];
            known_.row(i).head(2) << 1.0, pair.own;
            if (by_size) {
                known_(i, 2) = pair.size;
            }
            changed_[i] = pair.changed;
        }
        fit();
        residuals_ = (changed_ - known_ * terms_) *
                     std::sqrt(static_cast<double>(known_.rows()) /
                               static_cast<double>(known_.rows() - known_.cols()));
    }

    // The line through other values at the same pairs: its own with residuals drawn anew.
    Line resampled(std::mt19937_64& engine) const {
        Line other = *this;
        for (Eigen::Index i = 0; i < known_.rows(); ++i) {
            other.changed_[i] = known_.row(i).dot(terms_) + residual(engine);
        }
        other.fit();
        return other;
    }

    double predict(double own, double size, std::mt19937_64& engine) const {
        return terms_[0] + terms_[1] * own + (terms_.size() > 2 ? terms_[2] * size : 0.0) +
               residual(engine);
    }

  private:
    void fit() { terms_ = known_.colPivHouseholderQr().solve(changed_); }
    double residual(std::mt19937_64& engine) const {
        const auto count = static_cast<std::size_t>(residuals_.size());
        return residuals_[static_cast<Eigen::Index>(uniform_index(engine, count))];
    }

    Eigen::MatrixXd known_;
    Eigen::VectorXd changed_, terms_, residuals_;
};

// Size found, and rate of the largest size group.
struct Found {
    double size, pd;
};

Found found_in(const FeatureValues& values, const DetectionRequest& request) {
    const std::vector<double> none(values.healthy.size(), 0.0);
    const FeatureDetection detection =
        detect("", values.alarm, {none, values.healthy, values.gearbox},
               {values.test_size, values.test}, request);
    const LevelDetection& rates = detection.levels.front();
    const std::vector<int> hit = outcomes(values.test, rates.threshold, values.alarm);
    LevelReliability level;
    level.hit_miss = pod_of_outcomes(values.test_size, hit, rates, request.confidence, 2);
    level.demonstrated_size =
        demonstrated_size(rates, values.test_size, hit, kReliablePd, request.confidence);
    const auto fault = own_smallest_fault("", level);
    return {fault ? fault->size : std::numeric_limits<double>::infinity(),
            rates.cells.empty() ? kNan : rates.cells.back().pd};
}

// `values`: logarithms of the feature if `logarithm`.
Found found_in_resample(const FeatureValues& values, const Line& healthy, const Line& faulty,
                        bool logarithm, const DetectionRequest& request, std::size_t resample) {
    std::mt19937_64 engine(resample);
    const Line healthy_line = healthy.resampled(engine), faulty_line = faulty.resampled(engine);
    const auto predicted = [&](double own, double size) {
        const Line& line = size > 0.0 ? faulty_line : healthy_line;
        const double value = line.predict(own, size, engine);
        return logarithm ? std::exp(value) : value;
    };
    std::vector<double> sample, test;
    for (const double value : values.healthy) {
        sample.push_back(predicted(value, 0.0));
    }
    for (std::size_t i = 0; i < values.test.size(); ++i) {
        test.push_back(predicted(values.test[i], values.test_size[i]));
    }
    return found_in({values.alarm, sample, values.gearbox, values.test_size, test}, request);
}

}  // namespace

PredictedDetection detection_as_is(const FeatureValues& values, const DetectionRequest& request) {
    const auto [size, pd] = found_in(values, request);
    return {size, size, size, pd, pd, pd};
}

PredictedDetection predicted_detection(const FeatureValues& values,
                                       std::span<const ValuePair> pairs,
                                       const DetectionRequest& request, int threads) {
    const auto positive = [](double value) { return !(value <= 0.0); };
    const bool logarithm = std::ranges::all_of(values.healthy, positive) &&
                           std::ranges::all_of(values.test, positive) &&
                           std::ranges::all_of(pairs, [&](const ValuePair& pair) {
                               return positive(pair.own) && positive(pair.changed);
                           });
    std::vector<ValuePair> healthy, faulty;
    for (ValuePair pair : pairs) {
        if (logarithm) {
            pair.own = std::log(pair.own);
            pair.changed = std::log(pair.changed);
        }
        if (std::isfinite(pair.own) && std::isfinite(pair.changed)) {
            (pair.size > 0.0 ? faulty : healthy).push_back(pair);
        }
    }
    if (healthy.size() < 4 || faulty.size() < 5) {
        return {};
    }
    std::vector<double> sample(values.healthy.begin(), values.healthy.end()),
        test(values.test.begin(), values.test.end());
    for (std::vector<double>* const known : {&sample, &test}) {
        for (double& value : *known) {
            value = logarithm ? std::log(value) : value;
        }
    }
    const FeatureValues own{values.alarm, sample, values.gearbox, values.test_size, test};
    const Line healthy_line(healthy, false), faulty_line(faulty, true);
    std::vector<double> sizes(kResamples), rates(kResamples);
    machine::for_each_index(kResamples, threads, [&](std::size_t r) {
        const Found found =
            found_in_resample(own, healthy_line, faulty_line, logarithm, request, r);
        sizes[r] = found.size;
        rates[r] = found.pd;
    });
    std::ranges::sort(sizes);
    std::ranges::sort(rates);
    return {sizes[kResamples / 2], sizes.front(), sizes.back(),
            rates[kResamples / 2], rates.front(), rates.back()};
}

}  // namespace gearpod::analysis
