// Binomial likelihood of a POD curve, maximised by Fisher scoring with step halving; freely, or
// with the curve held to one point (the profile behind likelihood-ratio bounds). P. McCullagh, J.
// A. Nelder, Generalized Linear Models (1989), sections 2.5 and 4.4. With Firth's penalty, half the
// logarithm of the information's determinant, there is a maximum even where hits and misses do not
// overlap: D. Firth, Biometrika 80 (1993), 27-38; G. Heinze, M. Schemper, Stat. Med. 21 (2002),
// 2409-2419.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/standardised_sizes.hpp"

namespace gearpod::analysis {

class PodLikelihood {
  public:
    // (intercept, slope, ceiling) in the standardised size u.
    using Parameters = Eigen::Vector3d;

    struct Maximum {
        double log_likelihood = 0.0;  // without the binomial coefficients, with the penalty
        double penalty = 0.0;
        Parameters parameters;
        Eigen::Matrix3d information;  // Fisher's, in the parameters; rows of fixed ones are 0
        bool converged = false;
    };

    // Two sizes at least, on the form's scale.
    PodLikelihood(std::shared_ptr<const StandardisedSizes> sizes, const PodForm& form);
    PodLikelihood(const HitMissTable& table, const PodForm& form);

    const PodForm& form() const { return form_; }
    double standardised(double size) const { return sizes_->u(form_.scaled(size)); }
    double size(double u) const { return form_.size(sizes_->centre() + sizes_->spread() * u); }

    // From `start`, or from a flat curve.
    Maximum maximise(std::optional<Parameters> start = std::nullopt) const;

    // Among the curves with POD = `pod` at u; floor < pod < 1. `start` as a free maximum gives it.
    Maximum maximise_through(double u, double pod, const Parameters& start) const;

    // Where among the curves no less likely than `log_likelihood` the POD at u is least (side -1)
    // or most (side 1): its transform zeta, POD = floor + (1 - floor) F(zeta), from `start`. By
    // quadratic programs after D. J. Venzon, S. H. Moolgavkar, Appl. Stat. 37 (1988), 87-94. Empty
    // if they do not settle, or the likelihood is penalised; `start` is left at the extreme curve.
    std::optional<double> extreme_zeta(double u, double log_likelihood, int side,
                                       Parameters& start) const;

    PodCurve curve(const Parameters& parameters) const;

    // Sizes at which the curve is neither at its floor nor at its ceiling: the slope is only
    // determined by two or more.
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

    // The nodes that a curve of this slope asks for.
    const SizeNodes& nodes_for(double slope) const;
    Slopes evaluate(const Parameters& parameters, const std::optional<Point>& through,
                    const SizeNodes& nodes) const;
    // Adds Firth's penalty and its slopes, by differences.
    double penalise(const Parameters& parameters, const std::optional<Point>& through,
                    const SizeNodes& nodes, Slopes& slopes) const;
    // Both.
    Slopes penalised(const Parameters& parameters, const std::optional<Point>& through,
                     const SizeNodes& nodes) const;
    // Sets the intercept so that the curve meets the point; false if its ceiling is too low.
    bool meet(Parameters& parameters, const std::optional<Point>& through) const;
    Maximum ascend(Parameters parameters, const std::optional<Point>& through) const;

    std::shared_ptr<const StandardisedSizes> sizes_;
    PodForm form_;
};

}  // namespace gearpod::analysis
