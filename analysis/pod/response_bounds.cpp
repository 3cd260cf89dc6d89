#include "analysis/pod/response_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "analysis/pod/pod_bounds.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/noncentral_distributions.hpp"
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

constexpr double kGridDistances[] = {-2.5, -1.2815515655446004, 0.0, 1.2815515655446004, 2.5};

class NormalVariates {
  public:
    double operator()() {
        constexpr double kUnit = 0x1p-53;
        return link_quantile(Link::probit, (static_cast<double>(engine_() >> 11) + 0.5) * kUnit);
    }

  private:
    std::mt19937_64 engine_{20230417};
};

// Interpolated quantile of the sorted values, at the position share (n + 1).
double sorted_quantile(const std::vector<double>& values, double share) {
    const auto n = static_cast<double>(values.size());
    const double position = std::clamp(share * (n + 1.0) - 1.0, 0.0, n - 1.0);
    const auto low = static_cast<std::size_t>(position);
    const std::size_t high = std::min(low + 1, values.size() - 1);
    return values[low] + (position - static_cast<double>(low)) * (values[high] - values[low]);
}

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

LineDistance line_distance(const SignalResponseFit& fit, double size, double threshold,
                           Alarm alarm) {
    const ResponseModel& model = fit.model;
    const double side = alarm_sign(alarm);
    const double x = fit.scale.log_size ? std::log(size) : size;
    const double u = side * (model.at(x) - fit.scale.y(threshold)) / model.sigma;
    const Eigen::Vector3d by(side, side * x, -u);
    return {u, std::sqrt(by.dot(model.covariance * by)) / model.sigma};
}

double proportional_scatter(const ResponseRows& rows, double size) {
    double squares = 0.0;
    for (const double tested : rows.size) {
        squares += tested * tested;
    }
    return size / std::sqrt(squares / static_cast<double>(rows.size.size()));
}

void simulate_responses(const ResponseRows& rows, bool by_specimen, const SignalResponseFit& truth,
                        const SignalResponseRequest& request, int tables, bool growing,
                        const std::function<void(const std::vector<SignalResponseFit>&,
                                                 const SignalResponseFit&)>& use) {
    const ResponseModel& model = truth.model;
    NormalVariates normal;
    std::vector<double> scatter(rows.size.size(), 1.0);
    if (growing) {
        const double at_one = proportional_scatter(rows, 1.0);
        std::transform(rows.size.begin(), rows.size.end(), scatter.begin(),
                       [&](double size) { return at_one * size; });
    }
    ResponseRows drawn = rows;
    for (int table = 0; table < tables; ++table) {
        std::map<long, double> effects;
        for (std::size_t i = 0; i < rows.size.size(); ++i) {
            const double x = truth.scale.log_size ? std::log(rows.size[i]) : rows.size[i];
            double y = model.at(x);
            if (model.between > 0.0) {
                const auto [effect, added] = effects.try_emplace(rows.specimen[i], 0.0);
                if (added) {
                    effect->second = normal();
                }
                y += scatter[i] * model.between * effect->second;
            }
            y += scatter[i] * model.within * normal();
            const double power = truth.scale.power;
            const double least = 1e-6;  // of 1 + power y, below which there is no such response
            if (power != 0.0 && power != 1.0 && 1.0 + power * y < least) {
                y = (least - 1.0) / power;
            }
            drawn.value[i] = truth.scale.value(y);
        }
        if (!std::ranges::all_of(drawn.value, [](double value) { return std::isfinite(value); })) {
            continue;
        }
        const auto fits = fit_scales(drawn, by_specimen, request, true);
        if (const SignalResponseFit* best = best_scale(fits, request.accept_failed_checks)) {
            use(fits, *best);
        }
    }
}

