#include "analysis/pod/pod_bounds.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Where = SizeEstimate::Where;
constexpr double kAtEnd = 1e-12;
constexpr int kSizeBits = 22;  // relative accuracy of a size bound: 2e-7
constexpr int kBandBits = 12;  // relative accuracy of a band: 2e-4

// Signed distance to the bound in terms of the square root of the deviance, which is nearly linear.
class Profile {
  public:
    Profile(const PodLikelihood& likelihood, const PodLikelihood::Maximum& maximum,
            const BoundRule& rule)
        : likelihood_(likelihood),
          maximum_(maximum),
          last_(maximum.parameters),
          limit_(rule.limit()) {}

    double beyond(double u, double pod) {
        auto held = likelihood_.maximise_through(u, pod, last_);
        if (likelihood_.form().free_ceiling) {
            // With a free ceiling, the last point's curve may lead to a lower maximum.
            const auto other = likelihood_.maximise_through(u, pod, maximum_.parameters);
            if (other.log_likelihood > held.log_likelihood) {
                held = other;
            }
        }
        last_ = held.parameters;
        const double deviance = 2.0 * (maximum_.log_likelihood - held.log_likelihood);
        return std::sqrt(std::max(0.0, deviance)) - limit_;
    }
    double limit() const { return limit_; }
    void restart() { last_ = maximum_.parameters; }

  private:
    const PodLikelihood& likelihood_;
    const PodLikelihood::Maximum& maximum_;
    PodLikelihood::Parameters last_;
    double limit_;
};

