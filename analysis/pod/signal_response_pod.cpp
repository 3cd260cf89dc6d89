#include "analysis/pod/signal_response_pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Where = SizeEstimate::Where;
constexpr std::size_t kFewest = 10;  // points for the checks to mean anything

struct Points {
    std::vector<double> size, response;
};

SignalResponseFit fit_scales(const Points& points, double threshold, bool log_size,
                             bool log_response, Alarm alarm) {
    SignalResponseFit fit;
    fit.log_size = log_size;
    fit.log_response = log_response;
    fit.aic = kNan;
    const double lowest = *std::min_element(points.response.begin(), points.response.end());
    if (log_response && !(std::min(lowest, threshold) > 0.0)) {
        fit.refusals.push_back("values or threshold are not positive, there is no logarithm");
        return fit;
    }
    std::vector<double> x = points.size, y = points.response;
    double jacobian = 0.0;
    if (log_size) {
        std::transform(x.begin(), x.end(), x.begin(), [](double v) { return std::log(v); });
    }
    if (log_response) {
        for (double& value : y) {
            value = std::log(value);
            jacobian += value;
        }
    }
    fit.line = regression_line(x, y);
    if (!(fit.line.sum_xx > 0.0)) {
        fit.refusals.push_back("the fault sizes are alike but for rounding");
        return fit;
    }
    const auto n = static_cast<double>(x.size());
    const double scale = std::max(std::abs(y.front()), std::abs(y.back()));
    if (!(fit.line.sigma > 1e-12 * scale)) {
        fit.refusals.push_back("the values do not scatter");
        return fit;
    }
    const double variance = fit.line.sigma * fit.line.sigma * (n - 2.0) / n;
    fit.aic = n * (std::log(2.0 * std::numbers::pi * variance) + 1.0) + 2.0 * jacobian + 6.0;
    if (!(fit.line.slope * (alarm == Alarm::high ? 1.0 : -1.0) > 0.0)) {
        fit.refusals.push_back("the feature does not move to the alarm side with the fault size");
    }
    fit.checks = {linearity_check(x, y, fit.line), constant_variance_check(x, y, fit.line),
                  normality_check(x, y, fit.line)};
    const char* what[] = {"not linear", "variance not constant", "residuals not normal"};
    for (std::size_t c = 0; c < fit.checks.size(); ++c) {
        if (!(fit.checks[c].p_value >= kCheckLevel)) {
            fit.refusals.push_back(fmt::format("{} ({}: p = {:.2g})", what[c], fit.checks[c].test,
                                               fit.checks[c].p_value));
        }
    }
    return fit;
}

// The standardised distance of the line beyond the threshold, and its bounds.
class Distance {
  public:
    Distance(const SignalResponseFit& fit, double threshold, Alarm alarm, double confidence)
        : fit_(fit),
          threshold_(fit.log_response ? std::log(threshold) : threshold),
          side_(alarm == Alarm::high ? 1.0 : -1.0),
          z_(link_quantile(Link::probit, confidence)) {}

    // `bound` -1, 0, 1: lower bound, estimate, upper bound.
    double at(double size, int bound) const {
        const double x = fit_.log_size ? std::log(size) : size;
        const double u = side_ * (fit_.line.at(x) - threshold_) / fit_.line.sigma;
        const double freedom = static_cast<double>(fit_.line.count) - 2.0;
        const double se = std::sqrt(fit_.line.leverage(x) + u * u / (2.0 * freedom));
        return u + bound * z_ * se;
    }

    SizeEstimate size_at(double pod, int bound, double smallest, double largest) const {
        const double target = link_quantile(Link::probit, pod);
        const auto miss = [&](double size) { return at(size, bound) - target; };
        if (miss(largest) < 0.0) {
            return {Where::not_reached, kNan};
        }
        if (miss(smallest) >= 0.0) {
            return {Where::below_tested, kNan};
        }
        std::uintmax_t steps = 100;
        const auto bracket = boost::math::tools::toms748_solve(
            miss, smallest, largest, boost::math::tools::eps_tolerance<double>(40), steps,
            QuietPolicy());
        return {Where::reached, 0.5 * (bracket.first + bracket.second)};
    }

  private:
    const SignalResponseFit& fit_;
    double threshold_, side_, z_;
};

SizeBounds size_bounds(const Distance& distance, double pod, double smallest, double largest) {
    // A higher POD at a size means a smaller size for a POD.
    return {distance.size_at(pod, 0, smallest, largest),
            distance.size_at(pod, 1, smallest, largest),
            distance.size_at(pod, -1, smallest, largest)};
}

std::string candidates_refusal(const std::vector<SignalResponseFit>& candidates) {
    std::string text = "no scale passes the checks: ";
    for (const SignalResponseFit& fit : candidates) {
        text += fmt::format("{}{} of {}: {}", &fit == &candidates.front() ? "" : "; ",
                            fit.log_response ? "log value" : "value",
                            fit.log_size ? "log size" : "size", fmt::join(fit.refusals, ", "));
    }
    return text;
}

}  // namespace

SignalResponsePod signal_response_pod(std::span<const double> sizes,
                                      std::span<const double> responses, double threshold,
                                      Alarm alarm, double confidence, int band_points) {
    Points points;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] > 0.0 && std::isfinite(responses[i])) {
            points.size.push_back(sizes[i]);
            points.response.push_back(responses[i]);
        }
    }
    SignalResponsePod pod;
    pod.count = static_cast<long>(points.size.size());
    const std::set<double> distinct(points.size.begin(), points.size.end());
    if (!std::isfinite(threshold)) {
        pod.refusal = "no threshold";
    } else if (points.size.size() < kFewest) {
        pod.refusal = fmt::format("{} faulty gearboxes with a value, the checks need {}",
                                  points.size.size(), kFewest);
    } else if (distinct.size() < 3) {
        pod.refusal = fmt::format("{} fault sizes, linearity needs three", distinct.size());
    }
    if (!pod.refusal.empty()) {
        return pod;
    }
    const SignalResponseFit* best = nullptr;
    for (const bool log_response : {false, true}) {
        for (const bool log_size : {false, true}) {
            pod.candidates.push_back(fit_scales(points, threshold, log_size, log_response, alarm));
        }
    }
    for (const SignalResponseFit& fit : pod.candidates) {
        if (fit.refusals.empty() && (best == nullptr || fit.aic < best->aic)) {
            best = &fit;
        }
    }
    if (best == nullptr) {
        pod.refusal = candidates_refusal(pod.candidates);
        return pod;
    }
    pod.chosen = static_cast<std::size_t>(best - pod.candidates.data());
    const Distance distance(*best, threshold, alarm, confidence);
    const double smallest = *distinct.begin(), largest = *distinct.rbegin();
    pod.a50 = size_bounds(distance, 0.5, smallest, largest);
    pod.a90 = size_bounds(distance, 0.9, smallest, largest);
    for (int i = 0; i < band_points; ++i) {
        const double size = smallest + (largest - smallest) * i / (band_points - 1);
        pod.band.push_back({size, link_probability(Link::probit, distance.at(size, 0)),
                            link_probability(Link::probit, distance.at(size, -1)),
                            link_probability(Link::probit, distance.at(size, 1))});
    }
    return pod;
}

}  // namespace gearpod::analysis
