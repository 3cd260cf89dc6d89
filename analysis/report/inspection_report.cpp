#include "analysis/report/inspection_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

constexpr int kDigits = 4;

// Facts that both kinds of curve have in common.
struct FittedCurve {
    const std::string& refusal;
    const SizeBounds &a50, &a90;
    double smallest, largest;
    const BoundRule& rule;
    double location, scale;
    const Eigen::Matrix2d& covariance;
    bool log_size;
    double simulated_coverage;
};

FittedCurve curve_of(const HitMissPod& pod) {
    const PodCurve& curve = pod.chosen.curve;
    return {pod.refusal,
            pod.a50,
            pod.a90,
            pod.smallest,
            pod.largest,
            pod.rule,
            -curve.intercept / curve.slope,
            1.0 / curve.slope,
            pod.covariance,
            curve.form.log_size,
            pod.simulated_coverage};
}

FittedCurve curve_of(const SignalResponsePod& pod) {
    const bool fitted = pod.refusal.empty();
    return {pod.refusal,
            pod.a50,
            pod.a90,
            pod.band.empty() ? kNan : pod.band.front().size,
            pod.band.empty() ? kNan : pod.band.back().size,
            pod.rule,
            pod.curve.location,
            pod.curve.scale,
            pod.curve.covariance,
            fitted && pod.candidates[pod.chosen].scale.log_size,
            pod.simulated_coverage};
}

FittedCurve curve_of(const SmoothResponse& smooth) {
    static const std::string none;
    static const BoundRule calibrated{BoundMethod::calibrated, 0.0};
    static const Eigen::Matrix2d unknown = Eigen::Matrix2d::Constant(kNan);
    return {none,       smooth.a50(), smooth.a90(), smooth.smallest(), smooth.largest(),
            calibrated, kNan,         kNan,         unknown,           false,
            kNan};
}

FittedCurve curve_of(const InspectionRequest& request, const InspectionResult& result) {
    return !request.responses  ? curve_of(result.hit_miss)
           : is_smooth(result) ? curve_of(*result.smooth)
                               : curve_of(result.signal_response);
}

// Measured coverage of default bounds of tables of the same kind, or "".
std::string measured_text(const InspectionRequest& request, const InspectionResult& result) {
    if (request.convention != BoundConvention::calibrated || request.confidence != 0.95) {
        return "";
    }
    const MeasuredCoverage* row =
        measured_coverage(kind_of_table(request, result), result.specimens);
    const MeasuredCoverage* never = measured_coverage(kCeiling85, result.specimens);
    return fmt::format(
               "In tables of known truth ({}, {} specimens), such upper and lower bounds held a90 "
               "in {} and {} %.",
               row->kind, row->specimens, number_text(row->upper_per_cent, 3),
               number_text(row->lower_per_cent, 3)) +
           (request.responses || result.repeats > 0
                ? ""
                : fmt::format(" Where the POD levelled off at 85 %, {} % of tables of {} specimens "
                              "stated a bound although there is no a90.",
                              number_text(100.0 - never->upper_per_cent, 3), never->specimens));
}

std::string size_text(const SizeEstimate& estimate, const FittedCurve& curve,
                      const SizeUnit& unit) {
    return size_estimate_text(estimate, curve.smallest, curve.largest, unit, kDigits);
}

std::string bound_name(const InspectionRequest& request) {
    return "a90/" + number_text(100.0 * request.confidence, 6);
}

