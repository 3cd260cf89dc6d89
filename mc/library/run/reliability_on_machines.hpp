// Members of detection statistics in messages between ranks (messages.hpp).
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "analysis/reliability.hpp"
#include "mc/ensemble/messages.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

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

GEARPOD_SEND(TailThreshold, extrapolation, choices, steady)
GEARPOD_SEND(LevelDetection, noise_level, threshold, sample, alarms, tail, importance_sampled,
             cells, threshold_rate, healthy_rate, healthy_rate_bounds, expected_rate,
             healthy_median)
GEARPOD_SEND(FeatureDetection, feature, alarm, levels, warnings)
GEARPOD_SEND(HitMissFit, curve, log_likelihood, aic, goodness, refusal)
GEARPOD_SEND(HitMissPod, tests, hits, smallest, largest, refusal, chosen, candidates, supported,
             a50, a90, band, doubtful, rule, clusters, design_effect, simulated_coverage,
             covariance, specimens_factor)
GEARPOD_SEND(CheckResult, test, statistic, p_value)
GEARPOD_SEND(ResponseModel, intercept, slope, sigma, between, within, covariance)
GEARPOD_SEND(ResponseLikelihood::Maximum, parameters, information, log_likelihood, converged)

template <class Archive>
void serialize(Archive& archive, SignalResponseFit& fit) {
    auto& [scale, line, model, log_likelihood, aic, checks, refusals, doubts, likelihood, maximum] =
        fit;
    require_empty(archive, likelihood);
    archive(scale, line, model, log_likelihood, aic, checks, refusals, doubts, maximum);
}

GEARPOD_SEND(LocationScale, location, scale, covariance)

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

GEARPOD_SEND(InputInfluence, name, unit, larger_in_misses, bounds, p_value)
GEARPOD_SEND(MissSensitivity, misses, hits, smallest, largest, inputs, left_out, refusal)
GEARPOD_SEND(InputEffect, name, unit, bins, statistic, degrees, p_value, values, a90, refusal)
GEARPOD_SEND(InputEffects, smallest, largest, inputs, left_out)
GEARPOD_SEND(EpistemicBand, inputs, low, high, band, refusal)
GEARPOD_SEND(FalseAlarmCurve, points, unfitted, refusal)
GEARPOD_SEND(LevelReliability, noise_level, has_threshold, hit_miss, signal_response, auc,
             auc_by_size, roc, misses, inputs, uncertain, pd, by_rate, least_cost,
             demonstrated_size)

}  // namespace gearpod::analysis

namespace gearpod::mc {

GEARPOD_SEND(ResultColumns, parameters, features, rows)
GEARPOD_SEND(AssessedColumns, healthy, test, repeats, healthy_gearbox, record_gearbox)

// Assesses the features of a run on all its machines. The first rank of each machine evaluates a
// share of the pairs of a feature and a noise level, on the processors of the machine's ranks,
// which are idle after the last batch.

// Called by rank 0 while the other ranks are in assess_for_leader(). Result and errors as in
// reliability_of(), whatever the number of machines. A share that another machine could not
// evaluate is evaluated here.
std::optional<analysis::Reliability> reliability_on_machines(const Results& frame,
                                                             const RowSource& rows,
                                                             const Ranks& ranks, int threads);

// Evaluates shares until rank 0 broadcasts something else (Ranks::from_leader), and returns that.
std::string assess_for_leader(const EnsemblePlan& plan, const Ranks& ranks);

// Threads of all ranks on this machine, or its processors if there are fewer.
int threads_of_machine(const EnsemblePlan& plan, const Ranks& ranks);

}  // namespace gearpod::mc
