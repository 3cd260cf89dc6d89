#include "analysis/pod/response_fit.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "analysis/statistics/gauss_rule.hpp"

namespace gearpod::analysis {
namespace {

const double kLogRootTwoPi = 0.5 * std::log(2.0 * std::numbers::pi);

// ln Phi(z), far out by its asymptotic series (Abramowitz and Stegun 26.2.12).
double log_normal_probability(double z) {
    if (z > -30.0) {
        return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
    }
    const double r = 1.0 / (z * z);
    return -0.5 * z * z - std::log(-z) - kLogRootTwoPi +
           std::log1p(-r * (1.0 - 3.0 * r * (1.0 - 5.0 * r)));
}

double log_censored(const Response& response, double mean, double sigma) {
    return log_normal_probability(response.censored * (mean - response.y) / sigma);
}

const GaussRule& rule(bool coarse) {
    static const GaussRule fine_nodes = normal_gauss_rule(48);
    static const GaussRule coarse_nodes = normal_gauss_rule(6);
    return coarse ? coarse_nodes : fine_nodes;
}

// Mean and root mean square deviation.
template <typename Get>
std::pair<double, double> moments(const std::vector<Response>& responses, Get get) {
    double sum = 0.0, squares = 0.0;
    for (const Response& response : responses) {
        sum += get(response);
    }
    const auto count = static_cast<double>(responses.size());
    for (const Response& response : responses) {
        squares += std::pow(get(response) - sum / count, 2);
    }
    return {sum / count, std::sqrt(squares / count)};
}

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

ResponseLikelihood::ResponseLikelihood(std::vector<Response> responses, bool by_specimen,
                                       bool coarse)
    : responses_(std::move(responses)), by_specimen_(by_specimen), coarse_(coarse) {
    std::tie(x_centre_, x_spread_) = moments(responses_, [](const Response& r) { return r.x; });
    std::tie(y_centre_, y_spread_) = moments(responses_, [](const Response& r) { return r.y; });
    if (responses_.size() < 3 || !(x_spread_ > 0.0 && y_spread_ > 0.0)) {
        throw std::invalid_argument("response likelihood: needs at least three values that differ");
    }
    for (Response& response : responses_) {
        response.x = (response.x - x_centre_) / x_spread_;
        response.y = (response.y - y_centre_) / y_spread_;
        constant_ -= response.censored == 0 ? std::log(y_spread_) : 0.0;
    }
    if (by_specimen_) {
        std::stable_sort(
            responses_.begin(), responses_.end(),
            [](const Response& a, const Response& b) { return a.specimen < b.specimen; });
    }
}

double ResponseLikelihood::of_specimen(std::size_t first, std::size_t last,
                                       const Line& line) const {
    const double within = line.within, between = line.between;
    const auto mean = [&](const Response& r) { return line.intercept + line.slope * r.x; };
    double count = 0.0, sum = 0.0, squares = 0.0;
    bool any_censored = false;
    for (std::size_t i = first; i < last; ++i) {
        if (responses_[i].censored != 0) {
            any_censored = true;
            continue;
        }
        const double left = (responses_[i].y - mean(responses_[i])) / within;
        count += 1.0;
        sum += left;
        squares += left * left;
    }
    // Log-likelihood of the uncensored responses, and the conditional distribution of the specimen
    // effect given them.
    const double ratio = between * between / (within * within);
    const double growth = 1.0 + count * ratio;
    double value = -count * (kLogRootTwoPi + std::log(within)) - 0.5 * std::log(growth) -
                   0.5 * (squares - ratio * sum * sum / growth);
    if (!any_censored) {
        return value;
    }
    const double centre = ratio * sum / growth * within;
    const double width = between / std::sqrt(growth);
    const GaussRule& nodes = rule(coarse_);
    std::vector<double> terms;
    for (Eigen::Index k = 0; k < nodes.nodes.size(); ++k) {
        double term = std::log(nodes.weights[k]);
        for (std::size_t i = first; i < last; ++i) {
            if (responses_[i].censored != 0) {
                term += log_censored(responses_[i],
                                     mean(responses_[i]) + centre + width * nodes.nodes[k], within);
            }
        }
        terms.push_back(term);
    }
    const double most = *std::max_element(terms.begin(), terms.end());
    double total = 0.0;
    for (const double term : terms) {
        total += std::exp(term - most);
    }
    return value + most + std::log(total);
}

double ResponseLikelihood::log_likelihood(const Line& line) const {
    double sum = constant_;
    if (by_specimen_) {
        for (std::size_t first = 0, last = 0; first < responses_.size(); first = last) {
            while (last < responses_.size() &&
                   responses_[last].specimen == responses_[first].specimen) {
                ++last;
            }
            sum += of_specimen(first, last, line);
        }
        return sum;
    }
    const double constant = -kLogRootTwoPi - std::log(line.within);
    for (const Response& r : responses_) {
        const double mean = line.intercept + line.slope * r.x;
        const double z = (r.y - mean) / line.within;
        sum += r.censored == 0 ? constant - 0.5 * z * z : log_censored(r, mean, line.within);
    }
    return sum;
}

Curvature ResponseLikelihood::curvature(const Eigen::VectorXd& p) const {
    const double sigma = std::exp(p[2]);
    Eigen::Vector3d score = Eigen::Vector3d::Zero();
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (const Response& r : responses_) {
        // Derivatives by the mean in sigmas and by ln sigma.
        const double z = (r.y - p[0] - p[1] * r.x) / sigma;
        double by_mean = z, by_sigma = z * z - 1.0;
        double mean_mean = 1.0, mean_sigma = 2.0 * z, sigma_sigma = 2.0 * z * z;
        if (r.censored != 0) {
            const double away = -r.censored * z;
            const double ratio =
                std::exp(-0.5 * away * away - kLogRootTwoPi - log_normal_probability(away));
            const double bend = ratio * (away + ratio);
            by_mean = r.censored * ratio;
            by_sigma = -away * ratio;
            mean_mean = bend;
            mean_sigma = r.censored * (ratio - bend * away);
            sigma_sigma = bend * away * away - ratio * away;
        }
        const Eigen::Vector3d row(1.0 / sigma, r.x / sigma, 0.0);
        score += by_mean * row;
        score[2] += by_sigma;
        information += mean_mean * row * row.transpose();
        information.col(2) += mean_sigma * row;
        information(2, 2) += sigma_sigma;
    }
    information.row(2).head<2>() = information.col(2).head<2>();
    return {score, information};
}

Eigen::VectorXd ResponseLikelihood::start_with_specimens() const {
    struct Sums {
        double count = 0.0, x = 0.0, y = 0.0;
    };
    std::vector<Sums> specimens;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < responses_.size(); ++i) {
        const Response& r = responses_[i];
        if (i == 0 || r.specimen != responses_[i - 1].specimen) {
            specimens.emplace_back();
        }
        Sums& sums = specimens.back();
        sums = {sums.count + 1.0, sums.x + r.x, sums.y + r.y};
        xx += r.x * r.x;
        xy += r.x * r.y;
        yy += r.y * r.y;
    }
    const auto total = static_cast<double>(responses_.size());
    Eigen::VectorXd best(4);
    // Generalised least squares for a logarithm of between over within; returns minus twice the
    // profile log likelihood.
    const auto miss = [&](double log_ratio) {
        const double ratio = std::exp(2.0 * log_ratio);
        double n = 0.0, x = 0.0, y = 0.0, sxx = xx, sxy = xy, syy = yy, growth = 0.0;
        for (const Sums& sums : specimens) {
            const double share = ratio / (1.0 + sums.count * ratio);
            n += sums.count - share * sums.count * sums.count;
            x += sums.x - share * sums.count * sums.x;
            y += sums.y - share * sums.count * sums.y;
            sxx -= share * sums.x * sums.x;
            sxy -= share * sums.x * sums.y;
            syy -= share * sums.y * sums.y;
            growth += std::log1p(sums.count * ratio);
        }
        const double determinant = n * sxx - x * x;
        const double slope = (n * sxy - x * y) / determinant, intercept = (y - slope * x) / n;
        const double left = std::max(1e-12, (syy - intercept * y - slope * sxy) / total);
        const double within = 0.5 * std::log(left);
        best << intercept, slope, within, within + log_ratio;
        return total * std::log(left) + growth;
    };
    constexpr double kWidest = 6.0;
    constexpr int kBits = 12;
    miss(boost::math::tools::brent_find_minima(miss, -kWidest, kWidest, kBits).first);
    return best;
}

ResponseLikelihood::Maximum ResponseLikelihood::maximise() const {
    const auto value = [&](const Eigen::VectorXd& p) {
        return log_likelihood({p[0], p[1], std::exp(p[2]), by_specimen_ ? std::exp(p[3]) : 0.0});
    };
    NumericMaximum found;
    // Starts from least squares with censored values at their limits.
    if (by_specimen_) {
        found = numeric_maximum(value, start_with_specimens());
    } else {
        double slope = 0.0;
        for (const Response& r : responses_) {
            slope += r.x * r.y / static_cast<double>(responses_.size());
        }
        const double scatter = std::log(std::sqrt(std::max(1e-6, 1.0 - slope * slope)));
        found = numeric_maximum(
            value, [&](const Eigen::VectorXd& p) { return curvature(p); },
            Eigen::Vector3d(0.0, slope, scatter));
    }
    return {found.at, found.information, found.value, found.converged};
}

double ResponseLikelihood::maximum_through(double x, double y, double u,
                                           const Maximum& start) const {
    const double at_x = (x - x_centre_) / x_spread_, at_y = (y - y_centre_) / y_spread_;
    const auto value = [&](const Eigen::VectorXd& p) {
        const double within = std::exp(p[1]), between = by_specimen_ ? std::exp(p[2]) : 0.0;
        const double intercept = at_y + u * std::hypot(within, between) - p[0] * at_x;
        return log_likelihood({intercept, p[0], within, between});
    };
    const Eigen::VectorXd from = start.parameters.tail(start.parameters.size() - 1);
    return numeric_maximum(value, from).value;
}

bool ResponseLikelihood::has_between(const Maximum& maximum) const {
    constexpr double kLeastLogRatio = -5.0;  // of between over within
    return by_specimen_ && maximum.parameters[3] - maximum.parameters[2] > kLeastLogRatio;
}

ResponseModel ResponseLikelihood::model(const Maximum& maximum) const {
    const Eigen::VectorXd& p = maximum.parameters;
    ResponseModel model;
    const double scale = y_spread_ / x_spread_;
    model.slope = scale * p[1];
    model.intercept = y_centre_ + y_spread_ * p[0] - model.slope * x_centre_;
    model.within = y_spread_ * std::exp(p[2]);
    model.between = by_specimen_ ? y_spread_ * std::exp(p[3]) : 0.0;
    model.sigma = std::hypot(model.within, model.between);
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(3, p.size());
    by(0, 0) = y_spread_;
    by(0, 1) = -scale * x_centre_;
    by(1, 1) = scale;
    by(2, 2) = model.within * model.within / model.sigma;
    if (by_specimen_) {
        by(2, 3) = model.between * model.between / model.sigma;
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> solver(maximum.information);
    if (!solver.isInvertible()) {
        model.covariance.setConstant(kNan);
        return model;
    }
    model.covariance = by * solver.inverse() * by.transpose();
    return model;
}

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
