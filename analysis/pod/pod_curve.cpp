#include "analysis/pod/pod_curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {
namespace {

double square(double value) {
    return value * value;
}

}  // namespace

double BoundRule::limit() const {
    return std::sqrt(chi_squared);
}

BoundRule one_sided_bound(double confidence, BoundMethod method) {
    return {method, square(link_quantile(Link::probit, confidence))};
}

BoundRule two_sided_bound(double confidence, BoundMethod method) {
    return {method, square(link_quantile(Link::probit, 0.5 * (1.0 + confidence)))};
}

BoundRule joint_bound(double confidence, BoundMethod method) {
    return {method, -2.0 * std::log1p(-confidence)};
}

std::string bound_text(const BoundRule& rule) {
    switch (rule.method) {
        case BoundMethod::wald:
            return fmt::format("Wald, {:.4g} standard errors", rule.limit());
        case BoundMethod::calibrated:
            return "calibrated on simulated tables";
        case BoundMethod::exact:
            return "exact, noncentral t distribution";
        case BoundMethod::likelihood_ratio:
            break;
    }
    return fmt::format("likelihood ratio, chi-squared {:.4g}", rule.chi_squared);
}

double PodForm::scaled(double size) const {
    return log_size ? std::log(size) : size;
}

double PodForm::size(double scaled) const {
    return log_size ? std::exp(scaled) : scaled;
}

std::string form_text(const PodForm& form) {
    std::string text =
        fmt::format("{} of {}", link_name(form.link), form.log_size ? "log size" : "size");
    if (form.floor > 0.0) {
        text += fmt::format(", floor {:.3g}", form.floor);
    }
    if (form.free_ceiling) {
        text += ", ceiling fitted";
    }
    if (form.firth) {
        text += ", Firth's penalty";
    }
    return text;
}

double PodCurve::pod(double size) const {
    const double eta = intercept + slope * form.scaled(size);
    return form.floor + (ceiling - form.floor) * link_probability(form.link, eta);
}

std::optional<double> PodCurve::size_at(double pod) const {
    if (!(pod > form.floor && pod < ceiling && slope > 0.0)) {
        return std::nullopt;
    }
    const double eta = link_quantile(form.link, (pod - form.floor) / (ceiling - form.floor));
    return form.size((eta - intercept) / slope);
}

}  // namespace gearpod::analysis
