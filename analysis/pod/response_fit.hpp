// POD from responses: a straight line through a feature's values over fault size on given scales,
// and checks of its normal-theory assumptions.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/statistics/numeric_maximum.hpp"
#include "analysis/statistics/regression_line.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

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

// Level of each of the three checks: 5 % for the three together (Bonferroni).
inline constexpr double kCheckLevel = 0.05 / 3.0;

// Values, one row each. `specimen` identifies repeated measurements of one specimen.
struct ResponseRows {
    std::vector<double> size, value;
    std::vector<long> specimen;
};

// Values at or below `left`, and at or above `right`, are censored: only known to lie there.
struct CensoringLimits {
    double left = -std::numeric_limits<double>::infinity();
    double right = std::numeric_limits<double>::infinity();

    bool any() const;
    int of(double value) const;  // -1, 0, 1
};

// Scales of size and value. G. E. P. Box, D. R. Cox, J. R. Stat. Soc. B 26 (1964), 211-252: y is
// (value^power - 1) / power, the logarithm for a power of 0, the value itself for 1.
struct ResponseScale {
    bool log_size = false;
    double power = 1.0;

    double y(double value) const;
    double value(double y) const;
    std::string text() const;  // for example "log value of size"
};

enum class LineMethod {
    least_squares,       // variances with n - 2 degrees of freedom
    maximum_likelihood,  // supports censored values and repeated measurements
};

struct SignalResponseFit {
    ResponseScale scale;
    // Least-squares line through the uncensored values, or through the means of specimens; used by
    // the checks.
    RegressionLine line;
    ResponseModel model;          // of y over x
    double log_likelihood = 0.0;  // of the values themselves, hence comparable between scales
    double aic = 0.0;
    std::vector<CheckResult> checks;
    std::vector<std::string> refusals;                     // reasons why there is no fit
    std::vector<std::string> doubts;                       // checks that failed
    std::shared_ptr<const ResponseLikelihood> likelihood;  // of a fit by maximum likelihood
    ResponseLikelihood::Maximum maximum;

    bool usable() const { return refusals.empty() && doubts.empty(); }
};
GEARPOD_FIELDS(SignalResponseFit, scale_, line_, model_, log_likelihood_, aic, checks, refusals_,
               doubts_, likelihood_, maximum_)

// Fits the line. `by_specimen`: with random effects of specimens, by maximum likelihood. `coarse`:
// as in ResponseLikelihood.
SignalResponseFit fit_response(const ResponseRows& rows, const ResponseScale& scale,
                               const CensoringLimits& limits, LineMethod method, bool by_specimen,
                               double threshold, Alarm alarm, bool coarse = false);

// Box-Cox power of greatest likelihood in [-2, 2]; empty if a value is not positive.
std::optional<double> box_cox_power(const ResponseRows& rows, bool log_size,
                                    const CensoringLimits& limits, bool by_specimen,
                                    bool coarse = false);

// Fits of responses over size on all requested scales, and the choice of one.
struct SignalResponseRequest {
    double threshold = 0.0;
    Alarm alarm = Alarm::high;
    double confidence = 0.95;
    int band_points = 21;

    LineMethod method = LineMethod::least_squares;
    BoundRule rule = {BoundMethod::wald, 0.0};  // of a fit by maximum likelihood
    CensoringLimits limits = {};
    std::vector<bool> log_sizes = {false, true};
    // Box-Cox powers; NaN: the power of greatest likelihood.
    std::vector<double> powers = {1.0, 0.0};
    bool accept_failed_checks = false;    // accept a scale whose checks fail
    std::span<const long> specimen = {};  // specimen of each value; empty: one each
    std::optional<double> target = {};    // size to which a90's bound should come down
    std::string tested = "faulty gearboxes";
    int simulated_tables = 0;  // for simulated_coverage and for growing scatter
};

// Fits every scale. `coarse`: as in ResponseLikelihood.
std::vector<SignalResponseFit> fit_scales(const ResponseRows& rows, bool by_specimen,
                                          const SignalResponseRequest& request,
                                          bool coarse = false);

// Fit of least AIC among those not refused. Fits whose checks fail are left out unless
// `accept_failed_checks`. Null if none is left.
const SignalResponseFit* best_scale(const std::vector<SignalResponseFit>& fits,
                                    bool accept_failed_checks);

// Numbers of the fits that the data support about as well as `best`, which comes first: their AIC
// is within 2 of it (K. P. Burnham, D. R. Anderson, Model Selection and Multimodel Inference
// (2002), section 2.6), and they pass the checks like it.
std::vector<std::size_t> supported_scales(const std::vector<SignalResponseFit>& fits,
                                          const SignalResponseFit& best, bool accept_failed_checks);

}  // namespace gearpod::analysis
