#include "analysis/pod/calibrated_bounds.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/noncentral_t.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Where = SizeEstimate::Where;

// Bounds by a test of every size and distance u: a pair is on the inner side of the bound if the
// table does not reject it.
class TestedBounds : public ResponseBounds {
  public:
    TestedBounds(const SignalResponseFit& fit, double threshold, Alarm alarm)
        : fit_(fit), threshold_(threshold), alarm_(alarm) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        const double u = link_quantile(Link::probit, pod);
        const auto at = [&](int bound) -> SizeEstimate {
            const auto beyond = [&](double size) { return excess(size, u, bound); };
            if (!(beyond(largest) >= 0.0)) {
                return {Where::not_reached, kNan};
            }
            if (beyond(smallest) >= 0.0) {
                return {Where::below_tested, kNan};
            }
            return {Where::reached, zero(beyond, smallest, largest)};
        };
        // The upper bound of the POD curve gives the lower bound of the size.
        return {at(0), at(1), at(-1)};
    }

    PodPoint point(double size) const override {
        const double u = distance(size).u;
        const auto pod = [&](int bound) {
            const auto beyond = [&](double at) { return -excess(size, at, bound); };
            double step = 0.5;
            while (step < kFarthest && !(bound * beyond(u + bound * step) > 0.0)) {
                step *= 2.0;
            }
            if (step >= kFarthest) {
                return bound < 0 ? 0.0 : 1.0;
            }
            const double end = u + bound * step;
            return link_probability(Link::probit, zero(beyond, std::min(u, end), std::max(u, end)));
        };
        return {size, link_probability(Link::probit, u), pod(-1), pod(1)};
    }

    double specimens(double pod, double size) const override {
        const double u = link_quantile(Link::probit, pod);
        const double clear = distance(size).u - u;
        const double half_width = clear - excess(size, u, -1);
        return clear > 0.0 ? std::pow(half_width / clear, 2)
                           : std::numeric_limits<double>::infinity();
    }

  protected:
    static constexpr double kFarthest = 64.0;

    LineDistance distance(double size) const {
        return line_distance(fit_, size, threshold_, alarm_);
    }
    const SignalResponseFit& fit() const { return fit_; }
    // Distance, in units of u, by which the bound at a size exceeds u. `bound` -1, 0, 1: lower
    // bound, estimate, upper bound.
    virtual double excess(double size, double u, int bound) const = 0;

  private:
    template <typename Function>
    static double zero(Function function, double low, double high) {
        std::uintmax_t steps = 200;
        const double at_low = function(low), at_high = function(high);
        if (!(at_low * at_high < 0.0)) {
            return std::abs(at_low) < std::abs(at_high) ? low : high;
        }
        const auto bracket = boost::math::tools::toms748_solve(
            function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(40),
            steps, QuietPolicy());
        return 0.5 * (bracket.first + bracket.second);
    }

    const SignalResponseFit& fit_;
    double threshold_;
    Alarm alarm_;
};

class ExactBounds : public TestedBounds {
  public:
    ExactBounds(const SignalResponseFit& fit, double threshold, Alarm alarm, double confidence)
        : TestedBounds(fit, threshold, alarm), limit_(link_quantile(Link::probit, confidence)) {}

  protected:
    double excess(double size, double u, int bound) const override {
        const RegressionLine& line = fit().line;
        const double x = fit().scale.log_size ? std::log(size) : size;
        // The model's sigma is that of maximum likelihood.
        const double found = distance(size).u * fit().model.sigma / line.sigma;
        if (bound == 0) {
            return distance(size).u - u;
        }
        const double spread = std::sqrt(line.leverage(x));
        const double freedom = static_cast<double>(line.count) - 2.0;
        constexpr double kEnd = 1e-15;
        const double below =
            std::clamp(noncentral_t_cdf(freedom, u / spread, found / spread), kEnd, 0.5);
        const double above =
            std::clamp(noncentral_t_upper_tail(freedom, u / spread, found / spread), kEnd, 0.5);
        const double score = below < 0.5 ? link_quantile(Link::probit, below)
                                         : link_upper_quantile(Link::probit, above);
        const double error = std::sqrt(spread * spread + found * found / (2.0 * freedom));
        return (score + bound * limit_) * error;
    }

  private:
    double limit_;
};

class SimulatedBounds : public TestedBounds {
  public:
    SimulatedBounds(const SignalResponseFit& fit, double threshold, Alarm alarm,
                    std::shared_ptr<const SimulatedLimits> limits)
        : TestedBounds(fit, threshold, alarm), limits_(std::move(limits)) {}

  protected:
    double excess(double size, double u, int bound) const override {
        const LineDistance found = distance(size);
        return found.u - u - (bound == 0 ? 0.0 : limits_->at(size, u, bound) * found.error);
    }

  private:
    std::shared_ptr<const SimulatedLimits> limits_;
};

}  // namespace

std::unique_ptr<ResponseBounds> exact_bounds(const SignalResponseFit& fit, double threshold,
                                             Alarm alarm, double confidence) {
    return std::make_unique<ExactBounds>(fit, threshold, alarm, confidence);
}

std::unique_ptr<ResponseBounds> simulated_bounds(const SignalResponseFit& fit, double threshold,
                                                 Alarm alarm,
                                                 std::shared_ptr<const SimulatedLimits> limits) {
    return std::make_unique<SimulatedBounds>(fit, threshold, alarm, std::move(limits));
}

}  // namespace gearpod::analysis
