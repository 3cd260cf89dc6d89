#include "analysis/pod/response_bounds.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "analysis/pod/pod_bounds.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Where = SizeEstimate::Where;

PodForm form_of(const SignalResponseFit& fit) {
    PodForm form;
    form.link = Link::probit;
    form.log_size = fit.scale.log_size;
    return form;
}

// Root between a and b, at which `function` has opposite signs.
template <typename Function>
double root(Function function, double a, double b) {
    std::uintmax_t steps = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        function, std::min(a, b), std::max(a, b), boost::math::tools::eps_tolerance<double>(40),
        steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

class WidestBounds : public ResponseBounds {
  public:
    explicit WidestBounds(std::vector<std::unique_ptr<ResponseBounds>> bounds)
        : bounds_(std::move(bounds)) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        SizeBounds all = bounds_.front()->size(pod, smallest, largest);
        for (std::size_t i = 1; i < bounds_.size(); ++i) {
            all = widest(all, bounds_[i]->size(pod, smallest, largest));
        }
        return all;
    }
    PodPoint point(double size) const override {
        PodPoint all = bounds_.front()->point(size);
        for (std::size_t i = 1; i < bounds_.size(); ++i) {
            const PodPoint other = bounds_[i]->point(size);
            all.lower = std::min(all.lower, other.lower);
            all.upper = std::max(all.upper, other.upper);
        }
        return all;
    }
    double specimens(double pod, double size) const override {
        double most = 0.0;
        for (const auto& bounds : bounds_) {
            most = std::max(most, bounds->specimens(pod, size));
        }
        return most;
    }

  private:
    std::vector<std::unique_ptr<ResponseBounds>> bounds_;
};

class BoundsOfPod : public ResponseBounds {
  public:
    BoundsOfPod(const SignalResponseFit& fit, double threshold, Alarm alarm, double z)
        : fit_(fit), threshold_(fit.scale.y(threshold)), side_(alarm_sign(alarm)), z_(z) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        // The upper bound of the POD curve gives the lower bound of the size.
        return {at(pod, 0, smallest, largest), at(pod, 1, smallest, largest),
                at(pod, -1, smallest, largest)};
    }
    PodPoint point(double size) const override {
        const auto pod = [&](int bound) {
            return link_probability(Link::probit, distance(size, bound));
        };
        return {size, pod(0), pod(-1), pod(1)};
    }
    double specimens(double pod, double size) const override {
        const double clear = distance(size, 0) - link_quantile(Link::probit, pod);
        const double half_width = distance(size, 1) - distance(size, 0);
        return clear > 0.0 ? std::pow(half_width / clear, 2)
                           : std::numeric_limits<double>::infinity();
    }

  private:
    // Standardised distance of the line beyond the threshold; `bound` -1, 0, 1: lower bound,
    // estimate, upper bound.
    double distance(double size, int bound) const {
        const ResponseModel& model = fit_.model;
        const double x = form_of(fit_).scaled(size);
        const double u = side_ * (model.at(x) - threshold_) / model.sigma;
        const Eigen::Vector3d by(side_, side_ * x, -u);
        return u + bound * z_ * std::sqrt(by.dot(model.covariance * by)) / model.sigma;
    }
    SizeEstimate at(double pod, int bound, double smallest, double largest) const {
        const double target = link_quantile(Link::probit, pod);
        const auto miss = [&](double size) { return distance(size, bound) - target; };
        if (miss(largest) < 0.0) {
            return {Where::not_reached, kNan};
        }
        if (miss(smallest) >= 0.0) {
            return {Where::below_tested, kNan};
        }
        return {Where::reached, root(miss, smallest, largest)};
    }

    const SignalResponseFit& fit_;
    double threshold_, side_, z_;
};

class BoundsOfSize : public ResponseBounds {
  public:
    BoundsOfSize(const SignalResponseFit& fit, double threshold, double z)
        : curve_(curve_of(fit, threshold)), form_(form_of(fit)), z_(z) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        return wald_size_bounds(curve_, form_, pod, z_, smallest, largest);
    }
    PodPoint point(double size) const override {
        return wald_band(curve_, form_, z_, {size}).front();
    }
    double specimens(double pod, double size) const override {
        return wald_specimens(curve_, form_, pod, size, z_);
    }

  private:
    LocationScale curve_;
    PodForm form_;
    double z_;
};

