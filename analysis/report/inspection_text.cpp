#include "analysis/report/inspection_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/report/text_lines.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

constexpr int kDigits = 4;

// Sizes common to both kinds of curve.
struct Sizes {
    const SizeBounds &a50, &a90;
    double smallest, largest;
    const BoundRule& rule;
};

std::string row(const char* name, const SizeBounds& bounds, const Sizes& sizes,
                const SizeUnit& unit) {
    const auto text = [&](const SizeEstimate& estimate) {
        return size_estimate_text(estimate, sizes.smallest, sizes.largest, unit, kDigits);
    };
    return fmt::format("{:<8}{:>12}{:>14}{:>14}\n", name, text(bounds.estimate), text(bounds.lower),
                       text(bounds.upper));
}

void add_sizes(std::string& out, const Sizes& sizes, const InspectionRequest& request,
               const SizeUnit& unit) {
    const std::string shown = unit.shown_unit();
    out += fmt::format("{:<8}{:>12}{:>14}{:>14}{}\n", "size", "estimate", "lower bound",
                       "upper bound", shown.empty() ? "" : "  (" + shown + ")");
    out += row("a50", sizes.a50, sizes, unit) + row("a90", sizes.a90, sizes, unit);
    const double percent = 100.0 * request.confidence;
    const bool handbook = request.convention == BoundConvention::handbook;
    add_wrapped(
        out,
        fmt::format("a90/{:g} is the upper bound of a90: {}{}", percent, bound_text(sizes.rule),
                    handbook ? " (the handbook's convention, MIL-HDBK-1823A)" : ""),
        0);
}

void add_curve(std::string& out, double location, double scale, const Eigen::Matrix2d& covariance,
               bool log_size) {
    std::string text = fmt::format("location {:.6g}, scale {:.6g} of the {}", location, scale,
                                   log_size ? "size's natural logarithm" : "size");
    if (covariance.allFinite()) {
        text += fmt::format("; covariance {:.4g}, {:.4g}, {:.4g}", covariance(0, 0),
                            covariance(0, 1), covariance(1, 1));
    }
    add_wrapped(out, text, 4);
}

void add_hit_miss(std::string& out, const InspectionRequest& request,
                  const InspectionResult& result, const InspectionNames& words) {
    const HitMissPod& pod = result.hit_miss;
    if (!pod.refusal.empty()) {
        add_wrapped(out, "no curve: " + pod.refusal, 4);
        if (pod.refusal.find("do not overlap") != std::string::npos) {
            out += "Firth's penalty (--firth) fits such outcomes.\n";
        }
        return;
    }
    add_sizes(out, {pod.a50, pod.a90, pod.smallest, pod.largest, pod.rule}, request, words.size);
    const PodCurve& curve = pod.chosen.curve;
    add_wrapped(out,
                fmt::format("curve: {}{}; {}{}; the bounds cover {} of {} candidate curves",
                            form_text(curve.form),
                            curve.form.free_ceiling ? fmt::format(" at {:.3g}", curve.ceiling) : "",
                            fit_text(pod.chosen.fit), pod.doubtful ? " (rejected)" : "",
                            pod.supported.size(), pod.candidates.size()),
                4);
    add_curve(out, -curve.intercept / curve.slope, 1.0 / curve.slope, pod.covariance,
              curve.form.log_size);
    if (result.repeats > 0) {
        add_wrapped(out,
                    "Repeated outcomes of one specimen are correlated: the bounds are Wald bounds "
                    "with cluster-robust covariance.",
                    4);
    }
}

void add_responses(std::string& out, const InspectionRequest& request,
                   const InspectionResult& result, const InspectionNames& words) {
    const SignalResponsePod& pod = result.signal_response;
    out +=
        fmt::format("decision threshold: {} {} {:.6g}; censored: {} below, {} above\n", words.value,
                    alarm_symbol(request.alarm), result.threshold, pod.left, pod.right);
    if (!pod.refusal.empty()) {
        add_wrapped(out, "no curve: " + pod.refusal, 4);
        if (!pod.candidates.empty()) {
            out += "To fit anyway, give both --size-scale and --response-scale.\n";
        }
        return;
    }
    const SignalResponseFit& fit = pod.candidates[pod.chosen];
    add_sizes(out, {pod.a50, pod.a90, pod.band.front().size, pod.band.back().size, pod.rule},
              request, words.size);
    std::string line =
        fmt::format("line: {}, intercept {:.6g}, slope {:.6g}, scatter {:.6g}", fit.scale.text(),
                    fit.model.intercept, fit.model.slope, fit.model.sigma);
    if (fit.model.between > 0.0) {
        line += fmt::format(" ({:.6g} between specimens, {:.6g} within)", fit.model.between,
                            fit.model.within);
    }
    add_wrapped(out, line, 4);
    add_curve(out, pod.curve.location, pod.curve.scale, pod.curve.covariance, fit.scale.log_size);
    for (const std::string& doubt : fit.doubts) {
        add_wrapped(out, "warning: " + doubt, 4);
    }
}