// Root between `inside`, where the function is negative, and `outside`, where it is `value` > 0.
template <typename Function>
double crossing(Function beyond, double inside, double outside, double at_inside, double value,
                int bits) {
    auto steps = static_cast<std::uintmax_t>(bits);  // as many as bisection would need
    const boost::math::tools::eps_tolerance<double> tolerance(static_cast<unsigned>(bits));
    const bool up = outside > inside;
    const auto bracket =
        up ? boost::math::tools::toms748_solve(beyond, inside, outside, at_inside, value, tolerance,
                                               steps, QuietPolicy())
           : boost::math::tools::toms748_solve(beyond, outside, inside, value, at_inside, tolerance,
                                               steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

SizeEstimate size_estimate(const HitMissTable& table, const PodLikelihood& likelihood,
                           const PodLikelihood::Maximum& maximum, double pod) {
    // A curve at its floor already reaches lower rates.
    if (pod <= likelihood.form().floor) {
        return {Where::below_tested, kNan};
    }
    const auto size = likelihood.curve(maximum.parameters).size_at(pod);
    return size ? estimate_within(*size, table.front().size, table.back().size)
                : SizeEstimate{Where::not_reached, kNan};
}

SizeEstimate size_bound(const HitMissTable& table, const PodLikelihood& likelihood,
                        const PodLikelihood::Maximum& maximum, double pod, const BoundRule& rule,
                        Side side) {
    const SizeEstimate outside{side == Side::lower ? Where::below_tested : Where::not_reached,
                               kNan};
    const SizeEstimate estimate = size_estimate(table, likelihood, maximum, pod);
    const auto size = likelihood.curve(maximum.parameters).size_at(pod);
    if (estimate.where == outside.where || pod <= likelihood.form().floor || !size) {
        return estimate;
    }
    double inner = likelihood.standardised(table.front().size);
    double edge = likelihood.standardised(table.back().size);
    if (side == Side::lower) {
        std::swap(inner, edge);
    }
    Profile profile(likelihood, maximum, rule);
    const auto beyond = [&](double tried) { return profile.beyond(tried, pod); };
    // An estimate outside the tested sizes may have its bound outside as well.
    if (estimate.where != Where::reached && beyond(inner) > 0.0) {
        return estimate;
    }
    profile.restart();
    // Searches outwards in growing steps, each from the last one's curve. The first step is
    // somewhat longer than Wald's error, and short enough not to miss a range of sizes that the
    // bound leaves.
    const double u = likelihood.standardised(*size), span = edge - u;
    const Eigen::Matrix2d information = maximum.information.topLeftCorner<2, 2>();
    const Eigen::Vector2d direction(1.0, u);
    const double error = std::sqrt(direction.dot(information.ldlt().solve(direction))) /
                         std::abs(maximum.parameters[1]);
    constexpr double kLongestShare = 1.0 / 32.0, kShortestShare = 1e-6;
    double share = 1.2 * profile.limit() * error / std::abs(span);
    share = share > kShortestShare ? std::min(share, kLongestShare) : kLongestShare;
    double inside = u, at_inside = -profile.limit();
    for (;; share *= 2.0) {
        const double tried = share < 1.0 ? u + share * span : edge;
        const double value = beyond(tried);
        if (value > 0.0) {
            return {Where::reached,
                    likelihood.size(crossing(beyond, inside, tried, at_inside, value, kSizeBits))};
        }
        if (share >= 1.0) {
            return outside;
        }
        inside = tried;
        at_inside = value;
    }
}

SizeBounds size_bounds(const HitMissTable& table, const PodLikelihood& likelihood,
                       const PodLikelihood::Maximum& maximum, double pod, const BoundRule& rule) {
    return {size_estimate(table, likelihood, maximum, pod),
            size_bound(table, likelihood, maximum, pod, rule, Side::lower),
            size_bound(table, likelihood, maximum, pod, rule, Side::upper)};
}

std::vector<PodPoint> pod_band(const PodLikelihood& likelihood,
                               const PodLikelihood::Maximum& maximum,
                               const std::vector<double>& sizes, const BoundRule& rule) {
    const PodForm& form = likelihood.form();
    const PodCurve curve = likelihood.curve(maximum.parameters);
    Profile profile(likelihood, maximum, rule);
    const Eigen::Matrix2d information = maximum.information.topLeftCorner<2, 2>();
    const Eigen::LDLT<Eigen::Matrix2d> solver(information);
    const double least = maximum.log_likelihood - 0.5 * profile.limit() * profile.limit();
    PodLikelihood::Parameters extremes[] = {maximum.parameters, maximum.parameters};
    std::vector<PodPoint> band;
    for (const double size : sizes) {
        const double u = likelihood.standardised(size);
        // Along zeta, POD = floor + (1 - floor) F(zeta): eta itself if the ceiling is 1.
        const auto pod_of = [&](double zeta) {
            return form.floor + (1.0 - form.floor) * link_probability(form.link, zeta);
        };
        PodPoint point{size, curve.pod(size), form.floor, 1.0};
        // Zeta is infinite where the curve equals its floor, or 1, to the last digit. The search
        // for a bound then starts from next to that end.
        const double share = std::clamp((point.pod - form.floor) / (1.0 - form.floor), 0.0, 1.0);
        const double zeta =
            std::clamp(link_quantile(form.link, share), link_quantile(form.link, kAtEnd),
                       link_upper_quantile(form.link, kAtEnd));
        const Eigen::Vector2d direction(1.0, u);
        const double se = std::sqrt(direction.dot(solver.solve(direction)));
        // The step is limited where the likelihood is flat: the bound lies before the end of the
        // range. At a confidence of 1/2 the limit is 0.
        constexpr double kShortest = 1e-6, kLongest = 0.5;
        const double first_step =
            se > 0.0 ? std::clamp(1.2 * profile.limit() * se, kShortest, kLongest) : kLongest;
        for (const double sign : {-1.0, 1.0}) {
            double& bound = sign < 0.0 ? point.lower : point.upper;
            const int side = sign < 0.0 ? -1 : 1;
            PodLikelihood::Parameters& start = extremes[sign < 0.0 ? 0 : 1];
            const auto found = [&](const std::optional<double>& extreme) {
                return extreme && sign * (pod_of(*extreme) - point.pod) >= -kAtEnd;
            };
            auto extreme = likelihood.extreme_zeta(u, least, side, start);
            if (!found(extreme)) {  // the curve of the last size may be a poor start
                start = maximum.parameters;
                extreme = likelihood.extreme_zeta(u, least, side, start);
            }
            if (found(extreme)) {
                bound = pod_of(*extreme);
                continue;
            }
            profile.restart();
            const auto beyond = [&](double tried) { return profile.beyond(u, pod_of(tried)); };
            double inside = zeta, at_inside = -profile.limit();
            for (double step = first_step; std::isfinite(zeta); step *= 2.0) {
                const double outside = zeta + sign * step;
                if (pod_of(outside) < form.floor + kAtEnd || pod_of(outside) > 1.0 - kAtEnd) {
                    break;  // the bound is the end itself
                }
                const double value = beyond(outside);
                if (value > 0.0) {
                    bound = pod_of(crossing(beyond, inside, outside, at_inside, value, kBandBits));
                    break;
                }
                inside = outside;
                at_inside = value;
            }
        }
        band.push_back(point);
    }
    return band;
}

double specimens_for_bound(const PodLikelihood& likelihood, const PodLikelihood::Maximum& maximum,
                           double pod, double size, const BoundRule& rule) {
    const auto estimate = likelihood.curve(maximum.parameters).size_at(pod);
    if (!estimate || !(*estimate < size)) {
        return std::numeric_limits<double>::infinity();
    }
    Profile profile(likelihood, maximum, rule);
    const double root = profile.beyond(likelihood.standardised(size), pod) + profile.limit();
    return rule.chi_squared / (root * root);
}

SizeBounds widest(const SizeBounds& a, const SizeBounds& b) {
    SizeBounds wide = a;
    if (place_of(b.lower) < place_of(a.lower)) {
        wide.lower = b.lower;
    }
    if (place_of(b.upper) > place_of(a.upper)) {
        wide.upper = b.upper;
    }
    return wide;
}

}  // namespace gearpod::analysis
