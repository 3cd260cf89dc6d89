// Likelihood of a straight line through responses with normal scatter. Some responses may be
// censored, that is, only known to lie below or above a limit (J. Tobin, Econometrica 26 (1958),
// 24-36; MIL-HDBK-1823A, appendix G.2.4). Responses of one specimen may share a random effect (N.
// M. Laird, J. H. Ware, Biometrics 38 (1982), 963-974):
//
//   y = intercept + slope x + between b + within e,
//
// with b the specimen effect and e the residual of each value, both standard normal. The likelihood
// is exact without censored values. Censored values are integrated over b by Gauss quadrature, with
// the conditional distribution of b given the specimen's other values.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/statistics/numeric_maximum.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct Response {
    double x = 0.0, y = 0.0;
    int censored = 0;  // -1: y or less; 1: y or more
    long specimen = 0;
};

// Line, scatter of single values about it, and the covariance of the three parameters.
struct ResponseModel {
    double intercept = 0.0, slope = 0.0;
    double sigma = 0.0;    // root of between^2 + within^2
    double between = 0.0;  // 0 without specimen effects
    double within = 0.0;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of intercept, slope and sigma

    double at(double x) const { return intercept + slope * x; }
};
GEARPOD_FIELDS(ResponseModel, intercept, slope, sigma, between, within, covariance_)

class ResponseLikelihood {
  public:
    // `by_specimen`: with random effects of specimens. Needs at least three responses that differ
    // in x and in y. `coarse`: with fewer nodes for specimens' censored values, for simulations.
    ResponseLikelihood(std::vector<Response> responses, bool by_specimen, bool coarse = false);

    struct Maximum {
        Eigen::VectorXd parameters;  // in standardised units
        Eigen::MatrixXd information;
        double log_likelihood = 0.0;
        bool converged = false;
    };
    Maximum maximise() const;

    // Log likelihood of the best line that lies `u` sigmas above y at x.
    double maximum_through(double x, double y, double u, const Maximum& start) const;

    ResponseModel model(const Maximum& maximum) const;
    // True if the scatter between specimens exceeds rounding.
    bool has_between(const Maximum& maximum) const;

  private:
    struct Line {
        double intercept, slope, within, between;  // in standardised units
    };
    double log_likelihood(const Line& line) const;
    double of_specimen(std::size_t first, std::size_t last, const Line& line) const;
    // Derivatives without specimen effects, by intercept, slope and ln sigma.
    Curvature curvature(const Eigen::VectorXd& parameters) const;
    // Maximum with censored values taken at their limits.
    Eigen::VectorXd start_with_specimens() const;

    std::vector<Response> responses_;  // standardised, sorted by specimen
    bool by_specimen_, coarse_;
    double x_centre_ = 0.0, x_spread_ = 1.0, y_centre_ = 0.0, y_spread_ = 1.0;
    double constant_ = 0.0;  // log likelihood of y minus that of standardised y
};
GEARPOD_FIELDS(ResponseLikelihood::Maximum, parameters, information, log_likelihood, converged)

}  // namespace gearpod::analysis