class BoundsOfLikelihood : public ResponseBounds {
  public:
    BoundsOfLikelihood(const SignalResponseFit& fit, double threshold, Alarm alarm, double limit)
        : fit_(fit),
          curve_(curve_of(fit, threshold)),
          form_(form_of(fit)),
          threshold_(fit.scale.y(threshold)),
          side_(alarm_sign(alarm)),
          limit_(limit) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        const double eta = link_quantile(Link::probit, pod);
        const double from = curve_.at(eta, 0.0);
        const double low = form_.scaled(smallest), high = form_.scaled(largest);
        const auto beyond = [&](double x) { return deviance_root(x, eta) - limit_; };
        return {size_estimate(from, low, high),
                size_estimate(bound(beyond, from, low, high, -1.0), low, high),
                size_estimate(bound(beyond, from, low, high, 1.0), low, high)};
    }

    PodPoint point(double size) const override {
        const double x = form_.scaled(size);
        const double eta = curve_.eta_at(x, 0.0);
        const auto beyond = [&](double u) { return deviance_root(x, u) - limit_; };
        const auto pod = [&](double u) { return link_probability(Link::probit, u); };
        constexpr double kEnd = 40.0;  // where Phi is 0 or 1
        return {size, pod(eta), pod(bound(beyond, eta, eta - kEnd, eta + kEnd, -1.0)),
                pod(bound(beyond, eta, eta - kEnd, eta + kEnd, 1.0))};
    }

    double specimens(double pod, double size) const override {
        const double eta = link_quantile(Link::probit, pod);
        if (!(form_.scaled(size) > curve_.at(eta, 0.0))) {
            return std::numeric_limits<double>::infinity();
        }
        return std::pow(limit_ / deviance_root(form_.scaled(size), eta), 2);
    }

  private:
    double deviance_root(double x, double eta) const {
        const double held =
            fit_.likelihood->maximum_through(x, threshold_, side_ * eta, fit_.maximum);
        return std::sqrt(std::max(0.0, 2.0 * (fit_.maximum.log_likelihood - held)));
    }
    // Root of `beyond`, searched outwards from the estimate `from` in growing steps: downwards to
    // `low` for way -1, upwards to `high` for way 1. Infinite if there is none up to that end.
    template <typename Function>
    double bound(Function beyond, double from, double low, double high, double way) const {
        const double end = way > 0.0 ? std::max(from, high) : std::min(from, low);
        double inside = from;
        for (double share = 1.0 / 64.0; share <= 1.0; share *= 2.0) {
            const double tried = from + share * (end - from);
            if (beyond(tried) > 0.0) {
                return root(beyond, inside, tried);
            }
            inside = tried;
        }
        return way * std::numeric_limits<double>::infinity();
    }
    SizeEstimate size_estimate(double x, double low, double high) const {
        return x < low     ? SizeEstimate{Where::below_tested, kNan}
               : x <= high ? SizeEstimate{Where::reached, form_.size(x)}
                           : SizeEstimate{Where::not_reached, kNan};
    }

    const SignalResponseFit& fit_;
    LocationScale curve_;
    PodForm form_;
    double threshold_, side_, limit_;
};

}  // namespace

LocationScale curve_of(const SignalResponseFit& fit, double threshold) {
    const ResponseModel& model = fit.model;
    const double steep = std::abs(model.slope);
    LocationScale curve;
    curve.location = (fit.scale.y(threshold) - model.intercept) / model.slope;
    curve.scale = model.sigma / steep;
    Eigen::Matrix<double, 2, 3> by;
    by << -1.0 / model.slope, -curve.location / model.slope, 0.0,  //
        0.0, -curve.scale / model.slope, 1.0 / steep;
    curve.covariance = by * model.covariance * by.transpose();
    return curve;
}

std::unique_ptr<ResponseBounds> widest_bounds(std::vector<std::unique_ptr<ResponseBounds>> bounds) {
    return bounds.size() == 1 ? std::move(bounds.front())
                              : std::make_unique<WidestBounds>(std::move(bounds));
}

std::unique_ptr<ResponseBounds> bounds_of_pod(const SignalResponseFit& fit, double threshold,
                                              Alarm alarm, double z) {
    return std::make_unique<BoundsOfPod>(fit, threshold, alarm, z);
}

std::unique_ptr<ResponseBounds> bounds_of_size(const SignalResponseFit& fit, double threshold,
                                               double z) {
    return std::make_unique<BoundsOfSize>(fit, threshold, z);
}

std::unique_ptr<ResponseBounds> bounds_of_likelihood(const SignalResponseFit& fit, double threshold,
                                                     Alarm alarm, double limit) {
    return std::make_unique<BoundsOfLikelihood>(fit, threshold, alarm, limit);
}

}  // namespace gearpod::analysis