Section inspection_headline(const InspectionRequest& request, const InspectionResult& result,
                            const SizeUnit& unit) {
    const FittedCurve curve = curve_of(request, result);
    Section section{"headline", "", {}};
    if (!curve.refusal.empty()) {
        section.state("headline", fmt::format("No detection curve: {}.", curve.refusal),
                      Shown::screen);
        return section;
    }
    const std::string shown = unit.shown_unit();
    const auto text = [&](const SizeEstimate& estimate) {
        return size_text(estimate, curve, unit) + (shown.empty() ? "" : " " + shown);
    };
    section.state("headline",
                  fmt::format("90 % of flaws of {} are found (a90); its upper bound {} is {}.",
                              text(curve.a90.estimate), bound_name(request), text(curve.a90.upper)),
                  Shown::screen);
    Table table{"sizes",
                "Sizes with their bounds" + (shown.empty() ? "" : " (" + shown + ")"),
                {"size", "estimate", "lower bound", "upper bound"},
                {},
                Shown::screen};
    for (const auto& [name, bounds] :
         {std::pair{"a50", &curve.a50}, std::pair{"a90", &curve.a90}}) {
        table.rows.push_back({name, size_text(bounds->estimate, curve, unit),
                              size_text(bounds->lower, curve, unit),
                              size_text(bounds->upper, curve, unit)});
    }
    section.add(std::move(table));
    section.state("bound",
                  fmt::format("{} is the upper bound of a90: {}{}.", bound_name(request),
                              bound_text(curve.rule),
                              request.convention == BoundConvention::handbook
                                  ? " (the handbook's convention, MIL-HDBK-1823A)"
                                  : ""),
                  Shown::screen);
    if (std::isfinite(curve.simulated_coverage)) {
        section.state(
            "coverage",
            fmt::format("{}In tables simulated from this fit, the bound covered a90 in {}.",
                        request.convention == BoundConvention::calibrated
                            ? ""
                            : "This convention is asymptotic. ",
                        percent_text(curve.simulated_coverage)));
    }
    section.state("measured_coverage", measured_text(request, result));
    return section;
}

std::string parameters_text(const FittedCurve& curve) {
    const Eigen::Matrix2d& covariance = curve.covariance;
    return fmt::format(
        "Location {}, scale {} of the {}{}.", number_text(curve.location, 6),
        number_text(curve.scale, 6), curve.log_size ? "size's natural logarithm" : "size",
        covariance.allFinite()
            ? fmt::format("; covariance {}, {}, {}", number_text(covariance(0, 0), kDigits),
                          number_text(covariance(0, 1), kDigits),
                          number_text(covariance(1, 1), kDigits))
            : "");
}

std::string repeats_text(const InspectionResult& result) {
    const HitMissPod& pod = result.hit_miss;
    if (result.repeats == 0) {
        return "";
    }
    if (result.once_per_specimen) {
        return "Every specimen counts once, divided over its repeated outcomes.";
    }
    return pod.clusters == 0
               ? "Repeated outcomes of one specimen are correlated: the bounds are Wald bounds "
                 "with "
                 "cluster-robust covariance."
               : fmt::format(
                     "Repeated outcomes of one specimen are correlated: the likelihood ratio is "
                     "divided by the design effect {} of {} specimens (robust covariance), with "
                     "the limit of t with {} degrees of freedom.",
                     number_text(pod.design_effect), pod.clusters, pod.clusters - 2);
}

void add_hits(Section& section, const InspectionResult& result) {
    const HitMissPod& pod = result.hit_miss;
    if (!pod.refusal.empty()) {
        section.state("firth",
                      pod.refusal.find("do not overlap") == std::string::npos
                          ? ""
                          : "Firth's penalty (--firth) fits such outcomes.",
                      Shown::screen);
        return;
    }
    const PodCurve& curve = pod.chosen.curve;
    section.state(
        "curve",
        fmt::format("Curve: {}{}; {}; the bounds cover {} of {} candidate curves.",
                    form_text(curve.form),
                    curve.form.free_ceiling ? " at " + number_text(curve.ceiling) : "",
                    fit_text(pod.chosen.fit), pod.supported.size(), pod.candidates.size()));
    section.state("parameters", parameters_text(curve_of(pod)));
    section.state("warning.0",
                  pod.doubtful ? "Warning: the goodness-of-fit test rejects the curve." : "");
    section.state("repeats", repeats_text(result));
    section.state("warning.1", pod.clusters > 0 && pod.clusters < kFewClusters
                                   ? fmt::format("Warning: only {} specimens with repeated "
                                                 "outcomes; the bounds need {} to be reliable.",
                                                 pod.clusters, kFewClusters)
                                   : "");
    const bool ceiling_fitted = std::any_of(pod.supported.begin(), pod.supported.end(),
                                            [](const PodForm& form) { return form.free_ceiling; });
    section.state("ceiling", ceiling_fitted
                                 ? "The bounds include curves that level off below 1."
                                 : "The curves assume that large enough flaws are always found.");
    if (result.tests_above > 0) {
        section.state("demonstrated",
                      fmt::format("Without a curve, the {} of {} flaws found above the upper bound "
                                  "of a90 show a POD of {}.",
                                  result.hits_above, result.tests_above,
                                  percent_text(result.demonstrated_pod)));
    }
}

