// An output as a polynomial of the ranks of its inputs: terms of one input up to degree 8 and of
// two inputs up to a total degree of 5, orthonormal over the sample in each input, taken in one at
// a time while the best of those left correlates with the rest beyond chance (5 % over all terms).
// Its variance splits into the shares of its terms: B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008),
// 964-979; selection as G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011), 2345-2367, with
// orthogonal matching pursuit. What no term explains is noise, higher interaction, or too small an
// influence for the sample.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace gearpod::analysis {

struct SurrogateTerm {
    // Degrees in one or two inputs; the second input is -1 for a term of one.
    int input = 0, degree = 0;
    int second = -1, second_degree = 0;
    double coefficient = 0.0;
    double variance = 0.0;  // of the coefficient

    bool has(int which) const { return input == which || second == which; }
};

struct PolynomialSurrogate {
    std::vector<SurrogateTerm> terms;
    Eigen::MatrixXd columns;   // outputs x terms
    Eigen::VectorXd residual;  // outputs less the polynomial
    double variance = 0.0;     // of the output
    double explained = 0.0;    // R^2, adjusted for the number of terms
    // Share of the variance that a single term must have to be found with a probability of 95 %.
    double resolution = 0.0;
};

// Every input must vary; the output as well.
PolynomialSurrogate fit_surrogate(const std::vector<std::vector<double>>& inputs,
                                  std::span<const double> output);

}  // namespace gearpod::analysis
