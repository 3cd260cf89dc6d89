#include "analysis/pod/bound_rule.hpp"

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

}  // namespace gearpod::analysis