// Curve that was fitted because no line passes the checks, or why there is none.
void add_smooth(Section& section, const InspectionResult& result, const InspectionNames& names) {
    if (!is_smooth(result)) {
        section.state("smooth", result.smooth
                                    ? fmt::format("No curve either: {}.", result.smooth->refusal())
                                    : "");
        return;
    }
    const SmoothResponse& smooth = *result.smooth;
    const auto pod_text = [&](double size) {
        return fmt::format("{} with scatter {} at {}", number_text(smooth.mean(size), kDigits),
                           number_text(smooth.scatter(size), kDigits),
                           with_unit(size, names.size, kDigits));
    };
    section.state("line", fmt::format("No line: {}.", result.signal_response.refusal));
    section.state(
        "smooth",
        fmt::format("Instead a monotone curve was fitted, with a scatter that is a power of the "
                    "size ({}): {}, {}. Its residuals are normal (Anderson-Darling: p = {:.2g}).",
                    number_text(smooth.growth(), 3), pod_text(smooth.smallest()),
                    pod_text(smooth.largest()), smooth.normality()));
    section.state("correlation",
                  result.repeats > 0
                      ? fmt::format("Two values of one specimen have a correlation of {}.",
                                    number_text(smooth.correlation(), 3))
                      : "");
}

void add_line(Section& section, const InspectionRequest& request, const InspectionResult& result,
              const InspectionNames& names) {
    const SignalResponsePod& pod = result.signal_response;
    section.state("threshold",
                  fmt::format("Decision threshold: {} {} {}; censored: {} below, {} above.",
                              names.value, alarm_symbol(request.alarm),
                              quantity_text(result.threshold, names.unit, 6), pod.left, pod.right));
    if (!pod.refusal.empty()) {
        add_smooth(section, result, names);
        section.state("scales",
                      pod.candidates.empty() && pod.specimens == pod.count
                          ? ""
                          : "To fit a line anyway, give both --size-scale and --response-scale.");
        return;
    }
    const SignalResponseFit& fit = pod.candidates[pod.chosen];
    section.state(
        "curve",
        fmt::format(
            "Line: {}, intercept {}, slope {}, scatter {}{}{}.", fit.scale.text(),
            number_text(fit.model.intercept, 6), number_text(fit.model.slope, 6),
            number_text(fit.model.sigma, 6),
            fit.model.between > 0.0
                ? fmt::format(" ({} between specimens, {} within)",
                              number_text(fit.model.between, 6), number_text(fit.model.within, 6))
                : "",
            pod.supported.size() > 1 ? fmt::format("; the bounds span {} of {} scales",
                                                   pod.supported.size(), pod.candidates.size())
                                     : ""));
    section.state("parameters", parameters_text(curve_of(pod)));
    for (std::size_t i = 0; i < fit.doubts.size(); ++i) {
        section.state(fmt::format("warning.{}", i), "Warning: " + fit.doubts[i] + ".");
    }
    section.state("warning.specimens",
                  pod.specimens < pod.count && pod.specimens < kFewClusters
                      ? fmt::format("Warning: only {} specimens; their checks have "
                                    "little power.",
                                    pod.specimens)
                      : "");
    constexpr double kOften = 0.1;
    section.state(
        "growing",
        pod.growing_answered >= kOften
            ? fmt::format("If the scatter grew in proportion to the size, {} of such tables would "
                          "pass the checks, and the bound would hold a90 in {} of these.",
                          percent_text(pod.growing_answered), percent_text(pod.growing_coverage))
            : "");
}