void add_false_calls(std::string& out, const InspectionRequest& request,
                     const InspectionResult& result) {
    if (result.without_flaw == 0) {
        return;
    }
    add_wrapped(out,
                fmt::format("false calls: {} of {} without flaw, [{:.3g}, {:.3g}] "
                            "(Clopper-Pearson)",
                            result.false_calls, result.without_flaw, result.false_call_bounds.lower,
                            result.false_call_bounds.upper),
                4);
    if (!result.noise.empty()) {
        const NoiseDistribution& law = result.noise.front();
        const bool high = request.alarm == Alarm::high;
        add_wrapped(
            out,
            fmt::format("noise: {} distribution ({:.5g}, {:.5g}), false-call probability {:.3g}",
                        noise_distribution_name(law.kind), law.first, law.second,
                        high ? law.above(result.threshold) : law.below(result.threshold)),
            4);
    }
}

void add_trade_off(std::string& out, const InspectionResult& result, const SizeUnit& unit) {
    constexpr std::size_t kShown = 8;
    if (result.trade_off.empty()) {
        return;
    }
    const auto& band = result.signal_response.band;
    const auto text = [&](const SizeEstimate& estimate) {
        return size_estimate_text(estimate, band.front().size, band.back().size, unit, kDigits);
    };
    out += fmt::format("{:>12}{:>14}{:>12}{:>12}\n", "threshold", "false calls", "a90", "bound");
    const std::size_t step = std::max<std::size_t>(1, result.trade_off.size() / kShown);
    for (std::size_t i = 0; i < result.trade_off.size(); i += step) {
        const TradeOffPoint& point = result.trade_off[i];
        out += fmt::format(
            "{:>12.5g}{:>14}{:>12}{:>12}\n", point.threshold,
            std::isfinite(point.false_calls) ? fmt::format("{:.3g}", point.false_calls) : "-",
            text(point.a90.estimate), text(point.a90.upper));
    }
}

void add_more(std::string& out, const InspectionRequest& request, const InspectionResult& result,
              const SizeUnit& unit) {
    const double percent = 100.0 * request.confidence;
    add_wrapped(out,
                fmt::format("At a single size, {} specimens without a miss demonstrate a POD of 90 "
                            "% at {:g} % confidence.",
                            result.all_found, percent),
                0);
    if (!request.target) {
        return;
    }
    const double factor = request.responses ? result.signal_response.specimens_factor
                                            : result.hit_miss.specimens_factor;
    const std::string target = with_unit(*request.target, unit);
    if (std::isfinite(factor) && factor > 1.0) {
        add_wrapped(out,
                    fmt::format("For a90/{:g} at {}: {:.0f} more specimens like these {} are "
                                "needed ({:.3g} times as many)",
                                percent, target,
                                std::ceil((factor - 1.0) * static_cast<double>(result.specimens)),
                                result.specimens, factor),
                    4);
    } else if (std::isfinite(factor)) {
        out += fmt::format("a90/{:g} is already below {}.\n", percent, target);
    } else {
        out +=
            fmt::format("More specimens cannot bring a90/{:g} to {}: a90 itself is not below it.\n",
                        percent, target);
    }
}

}  // namespace

std::string inspection_text(const InspectionRequest& request, const InspectionResult& result,
                            const InspectionNames& words) {
    std::string out = fmt::format("{}: {} over {}, {} specimens", words.table, words.value,
                                  words.size.name, result.specimens);
    out += result.repeats > 0 ? fmt::format(" and {} repeated measurements\n", result.repeats)
                              : std::string("\n");
    if (!result.refusal.empty()) {
        add_wrapped(out, result.refusal, 4);
        return out;
    }
    if (request.responses) {
        add_responses(out, request, result, words);
    } else {
        add_hit_miss(out, request, result, words);
    }
    add_false_calls(out, request, result);
    add_trade_off(out, result, words.size);
    add_more(out, request, result, words.size);
    return out;
}

}  // namespace gearpod::analysis
