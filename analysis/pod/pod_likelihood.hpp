// Likelihood of a POD curve, its maximum and profiles, and its goodness of fit.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/pod/pod_curve.hpp"

namespace gearpod::analysis {

// Hits and misses by fault size, the data of a hit/miss analysis, and their standardised sizes.

// Hits and misses by fault size, the data of a hit/miss analysis. Every distinct size has its own
// row; there is no binning, only gearboxes of exactly equal size are counted together.
struct HitMissRow {
    double size = 0.0;  // > 0
    double hits = 0.0;
    double tests = 0.0;
};

using HitMissTable = std::vector<HitMissRow>;  // ascending size

// Builds the table. Sizes of 0 (healthy gearboxes) and sizes that are not finite are left out.
HitMissTable hit_miss_table(std::span<const double> sizes, std::span<const char> hit);

double total_tests(const HitMissTable& table);
double total_hits(const HitMissTable& table);

// Hits and misses over standardised fault size, condensed to few quadrature nodes where there are
// many.
//
// A log likelihood is a sum of analytic functions of u over two discrete measures, hits and misses.
// In each cell of u a measure is replaced by its Gauss rule, whose nodes and weights integrate
// every polynomial up to degree 2 kNodes - 1 exactly (W. Gautschi, Orthogonal Polynomials:
// Computation and Approximation (2004), sections 1.4 and 2.2). With cells narrow compared with the
// curve's width, the error is at rounding level (test_standardised_sizes.cpp).

// Nodes of the hits, then of the misses.
struct SizeNodes {
    double cell = 0.0;  // widest cell of u; 0 if these are the sizes themselves
    Eigen::ArrayXd u;
    Eigen::ArrayXd weight;
    Eigen::Index hits = 0;  // number of nodes
};

class StandardisedSizes {
  public:
    static constexpr int kNodes = 12;  // per cell and measure, at most

    // Standardises the sizes, or their logarithms, to mean 0 and standard deviation 1 over the
    // gearboxes.
    StandardisedSizes(const HitMissTable& table, bool log_size);

    double centre() const { return centre_; }
    double spread() const { return spread_; }
    double u(double scaled) const { return (scaled - centre_) / spread_; }

    // Every size of the table.
    const Eigen::ArrayXd& sizes() const { return sizes_; }
    double hits() const { return hits_; }
    double tests() const { return tests_; }

    // The smallest set of nodes whose cells are no wider than `widest_cell`. Computes each set when
    // it is first needed, so an object belongs to one thread.
    const SizeNodes& nodes(double widest_cell) const;

  private:
    double centre_ = 0.0, spread_ = 1.0;
    double hits_ = 0.0, tests_ = 0.0;
    Eigen::ArrayXd sizes_;
    SizeNodes all_;                            // the sizes themselves
    mutable std::vector<SizeNodes> by_cells_;  // with 1, 2, 4, ... cells; empty if not yet needed
};

// Binomial likelihood of a POD curve, maximised by Fisher scoring with step halving, either freely
// or with the curve constrained through one point (the profile likelihood used for likelihood-ratio
// bounds). P. McCullagh, J. A. Nelder, Generalized Linear Models (1989), sections 2.5 and 4.4.
// Firth's penalty, half the logarithm of the information's determinant, gives a maximum even where
// hits and misses do not overlap: D. Firth, Biometrika 80 (1993), 27-38; G. Heinze, M. Schemper,
// Stat. Med. 21 (2002), 2409-2419.
class PodLikelihood {
  public:
    // (intercept, slope, ceiling) in the standardised size u.
    using Parameters = Eigen::Vector3d;

    struct Maximum {
        double log_likelihood = 0.0;  // without the binomial coefficients, with the penalty
        double penalty = 0.0;
        Parameters parameters;
        // Fisher information of the parameters; rows of fixed parameters are 0.
        Eigen::Matrix3d information;
        bool converged = false;
    };

    // Needs at least two sizes, standardised on the scale of the form.
    PodLikelihood(std::shared_ptr<const StandardisedSizes> sizes, const PodForm& form);
    PodLikelihood(const HitMissTable& table, const PodForm& form);

    const PodForm& form() const { return form_; }
    double standardised(double size) const { return sizes_->u(form_.scaled(size)); }
    double size(double u) const { return form_.size(sizes_->centre() + sizes_->spread() * u); }

    // Maximises from `start`, or from a nearly flat curve.
    Maximum maximise(std::optional<Parameters> start = std::nullopt) const;

    // Maximises among the curves with POD = `pod` at u; floor < pod < 1. `start`: parameters as in
    // Maximum.
    Maximum maximise_through(double u, double pod, const Parameters& start) const;

    // Extreme POD at u among the curves with a log likelihood of at least `log_likelihood`: minimum
    // for side -1, maximum for side 1. Returns its transform zeta, POD = floor + (1 - floor)
    // F(zeta), by quadratic programs from `start` after D. J. Venzon, S. H. Moolgavkar, Appl. Stat.
    // 37 (1988), 87-94. Empty if they do not converge, or if the likelihood is penalised. `start`
    // is set to the extreme curve.
    std::optional<double> extreme_zeta(double u, double log_likelihood, int side,
                                       Parameters& start) const;

    PodCurve curve(const Parameters& parameters) const;

    // Number of sizes at which the curve is neither at its floor nor at its ceiling. The slope is
    // determined only by two or more.
    int sizes_in_transition(const Parameters& parameters) const;

  private:
    struct Point {
        double u, pod;
    };
    struct Slopes {
        double value = 0.0;
        Parameters score = Parameters::Zero();
        Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    };

    // Nodes needed for a curve of this slope.
    const SizeNodes& nodes_for(double slope) const;
    Slopes evaluate(const Parameters& parameters, const std::optional<Point>& through,
                    const SizeNodes& nodes) const;
    // Adds Firth's penalty and its derivatives, by finite differences. Returns the penalty.
    double penalise(const Parameters& parameters, const std::optional<Point>& through,
                    const SizeNodes& nodes, Slopes& slopes) const;
    // Evaluates the likelihood with the penalty.
    Slopes penalised(const Parameters& parameters, const std::optional<Point>& through,
                     const SizeNodes& nodes) const;
    // Adjusts intercept or ceiling so that the curve passes through the point. False if the ceiling
    // is too low for the floor.
    bool pass_through(Parameters& parameters, const std::optional<Point>& through) const;
    Maximum ascend(Parameters parameters, const std::optional<Point>& through) const;

    std::shared_ptr<const StandardisedSizes> sizes_;
    PodForm form_;
};

// Goodness of fit of a POD curve to the hits and misses.

// Test of the fit. For replicated sizes, the likelihood-ratio statistic against a separate rate for
// every size (McCullagh and Nelder (1989), section 4.4.3), with sizes - parameters degrees of
// freedom. Otherwise D. W. Hosmer, S. Lemeshow, Commun. Stat. A 9 (1980), 1043-1069: ten groups of
// equal count in ascending POD, with groups - parameters degrees of freedom.
struct GoodnessOfFit {
    enum class Test { none, saturated, hosmer_lemeshow };
    Test test = Test::none;  // none: fewer sizes than the test needs
    double statistic = 0.0;  // NaN if none
    int degrees = 0;
    double p_value = 0.0;  // NaN if none
};

GoodnessOfFit goodness_of_fit(const HitMissTable& table, const PodCurve& curve);

// Text such as "likelihood ratio against every size's own rate: p = 0.31".
std::string fit_text(const GoodnessOfFit& fit);

}  // namespace gearpod::analysis
