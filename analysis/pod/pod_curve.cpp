#include "analysis/pod/pod_curve.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gearpod::analysis {

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
