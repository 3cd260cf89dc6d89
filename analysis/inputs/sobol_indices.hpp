// Sobol indices of an output over the random inputs of gearboxes, from correlation ratios and a
// polynomial surrogate.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/inputs/miss_sensitivity.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Share of an output's variance that one input explains alone, Var(E[Y | X]) / Var(Y): Pearson's
// correlation ratio, the first-order index of I. M. Sobol, Math. Model. Comput. Exp. 1 (1993),
// 407-414. Estimated from any sample (given-data estimator: E. Plischke, E. Borgonovo, C. L. Smith,
// Eur. J. Oper. Res. 226 (2013), 536-550) in bins of equal counts, less the share that bins without
// influence would explain by chance (T. L. Kelley, Proc. Natl. Acad. Sci. 21 (1935), 554-559).
struct CorrelationRatio {
    // May be slightly negative by chance without influence. NaN if y or x is constant, or with
    // fewer than 20 values.
    double share = 0.0;
    Interval bounds;  // two-sided, within 0 and 1
};
GEARPOD_FIELDS(CorrelationRatio, first, first_lower_upper)

// Estimates the share in 2 n^(1/3) bins. Bounds are from the noncentral F distribution (J. H.
// Steiger, Psychol. Methods 9 (2004), 164-182). They are widened about the estimate by the ratio of
// two standard deviations: the one from the ratio's influence function, which accounts for the
// distribution of the output, to that under a normal distribution.
CorrelationRatio correlation_ratio(std::span<const double> x, std::span<const double> y,
                                   double confidence);

// Polynomial surrogate of an output in the ranks of its inputs. Terms of one input have degrees up
// to 8, terms of two inputs a total degree up to 5; they are orthonormal over the sample in each
// input. Terms are added one at a time while the best remaining one correlates with the residual
// beyond chance (5 % over all terms). The variance is the sum of the shares of the terms: B.
// Sudret, Reliab. Eng. Syst. Saf. 93 (2008), 964-979. Selection follows G. Blatman, B. Sudret, J.
// Comput. Phys. 230 (2011), 2345-2367, with orthogonal matching pursuit. The unexplained part is
// noise, higher interactions, or influence too small for the sample.
struct SurrogateTerm {
    // Index of one or two inputs and the degree in each. `second` is -1 if the term has one input.
    int input = 0, degree = 0;
    int second = -1, second_degree = 0;
    double coefficient = 0.0;
    double variance = 0.0;  // of the coefficient

    bool has(int which) const { return input == which || second == which; }
};

struct PolynomialSurrogate {
    std::vector<SurrogateTerm> terms;
    Eigen::MatrixXd columns;   // outputs x terms
    Eigen::VectorXd residual;  // output minus the polynomial
    double variance = 0.0;     // of the output
    double explained = 0.0;    // R^2, adjusted for the number of terms
    // Share of the variance that a single term must have to be found with a probability of 95 %.
    double resolution = 0.0;
};

// Fits the surrogate. The output and every input must vary.
PolynomialSurrogate fit_surrogate(const std::vector<std::vector<double>>& inputs,
                                  std::span<const double> output);

// Sobol indices: shares of an output's variance that its independent inputs explain. First-order
// indices (input alone) are correlation ratios. Total indices (alone and in interaction with
// others: T. Homma, A. Saltelli, Reliab. Eng. Syst. Saf. 52 (1996), 1-17) are computed from a
// polynomial surrogate of the sample, so they include only what it
// explains. For an output with noise of its own, the indices sum to less than 1.
struct SobolIndex {
    std::string name;
    std::string unit;
    CorrelationRatio first;
    double total = 0.0;
    // Two-sided bounds from the influence function over the selected terms of the surrogate. If no
    // term contains the input, from 0 to the surrogate's resolution.
    Interval total_bounds;
};
GEARPOD_FIELDS(SobolIndex, name, unit, first_, total, total_lower_upper)

struct SobolIndices {
    long count = 0;                     // number of gearboxes used
    std::vector<SobolIndex> inputs;     // by falling total, then first-order index
    double explained = 0.0;             // adjusted R^2 of the surrogate
    double resolution = 0.0;            // share that a single term needs to be found
    int terms = 0;                      // number of terms of the surrogate
    std::vector<std::string> left_out;  // inputs that do not vary
    std::string refusal;                // reason why there are no indices, or ""
};
GEARPOD_FIELDS(SobolIndices, gearboxes, inputs, explained, resolution, terms, left_out, refusal)

// Computes the indices from `output` and every input per gearbox, all finite.
// Refuses fewer than 100 gearboxes, a constant output, and inputs with correlated ranks, whose
// shares cannot be attributed to one input. Uses the first 20,000 gearboxes.
SobolIndices sobol_indices(std::span<const double> output, const std::vector<InputColumn>& inputs,
                           double confidence);

// Influence of the random inputs on whether a feature finds a fault: Sobol indices of its misses
// and of its value over the faulty gearboxes of sizes at which detection is neither certain nor
// impossible. The fault size is one of the inputs.
struct LevelSensitivity {
    std::string feature;
    SizeGroup sizes;      // NaN if there are none
    SobolIndices misses;  // of the outcome missed or detected
    SobolIndices values;  // of the normal score of the value, so that no tail dominates
};
GEARPOD_FIELDS(LevelSensitivity, feature, size_low_high, misses, values)

// `values` of the feature at one noise level and `hit` (outcomes()) per gearbox; `size` is the
// column of fault sizes.
LevelSensitivity level_sensitivity(const std::string& feature, std::span<const double> values,
                                   const std::vector<int>& hit, const InputColumn& size,
                                   const std::vector<InputColumn>& inputs,
                                   const LevelDetection& detection, double confidence);

}  // namespace gearpod::analysis
