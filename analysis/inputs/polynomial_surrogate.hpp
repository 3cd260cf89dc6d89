// Polynomial surrogate of an output in the ranks of its inputs. Terms of one input have degrees up
// to 8, terms of two inputs a total degree up to 5; they are orthonormal over the sample in each
// input. Terms are added one at a time while the best remaining one correlates with the residual
// beyond chance (5 % over all terms). The variance is the sum of the shares of the terms: B.
// Sudret, Reliab. Eng. Syst. Saf. 93 (2008), 964-979. Selection follows G. Blatman, B. Sudret, J.
// Comput. Phys. 230 (2011), 2345-2367, with orthogonal matching pursuit. The unexplained part is
// noise, higher interactions, or influence too small for the sample.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace gearpod::analysis {

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

}  // namespace gearpod::analysis