void add_false_calls(Section& section, const InspectionRequest& request,
                     const InspectionResult& result) {
    if (result.without_flaw == 0) {
        return;
    }
    section.state("false_calls",
                  fmt::format("False calls: {} of {} without flaw, [{}, {}] (Clopper-Pearson).",
                              result.false_calls, result.without_flaw,
                              rate_text(result.false_call_bounds.lower),
                              rate_text(result.false_call_bounds.upper)));
    for (std::size_t i = 0; i < result.noise.size(); ++i) {
        const NoiseDistribution& law = result.noise[i];
        const bool high = request.alarm == Alarm::high;
        section.state(
            fmt::format("noise.{}", i),
            fmt::format(
                "Noise: {} distribution ({}, {}), false-call probability {} (AIC {}).",
                noise_distribution_name(law.kind), number_text(law.first, 5),
                number_text(law.second, 5),
                number_text(high ? law.above(result.threshold) : law.below(result.threshold)),
                number_text(law.aic, 5)),
            i > 0 ? Shown::page : Shown::full);
    }
}

Table trade_off_table(const InspectionRequest& request, const InspectionResult& result,
                      const SizeUnit& unit) {
    Table table{
        "trade_off",
        "By threshold: false calls against detectable size",
        {"threshold", "false calls", in_unit("a90", unit), in_unit(bound_name(request), unit)},
        {}};
    if (result.trade_off.empty()) {
        return table;
    }
    const FittedCurve curve = curve_of(result.signal_response);
    constexpr std::size_t kShown = 8;
    const std::size_t step = std::max<std::size_t>(1, result.trade_off.size() / kShown);
    for (std::size_t i = 0; i < result.trade_off.size(); i += step) {
        const TradeOffPoint& point = result.trade_off[i];
        table.rows.push_back({number_text(point.threshold, 5), number_text(point.false_calls),
                              size_text(point.a90.estimate, curve, unit),
                              size_text(point.a90.upper, curve, unit)});
    }
    return table;
}

std::string target_text(const InspectionRequest& request, const InspectionResult& result,
                        const SizeUnit& unit) {
    if (!request.target) {
        return "";
    }
    const double factor = request.responses ? result.signal_response.specimens_factor
                                            : result.hit_miss.specimens_factor;
    const std::string bound = bound_name(request),
                      target = with_unit(*request.target, unit, kDigits);
    if (std::isnan(factor)) {
        return fmt::format(
            "The number of specimens that {} at {} needs is computed for lines and hit/miss "
            "curves only.",
            bound, target);
    }
    if (!std::isfinite(factor)) {
        return fmt::format("More specimens cannot bring {} to {}: a90 itself is not below it.",
                           bound, target);
    }
    if (factor <= 1.0) {
        return fmt::format("{} is already below {}.", bound, target);
    }
    return fmt::format(
        "For {} at {}, {:.0f} more specimens like these {} are needed ({} times as many).", bound,
        target, std::ceil((factor - 1.0) * static_cast<double>(result.specimens)), result.specimens,
        number_text(factor));
}

void add_curve(Json& json, double location, double scale, const Eigen::Matrix2d& covariance) {
    json["location"] = number(location);
    json["scale"] = number(scale);
    json["covariance"] = {number(covariance(0, 0)), number(covariance(0, 1)),
                          number(covariance(1, 1))};
}

Json hit_miss_of(const HitMissPod& pod) {
    Json json = to_json(pod);
    if (pod.refusal.empty()) {
        const PodCurve& curve = pod.chosen.curve;
        add_curve(json, -curve.intercept / curve.slope, 1.0 / curve.slope, pod.covariance);
    }
    json["simulated_coverage"] = number(pod.simulated_coverage);
    json["clusters"] = pod.clusters;
    json["design_effect"] = number(pod.design_effect);
    return json;
}

Json responses_of(const InspectionResult& result) {
    const SignalResponsePod& pod = result.signal_response;
    Json json = to_json(pod);
    json["threshold"] = number(result.threshold);
    json["censored"] = {pod.left, pod.right};
    json["specimens"] = pod.specimens;
    json["bound"] = bound_text(pod.rule);
    json["simulated_coverage"] = number(pod.simulated_coverage);
    json["growing_scatter"] = {{"answered", number(pod.growing_answered)},
                               {"coverage", number(pod.growing_coverage)}};
    json["smallest"] = pod.band.empty() ? Json(nullptr) : number(pod.band.front().size);
    json["largest"] = pod.band.empty() ? Json(nullptr) : number(pod.band.back().size);
    json["smooth"] = nullptr;
    if (result.smooth && result.smooth->refusal().empty()) {
        const SmoothResponse& smooth = *result.smooth;
        json["smooth"] = {
            {"a50", json_of(smooth.a50())},        {"a90", json_of(smooth.a90())},
            {"smallest", smooth.smallest()},       {"largest", smooth.largest()},
            {"scatter_growth", smooth.growth()},   {"correlation", smooth.correlation()},
            {"band", columns_json(smooth.band())}, {"mean", Json::array()}};
        for (const PodPoint& point : smooth.band()) {
            json["smooth"]["mean"].push_back(smooth.mean(point.size));
        }
    }
    if (pod.refusal.empty()) {
        add_curve(json, pod.curve.location, pod.curve.scale, pod.curve.covariance);
        json["model"] = pod.candidates[pod.chosen].scale.text();
        json["doubts"] = pod.candidates[pod.chosen].doubts;
    }
    return json;
}

