// Members of detection statistics in messages between ranks (messages.hpp). A structured binding
// names every member, so a new one does not compile until it is sent too.
#pragma once

#include <stdexcept>

#include "mc/ensemble/messages.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace Eigen {

template <class Archive, class Scalar, int rows, int columns>
void serialize(Archive& archive, Matrix<Scalar, rows, columns>& matrix) {
    Index height = matrix.rows(), width = matrix.cols();
    archive(height, width);
    matrix.resize(height, width);
    archive(cereal::binary_data(matrix.data(),
                                static_cast<std::size_t>(matrix.size()) * sizeof(Scalar)));
}

}  // namespace Eigen

namespace gearpod::analysis {

using gearpod::serialize;

// Only inspections have fits by maximum likelihood and calibrated bounds, and no rank sends them.
template <class Archive, class Pointer>
void require_empty(Archive&, const Pointer& pointer) {
    if (pointer) {
        throw std::logic_error("statistics of inspections cannot be sent to another rank");
    }
}

template <class Archive>
void serialize(Archive& archive, TailThreshold& threshold) {
    auto& [extrapolation, choices, steady] = threshold;
    archive(extrapolation, choices, steady);
}

template <class Archive>
void serialize(Archive& archive, LevelDetection& level) {
    auto& [noise_level, threshold, sample, alarms, tail, importance_sampled, cells, threshold_rate,
           healthy_rate, healthy_rate_bounds, expected_rate, healthy_median] = level;
    archive(noise_level, threshold, sample, alarms, tail, importance_sampled, cells, threshold_rate,
            healthy_rate, healthy_rate_bounds, expected_rate, healthy_median);
}

template <class Archive>
void serialize(Archive& archive, FeatureDetection& detection) {
    auto& [feature, alarm, levels, warnings] = detection;
    archive(feature, alarm, levels, warnings);
}

template <class Archive>
void serialize(Archive& archive, HitMissFit& fit) {
    auto& [curve, log_likelihood, aic, goodness, refusal] = fit;
    archive(curve, log_likelihood, aic, goodness, refusal);
}

template <class Archive>
void serialize(Archive& archive, HitMissPod& pod) {
    auto& [tests, hits, smallest, largest, refusal, chosen, candidates, supported, a50, a90, band,
           doubtful, rule, clusters, design_effect, simulated_coverage, covariance,
           specimens_factor] = pod;
    archive(tests, hits, smallest, largest, refusal, chosen, candidates, supported, a50, a90, band,
            doubtful, rule, clusters, design_effect, simulated_coverage, covariance,
            specimens_factor);
}

template <class Archive>
void serialize(Archive& archive, CheckResult& check) {
    auto& [test, statistic, p_value] = check;
    archive(test, statistic, p_value);
}

template <class Archive>
void serialize(Archive& archive, ResponseModel& model) {
    auto& [intercept, slope, sigma, between, within, covariance] = model;
    archive(intercept, slope, sigma, between, within, covariance);
}

template <class Archive>
void serialize(Archive& archive, ResponseLikelihood::Maximum& maximum) {
    auto& [parameters, information, log_likelihood, converged] = maximum;
    archive(parameters, information, log_likelihood, converged);
}

template <class Archive>
void serialize(Archive& archive, SignalResponseFit& fit) {
    auto& [scale, line, model, log_likelihood, aic, checks, refusals, doubts, likelihood, maximum] =
        fit;
    require_empty(archive, likelihood);
    archive(scale, line, model, log_likelihood, aic, checks, refusals, doubts, maximum);
}

template <class Archive>
void serialize(Archive& archive, LocationScale& curve) {
    auto& [location, scale, covariance] = curve;
    archive(location, scale, covariance);
}

template <class Archive>
void serialize(Archive& archive, SignalResponsePod& pod) {
    auto& [count, left, right, specimens, refusal, candidates, chosen, supported, curve, rule,
           limits, simulated_coverage, growing_coverage, growing_answered, a50, a90, band,
           specimens_factor] = pod;
    require_empty(archive, limits);
    archive(count, left, right, specimens, refusal, candidates, chosen, supported, curve, rule,
            simulated_coverage, growing_coverage, growing_answered, a50, a90, band,
            specimens_factor);
}

template <class Archive>
void serialize(Archive& archive, InputInfluence& influence) {
    auto& [name, unit, larger_in_misses, bounds, p_value] = influence;
    archive(name, unit, larger_in_misses, bounds, p_value);
}

template <class Archive>
void serialize(Archive& archive, MissSensitivity& sensitivity) {
    auto& [misses, hits, smallest, largest, inputs, left_out, refusal] = sensitivity;
    archive(misses, hits, smallest, largest, inputs, left_out, refusal);
}

template <class Archive>
void serialize(Archive& archive, InputEffect& effect) {
    auto& [name, unit, bins, statistic, degrees, p_value, values, a90, refusal] = effect;
    archive(name, unit, bins, statistic, degrees, p_value, values, a90, refusal);
}

template <class Archive>
void serialize(Archive& archive, InputEffects& effects) {
    auto& [smallest, largest, inputs, left_out] = effects;
    archive(smallest, largest, inputs, left_out);
}

template <class Archive>
void serialize(Archive& archive, EpistemicBand& epistemic) {
    auto& [inputs, low, high, band, refusal] = epistemic;
    archive(inputs, low, high, band, refusal);
}

template <class Archive>
void serialize(Archive& archive, FalseAlarmCurve& curve) {
    auto& [points, unfitted, refusal] = curve;
    archive(points, unfitted, refusal);
}

template <class Archive>
void serialize(Archive& archive, LevelReliability& level) {
    auto& [noise_level, has_threshold, hit_miss, signal_response, auc, auc_by_size, roc, misses,
           inputs, uncertain, pd, by_rate, least_cost, demonstrated_size] = level;
    archive(noise_level, has_threshold, hit_miss, signal_response, auc, auc_by_size, roc, misses,
            inputs, uncertain, pd, by_rate, least_cost, demonstrated_size);
}

}  // namespace gearpod::analysis

namespace gearpod::mc {

template <class Archive>
void serialize(Archive& archive, ResultColumns& columns) {
    auto& [parameters, features, rows] = columns;
    archive(parameters, features, rows);
}

template <class Archive>
void serialize(Archive& archive, AssessedColumns& columns) {
    auto& [healthy, graded, repeats, healthy_gearbox, record_gearbox] = columns;
    archive(healthy, graded, repeats, healthy_gearbox, record_gearbox);
}

}  // namespace gearpod::mc
