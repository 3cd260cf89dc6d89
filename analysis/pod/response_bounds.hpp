// Bounds of a POD curve from a line through responses.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/response_fit.hpp"

namespace gearpod::analysis {

// POD(x) = Phi((x - location) / scale) from a line and a threshold, with its covariance.
LocationScale curve_of(const SignalResponseFit& fit, double threshold);

// Bounds derived from a response fit.
class ResponseBounds {
  public:
    virtual ~ResponseBounds() = default;
    virtual SizeBounds size(double pod, double smallest, double largest) const = 0;
    virtual PodPoint point(double size) const = 0;
    // Number of specimens needed to bring the bound of the size with that POD to `size`, as a
    // factor on the number tested.
    virtual double specimens(double pod, double size) const = 0;
};

// Estimates of the first bounds, and the widest of all bounds.
std::unique_ptr<ResponseBounds> widest_bounds(std::vector<std::unique_ptr<ResponseBounds>> bounds);

// Wald bounds of POD at a size; where they cross a POD they bound the size. var u = (variance of
// the line at x + u^2 variance of sigma) / sigma^2, with u the distance of the line beyond the
// threshold in sigmas.
std::unique_ptr<ResponseBounds> bounds_of_pod(const SignalResponseFit& fit, double threshold,
                                              Alarm alarm, double z);
// Wald bounds of the size with a POD; where they cross a size they bound the POD: MIL-HDBK-1823A,
// appendix G.2.5.
std::unique_ptr<ResponseBounds> bounds_of_size(const SignalResponseFit& fit, double threshold,
                                               double z);
// Likelihood-ratio bounds, for a fit by maximum likelihood.
std::unique_ptr<ResponseBounds> bounds_of_likelihood(const SignalResponseFit& fit, double threshold,
                                                     Alarm alarm, double limit);

// Tables of responses simulated from a fitted line (parametric bootstrap), and limits for the
// bounds of the line from them. Every simulated table is fitted like the measured one: all scales,
// checks, and choice. The limits thereby include the small-sample scatter and the choice of the
// scale: R. Beran, J. Am. Stat. Assoc. 83 (1988), 687-697. The seed is fixed, so that a table
// always has the same bounds.

// Standardised distance u of a line beyond a threshold, with its standard error.
struct LineDistance {
    double u = 0.0, error = 0.0;
};

// Distance at a size from a threshold on the scale of the responses.
LineDistance line_distance(const SignalResponseFit& fit, double size, double threshold,
                           Alarm alarm);

// Scatter of a fit at a size, relative to that of the fit, if the scatter grows in proportion to
// the size instead of being constant. Its root mean square over the sizes of the table is 1.
double proportional_scatter(const ResponseRows& rows, double size);

// Calls `use` with the fits and the chosen one of each of `tables` simulated tables, unless it has
// no curve. `growing`: with proportional_scatter().
void simulate_responses(const ResponseRows& rows, bool by_specimen, const SignalResponseFit& truth,
                        const SignalResponseRequest& request, int tables, bool growing,
                        const std::function<void(const std::vector<SignalResponseFit>&,
                                                 const SignalResponseFit&)>& use);

// Quantiles of (estimate - truth) / standard error of the distance u, by size and by true distance.
class SimulatedLimits {
  public:
    SimulatedLimits(const ResponseRows& rows, bool by_specimen, const SignalResponseFit& truth,
                    const SignalResponseRequest& request);

    // Number of standard errors from the estimate to the bound of u, if u is the truth: >= 0 for
    // bound -1 (lower bound), negative for bound 1.
    double at(double size, double u, int bound) const;

    int tables() const { return tables_; }
    int fitted() const { return fitted_; }  // simulated tables that have a curve

  private:
    static constexpr int kSizes = 5, kDistances = 5;
    int tables_ = 0, fitted_ = 0;
    bool log_size_ = false;
    double x_[kSizes] = {};
    double limit_[2][kSizes][kDistances] = {};
};

// Reason why so many simulated tables give no bounds at a confidence, "" if they do.
std::string too_few_tables(int tables, double confidence);

// Bounds of a POD curve from a line through responses that cover their confidence in small tables.
// A bound of the POD at a size is exceeded by the true POD with probability 1 - confidence. Where
// it crosses a POD, it bounds the size.

// Exact bounds for least squares on one scale without censored or repeated values: the line's
// distance from the threshold over its standard error follows a noncentral t distribution with
// n - 2 degrees of freedom. D. B. Owen, Technometrics 10 (1968), 445-478.
std::unique_ptr<ResponseBounds> exact_bounds(const SignalResponseFit& fit, double threshold,
                                             Alarm alarm, double confidence);

// Bounds with the limits of simulated tables.
std::unique_ptr<ResponseBounds> simulated_bounds(const SignalResponseFit& fit, double threshold,
                                                 Alarm alarm,
                                                 std::shared_ptr<const SimulatedLimits> limits);

}  // namespace gearpod::analysis