Json noise_of(const InspectionRequest& request, const InspectionResult& result) {
    Json laws = Json::array();
    for (const NoiseDistribution& law : result.noise) {
        const bool high = request.alarm == Alarm::high;
        laws.push_back({{"law", noise_distribution_name(law.kind)},
                        {"first", number(law.first)},
                        {"second", number(law.second)},
                        {"aic", number(law.aic)},
                        {"at_threshold", number(high ? law.above(result.threshold)
                                                     : law.below(result.threshold))}});
    }
    return {{"calls", result.false_calls},
            {"of", result.without_flaw},
            {"lower", number(result.false_call_bounds.lower)},
            {"upper", number(result.false_call_bounds.upper)},
            {"laws", laws}};
}

}  // namespace

Report inspection_report(const InspectionRequest& request, const InspectionResult& result,
                         const InspectionNames& names) {
    Section remarks{"remarks", "", {}};
    for (std::size_t i = 0; i < names.remarks.size(); ++i) {
        remarks.state(fmt::format("remark.{}", i), names.remarks[i], Shown::screen);
    }
    Section method{"method", "", {}};
    method.state(
        "table",
        fmt::format(
            "{}: {} over {}, {} specimens{}.", names.table, names.value, names.size.name,
            result.specimens,
            result.repeats > 0 ? fmt::format(" and {} repeated measurements", result.repeats) : ""),
        Shown::screen);
    if (request.responses) {
        add_line(method, request, result, names);
    } else {
        add_hits(method, result);
    }
    add_false_calls(method, request, result);
    method.add(trade_off_table(request, result, names.size));
    method.state("all_found",
                 fmt::format("At a single size, {} specimens without a miss show a POD of "
                             "90 % at {} confidence.",
                             result.all_found, percent_text(request.confidence)),
                 Shown::screen);
    method.state("target", target_text(request, result, names.size), Shown::screen);
    Report report;
    if (!names.remarks.empty()) {
        report.add(std::move(remarks));
    }
    report.add(inspection_headline(request, result, names.size));
    report.add(std::move(method));
    return report;
}

nlohmann::json inspection_json(const Inspections& data, const InspectionRequest& request,
                               const InspectionResult& result, const InspectionNames& words) {
    const double factor = request.responses ? result.signal_response.specimens_factor
                                            : result.hit_miss.specimens_factor;
    const double more = (factor - 1.0) * static_cast<double>(result.specimens);
    return {{"kind", "inspection"},
            {"table", words.table},
            {"size", json_of(words.size)},
            {"value", {{"name", words.value}, {"unit", words.unit}}},
            {"confidence", request.confidence},
            {"convention", convention_name(request.convention)},
            {"specimens", result.specimens},
            {"repeats", result.repeats},
            {"refusal", text_or_null(result.refusal)},
            {"data", {{"size", data.size}, {"value", data.value}}},
            {"hit_miss", request.responses ? Json(nullptr) : hit_miss_of(result.hit_miss)},
            {"signal_response",
             request.responses && result.refusal.empty() ? responses_of(result) : Json(nullptr)},
            {"false_calls", noise_of(request, result)},
            {"trade_off", json_of(result.trade_off)},
            {"more_specimens",
             {{"target", json_of(request.target)},
              {"factor", number(factor)},
              {"more", std::isfinite(more) ? Json(std::max(0.0, std::ceil(more))) : Json(nullptr)},
              {"all_found", result.all_found}}},
            {"findings", findings_json(inspection_report(request, result, words))}};
}

}  // namespace gearpod::analysis
