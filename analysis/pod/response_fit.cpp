#include "analysis/pod/response_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

struct Scaled {
    std::vector<double> x, y;  // uncensored values
    std::vector<Response> all;
    double jacobian = 0.0;  // log Jacobian of the density of the values relative to that of y
};

Scaled scaled(const ResponseRows& rows, const ResponseScale& scale, const CensoringLimits& limits) {
    Scaled out;
    for (std::size_t i = 0; i < rows.size.size(); ++i) {
        const double x = scale.log_size ? std::log(rows.size[i]) : rows.size[i];
        const int censored = limits.of(rows.value[i]);
        const double value = std::clamp(rows.value[i], limits.left, limits.right);
        out.all.push_back(
            {x, scale.y(value), censored, rows.specimen.empty() ? 0 : rows.specimen[i]});
        if (censored == 0) {
            out.x.push_back(x);
            out.y.push_back(out.all.back().y);
            out.jacobian += scale.power == 1.0 ? 0.0 : (scale.power - 1.0) * std::log(value);
        }
    }
    return out;
}

double lowest(const ResponseRows& rows, const CensoringLimits& limits) {
    return std::max(limits.left, *std::min_element(rows.value.begin(), rows.value.end()));
}

ResponseModel least_squares_model(const RegressionLine& line) {
    ResponseModel model;
    model.intercept = line.intercept;
    model.slope = line.slope;
    model.sigma = model.within = line.sigma;
    const double variance = line.sigma * line.sigma;
    const double of_slope = variance / line.sum_xx;
    model.covariance(0, 0) =
        variance / static_cast<double>(line.count) + line.mean_x * line.mean_x * of_slope;
    model.covariance(0, 1) = model.covariance(1, 0) = -line.mean_x * of_slope;
    model.covariance(1, 1) = of_slope;
    model.covariance(2, 2) = variance / (2.0 * (static_cast<double>(line.count) - 2.0));
    return model;
}

// Means of specimens, because values that share a random effect are not independent.
Scaled specimen_means(const Scaled& points) {
    std::map<long, std::array<double, 3>> sums;  // count, x, y
    for (const Response& response : points.all) {
        if (response.censored == 0) {
            auto& sum = sums.try_emplace(response.specimen).first->second;
            sum[0] += 1.0;
            sum[1] += response.x;
            sum[2] += response.y;
        }
    }
    Scaled means;
    for (const auto& [specimen, sum] : sums) {
        means.x.push_back(sum[1] / sum[0]);
        means.y.push_back(sum[2] / sum[0]);
    }
    return means;
}

void add_checks(SignalResponseFit& fit, const Scaled& points) {
    fit.checks = {linearity_check(points.x, points.y, fit.line),
                  constant_variance_check(points.x, points.y, fit.line),
                  normality_check(points.x, points.y, fit.line)};
    const char* what[] = {"not linear", "variance not constant", "residuals not normal"};
    for (std::size_t c = 0; c < fit.checks.size(); ++c) {
        if (!(fit.checks[c].p_value >= kCheckLevel)) {
            fit.doubts.push_back(fmt::format("{} ({}: p = {:.2g})", what[c], fit.checks[c].test,
                                             fit.checks[c].p_value));
        }
    }
}

void fit_by_likelihood(SignalResponseFit& fit, const Scaled& points, bool by_specimen,
                       bool coarse) {
    auto likelihood = std::make_shared<const ResponseLikelihood>(points.all, by_specimen, coarse);
    fit.maximum = likelihood->maximise();
    if (by_specimen && !likelihood->has_between(fit.maximum)) {
        likelihood = std::make_shared<const ResponseLikelihood>(points.all, false);
        fit.maximum = likelihood->maximise();
    }
    fit.likelihood = likelihood;
    fit.model = likelihood->model(fit.maximum);
    fit.log_likelihood = fit.maximum.log_likelihood + points.jacobian;
    fit.aic = 2.0 * static_cast<double>(fit.maximum.parameters.size()) - 2.0 * fit.log_likelihood;
    if (!fit.maximum.converged || !fit.model.covariance.allFinite()) {
        fit.refusals.push_back("the maximum-likelihood fit does not converge");
    }
}

}  // namespace

bool CensoringLimits::any() const {
    return std::isfinite(left) || std::isfinite(right);
}

int CensoringLimits::of(double value) const {
    return value <= left ? -1 : value >= right ? 1 : 0;
}

double ResponseScale::y(double value) const {
    return power == 1.0   ? value
           : power == 0.0 ? std::log(value)
                          : (std::pow(value, power) - 1.0) / power;
}

double ResponseScale::value(double y) const {
    return power == 1.0 ? y : power == 0.0 ? std::exp(y) : std::pow(1.0 + power * y, 1.0 / power);
}