SimulatedLimits::SimulatedLimits(const ResponseRows& rows, bool by_specimen,
                                 const SignalResponseFit& truth,
                                 const SignalResponseRequest& request) {
    // Censored repeats and Box and Cox's power take many times as long.
    tables_ = by_specimen && request.limits.any()  ? 200
              : std::isnan(request.powers.front()) ? 400
                                                   : 1000;
    log_size_ = truth.scale.log_size;
    const auto [smallest, largest] = std::minmax_element(rows.size.begin(), rows.size.end());
    double size[kSizes], threshold[kSizes][kDistances];
    for (int i = 0; i < kSizes; ++i) {
        const double share = static_cast<double>(i) / (kSizes - 1);
        const auto scaled = [&](double value) {
            return truth.scale.log_size ? std::log(value) : value;
        };
        x_[i] = scaled(*smallest) + share * (scaled(*largest) - scaled(*smallest));
        size[i] = truth.scale.log_size ? std::exp(x_[i]) : x_[i];
        for (int j = 0; j < kDistances; ++j) {
            const double away = alarm_sign(request.alarm) * truth.model.sigma * kGridDistances[j];
            threshold[i][j] = truth.scale.value(truth.model.at(x_[i]) - away);
        }
    }
    std::vector<double> errors[kSizes][kDistances];
    simulate_responses(rows, by_specimen, truth, request, tables_, false,
                       [&](const std::vector<SignalResponseFit>&, const SignalResponseFit& fit) {
                           ++fitted_;
                           for (int i = 0; i < kSizes; ++i) {
                               for (int j = 0; j < kDistances; ++j) {
                                   const LineDistance found =
                                       line_distance(fit, size[i], threshold[i][j], request.alarm);
                                   const double error = (found.u - kGridDistances[j]) / found.error;
                                   if (std::isfinite(error)) {
                                       errors[i][j].push_back(error);
                                   }
                               }
                           }
                       });
    for (int i = 0; i < kSizes; ++i) {
        for (int j = 0; j < kDistances; ++j) {
            std::vector<double>& values = errors[i][j];
            std::ranges::sort(values);
            // Distances that the scale of the response does not have take the limits of others.
            const bool none = values.empty();
            const double share = request.confidence;
            limit_[0][i][j] = none ? (j > 0 ? limit_[0][i][j - 1] : kNan)
                                   : std::max(0.0, sorted_quantile(values, share));
            limit_[1][i][j] = none ? (j > 0 ? limit_[1][i][j - 1] : kNan)
                                   : std::min(0.0, sorted_quantile(values, 1.0 - share));
        }
        for (int j = kDistances - 2; j >= 0; --j) {
            for (auto& limit : limit_) {
                limit[i][j] = std::isnan(limit[i][j]) ? limit[i][j + 1] : limit[i][j];
            }
        }
    }
}

std::string too_few_tables(int tables, double confidence) {
    return tables * (1.0 - confidence) > 1.0 - 1e-9
               ? ""
               : fmt::format(
                     "{} simulated tables give no calibrated bounds at {:g} % confidence; "
                     "lower it, or choose an asymptotic convention",
                     tables, 100.0 * confidence);
}

double SimulatedLimits::at(double size, double u, int bound) const {
    const double x = log_size_ ? std::log(size) : size;
    const auto cell = [](const double* grid, int count, double value) {
        int i = 0;
        while (i + 2 < count && value > grid[i + 1]) {
            ++i;
        }
        const double share = (value - grid[i]) / (grid[i + 1] - grid[i]);
        return std::pair(i, std::clamp(share, 0.0, 1.0));
    };
    const auto [i, by_size] = cell(x_, kSizes, x);
    const auto [j, by_distance] = cell(kGridDistances, kDistances, u);
    const auto& limit = limit_[bound < 0 ? 0 : 1];
    const auto along = [&](int row) {
        return limit[row][j] + by_distance * (limit[row][j + 1] - limit[row][j]);
    };
    return along(i) + by_size * (along(i + 1) - along(i));
}

namespace {

// Bounds by a test of every size and distance u: a pair is on the inner side of the bound if the
// table does not reject it.
class TestedBounds : public ResponseBounds {
  public:
    TestedBounds(const SignalResponseFit& fit, double threshold, Alarm alarm)
        : fit_(fit), threshold_(threshold), alarm_(alarm) {}

    SizeBounds size(double pod, double smallest, double largest) const override {
        const double u = link_quantile(Link::probit, pod);
        const auto size_estimate = [&](int bound) -> SizeEstimate {
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
        return {size_estimate(0), size_estimate(1), size_estimate(-1)};
    }

    PodPoint point(double size) const override {
        const double u = distance(size).u;
        const auto pod = [&](int bound) {
            const auto beyond = [&](double tried) { return -excess(size, tried, bound); };
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