std::string ResponseScale::text() const {
    const std::string of = log_size ? " of log size" : " of size";
    return power == 1.0   ? "value" + of
           : power == 0.0 ? "log value" + of
                          : fmt::format("value to the power {:.3g}{}", power, of);
}

SignalResponseFit fit_response(const ResponseRows& rows, const ResponseScale& scale,
                               const CensoringLimits& limits, LineMethod method, bool by_specimen,
                               double threshold, Alarm alarm, bool coarse) {
    SignalResponseFit fit;
    fit.scale = scale;
    fit.aic = fit.log_likelihood = kNan;
    if (scale.power != 1.0 && !(std::min(lowest(rows, limits), threshold) > 0.0)) {
        fit.refusals.push_back("values or threshold are not positive, which this scale requires");
        return fit;
    }
    const Scaled points = scaled(rows, scale, limits);
    const Scaled checked = by_specimen ? specimen_means(points) : points;
    if (checked.y.size() < 3) {
        fit.refusals.push_back(
            fmt::format("only {} values are not censored, three are needed", checked.y.size()));
        return fit;
    }
    fit.line = regression_line(checked.x, checked.y);
    if (!(fit.line.sum_xx > 0.0)) {
        fit.refusals.push_back("all fault sizes are equal");
        return fit;
    }
    const double largest = std::max(std::abs(points.y.front()), std::abs(points.y.back()));
    if (!(fit.line.sigma > 1e-12 * largest)) {
        fit.refusals.push_back("the values have no scatter");
        return fit;
    }
    if (method == LineMethod::maximum_likelihood) {
        fit_by_likelihood(fit, points, by_specimen, coarse);
    } else {
        const auto n = static_cast<double>(points.y.size());
        const double variance = fit.line.sigma * fit.line.sigma * (n - 2.0) / n;
        fit.model = least_squares_model(fit.line);
        fit.log_likelihood =
            points.jacobian - 0.5 * n * (std::log(2.0 * std::numbers::pi * variance) + 1.0);
        fit.aic = 6.0 - 2.0 * fit.log_likelihood;
    }
    if (!(fit.model.slope * alarm_sign(alarm) > 0.0)) {
        fit.refusals.push_back("the feature does not move to the alarm side as the fault grows");
    }
    add_checks(fit, checked);
    return fit;
}

std::optional<double> box_cox_power(const ResponseRows& rows, bool log_size,
                                    const CensoringLimits& limits, bool by_specimen, bool coarse) {
    if (!(lowest(rows, limits) > 0.0)) {
        return std::nullopt;
    }
    const auto miss = [&](double power) {
        const Scaled points = scaled(rows, {log_size, power}, limits);
        const ResponseLikelihood likelihood(points.all, by_specimen, coarse);
        return -(likelihood.maximise().log_likelihood + points.jacobian);
    };
    constexpr int kBits = 20;
    return boost::math::tools::brent_find_minima(miss, -2.0, 2.0, kBits).first;
}

std::vector<SignalResponseFit> fit_scales(const ResponseRows& rows, bool by_specimen,
                                          const SignalResponseRequest& request, bool coarse) {
    std::vector<SignalResponseFit> fits;
    for (const double power : request.powers) {
        for (const bool log_size : request.log_sizes) {
            ResponseScale scale{log_size, power};
            if (std::isnan(power)) {
                scale.power = box_cox_power(rows, log_size, request.limits, by_specimen, coarse)
                                  .value_or(0.0);
            }
            fits.push_back(fit_response(rows, scale, request.limits, request.method, by_specimen,
                                        request.threshold, request.alarm, coarse));
            if (std::isnan(power)) {
                fits.back().aic += 2.0;  // one more parameter
            }
        }
    }
    return fits;
}

const SignalResponseFit* best_scale(const std::vector<SignalResponseFit>& fits,
                                    bool accept_failed_checks) {
    const SignalResponseFit* best = nullptr;
    for (const SignalResponseFit& fit : fits) {
        const bool may = accept_failed_checks ? fit.refusals.empty() : fit.usable();
        if (may && (best == nullptr || fit.aic < best->aic)) {
            best = &fit;
        }
    }
    return best;
}

std::vector<std::size_t> supported_scales(const std::vector<SignalResponseFit>& fits,
                                          const SignalResponseFit& best,
                                          bool accept_failed_checks) {
    constexpr double kSupportedScale = 2.0;
    std::vector<std::size_t> supported{static_cast<std::size_t>(&best - fits.data())};
    for (const SignalResponseFit& fit : fits) {
        const bool may = accept_failed_checks ? fit.refusals.empty() : fit.usable();
        if (&fit != &best && may && fit.aic <= best.aic + kSupportedScale) {
            supported.push_back(static_cast<std::size_t>(&fit - fits.data()));
        }
    }
    return supported;
}

}  // namespace gearpod::analysis
