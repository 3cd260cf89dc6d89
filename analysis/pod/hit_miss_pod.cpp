#include "analysis/pod/hit_miss_pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "analysis/detection/threshold.hpp"
#include "machine/contracts.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kLackOfFit = 0.05;
constexpr double kSupported = 2.0;  // difference in AIC
constexpr double kBoundedPod = 0.9;

// Reason why no curve can be fitted to these outcomes, or "".
std::string outcome_refusal(const HitMissTable& table,
                            const std::string& tested = HitMissRequest{}.tested) {
    if (table.empty()) {
        return fmt::format("no {} has a value", tested);
    }
    const double hits = total_hits(table);
    if (hits == 0.0) {
        return fmt::format("no {} was detected: a90 is not reached at any tested size", tested);
    }
    if (hits == total_tests(table)) {
        return fmt::format("every {} was detected: smaller sizes must be tested to locate a90",
                           tested);
    }
    if (table.size() < 2) {
        return "only one fault size, a curve needs at least two";
    }
    return {};
}

// True if the hits and misses, which both exist, do not overlap. Then the likelihood without a
// floor has no maximum: A. Albert, J. A. Anderson, Biometrika 71 (1984), 1-10.
bool separated(const HitMissTable& table) {
    const auto missed = [](const HitMissRow& row) { return row.hits < row.tests; };
    const auto found = [](const HitMissRow& row) { return row.hits > 0.0; };
    EXPECTS(std::ranges::any_of(table, found) && std::ranges::any_of(table, missed));
    const auto first = [&](const auto& outcome) {
        return std::ranges::find_if(table, outcome)->size;
    };
    const auto last = [&](const auto& outcome) {
        return std::find_if(table.rbegin(), table.rend(), outcome)->size;
    };
    return first(found) >= last(missed) || first(missed) >= last(found);
}

struct Fitted {
    HitMissFit fit;
    PodLikelihood::Maximum maximum;
};

// Standardised sizes and logarithms of sizes, computed on first use.
class Scales {
  public:
    explicit Scales(const HitMissTable& table) : table_(table) {}

    PodLikelihood likelihood(const PodForm& form) {
        std::shared_ptr<const StandardisedSizes>& sizes = sizes_[form.log_size ? 1 : 0];
        if (!sizes) {
            sizes = std::make_shared<const StandardisedSizes>(table_, form.log_size);
        }
        return {sizes, form};
    }

  private:
    const HitMissTable& table_;
    std::shared_ptr<const StandardisedSizes> sizes_[2];
};

// Fits one form, without goodness of fit. `start`: fit of a nested form, to start from.
Fitted fit_form(const HitMissTable& table, Scales& scales, const PodForm& form,
                const Fitted* start = nullptr) {
    Fitted result;
    HitMissFit& fit = result.fit;
    fit.curve.form = form;
    fit.log_likelihood = fit.aic = kNan;
    fit.refusal = outcome_refusal(table);
    if (!fit.refusal.empty()) {
        return result;
    }
    if (form.floor == 0.0 && !form.free_ceiling && !form.firth && separated(table)) {
        fit.refusal = "hits and misses do not overlap in size, so a curve of any steepness fits";
        return result;
    }
    if (static_cast<int>(table.size()) < form.parameters()) {
        fit.refusal = "fewer sizes than parameters";
        return result;
    }
    const PodLikelihood likelihood = scales.likelihood(form);
    std::optional<PodLikelihood::Parameters> from;
    if (start != nullptr && start->fit.refusal.empty()) {
        from = start->maximum.parameters;
    } else if (form.free_ceiling) {
        PodForm without = form;
        without.free_ceiling = false;
        from = scales.likelihood(without).maximise().parameters;
    }
    result.maximum = likelihood.maximise(from);
    const PodLikelihood::Maximum& maximum = result.maximum;
    fit.curve = likelihood.curve(maximum.parameters);
    fit.log_likelihood = maximum.log_likelihood;
    fit.aic = 2.0 * form.parameters() - 2.0 * (maximum.log_likelihood - maximum.penalty);
    if (!form.firth && likelihood.sizes_in_transition(maximum.parameters) < 2) {
        fit.refusal = "the rate rises between two tested sizes, so any steeper slope fits as well";
    } else if (!maximum.converged) {
        fit.refusal = "the maximum-likelihood fit does not converge";
    } else if (form.free_ceiling && fit.curve.ceiling >= 1.0 - 1e-9) {
        fit.refusal = "the fitted ceiling is 1";
    }
    return result;
}

void add_goodness(HitMissFit& fit, const HitMissTable& table) {
    if (fit.refusal.empty()) {
        fit.fit = goodness_of_fit(table, fit.curve);
    }
}

std::vector<PodForm> forms(const HitMissRequest& request) {
    std::vector<PodForm> all;
    for (const Link link : request.links) {
        for (const bool log_size : request.log_sizes) {
            if (request.without_floor || request.floor == 0.0) {
                all.push_back({link, log_size, 0.0, false, request.firth});
            }
            if (request.floor > 0.0) {
                all.push_back({link, log_size, request.floor, false, request.firth});
            }
            if (request.fit_ceiling) {
                all.push_back({link, log_size, request.floor, true});
            }
        }
    }
    return all;
}

std::vector<double> band_sizes(const HitMissPod& pod, int points) {
    std::vector<double> sizes;
    for (int i = 0; i < points; ++i) {
        sizes.push_back(pod.smallest + (pod.largest - pod.smallest) * i / (points - 1));
    }
    return sizes;
}

// Adds curves with a fitted ceiling where these have less AIC than the best without. `fitted` must
// have the capacity. Returns the fit of least AIC.
const Fitted* add_needed_ceilings(const HitMissTable& table, Scales& scales,
                                  std::vector<Fitted>& fitted, const Fitted* best,
                                  HitMissPod& pod) {
    const double least = best->fit.aic;
    const std::size_t count = fitted.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!fitted[i].fit.refusal.empty() || fitted[i].fit.aic > least + 2.0 * kSupported) {
            continue;
        }
        PodForm form = fitted[i].fit.curve.form;
        form.free_ceiling = true;
        Fitted more = fit_form(table, scales, form, &fitted[i]);
        add_goodness(more.fit, table);
        if (more.fit.refusal.empty() && more.fit.aic < least + kSupported) {
            pod.candidates.push_back(more.fit);
            fitted.push_back(std::move(more));
            best = fitted.back().fit.aic < best->fit.aic ? &fitted.back() : best;
        }
    }
    return best;
}

bool is_clustered(const HitMissRequest& request) {
    return count_clusters(request.outcomes) < static_cast<long>(request.outcomes.size());
}

// Location and scale of a curve without fitted ceiling.
LocationScale location_scale_of(const PodCurve& curve, const HitMissRequest& request) {
    return location_scale(curve.intercept, curve.slope,
                          curve_covariance(request.outcomes, curve, is_clustered(request)));
}

// Replaces a calibrated rule by the likelihood ratio with the limit for these outcomes. Returns a
// refusal, or "".
std::string calibrate(HitMissPod& pod, const std::vector<Fitted>& fitted,
                      const HitMissRequest& request) {
    pod.rule = one_sided_bound(request.confidence);
    if (!is_clustered(request)) {
        return "";
    }
    pod.clusters = count_clusters(request.outcomes);
    if (pod.clusters < kFewestClusters) {
        return fmt::format("outcomes of only {} {}s, bounds need at least {}", pod.clusters,
                           request.tested, kFewestClusters);
    }
    const Fitted* plain = nullptr;
    for (const Fitted& other : fitted) {
        if (other.fit.refusal.empty() && !other.fit.curve.form.free_ceiling &&
            (plain == nullptr || other.fit.aic < plain->fit.aic)) {
            plain = &other;
        }
    }
    if (plain == nullptr) {
        return "repeated outcomes need a curve without fitted ceiling";
    }
    pod.design_effect = design_effect(request.outcomes, plain->fit.curve);
    pod.rule.chi_squared =
        clustered_chi_squared(pod.design_effect, pod.clusters, request.confidence);
    return "";
}

// Share of tables simulated from the chosen curve in which the same analysis holds its a90. NaN if
// a90 is not among the tested sizes.
double coverage_of_bound(const HitMissPod& pod, const HitMissRequest& request) {
    HitMissRequest again = request;
    again.simulated_tables = 0;
    again.band_points = 2;
    again.target.reset();
    std::mt19937_64 engine(20230417);
    std::vector<double> sizes;
    for (const ClusteredOutcome& outcome : request.outcomes) {
        sizes.push_back(outcome.size);
    }
    std::vector<char> hits(sizes.size());
    int answered = 0, held = 0;
    for (int t = 0; t < request.simulated_tables; ++t) {
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            hits[i] =
                static_cast<double>(engine() >> 11) * 0x1p-53 < pod.chosen.curve.pod(sizes[i]);
            again.outcomes[i].hit = hits[i] != 0;
        }
        const HitMissPod found = hit_miss_pod(hit_miss_table(sizes, hits), again);
        if (found.refusal.empty()) {
            ++answered;
            held += place_of(found.a90.upper) >= pod.a90.estimate.size;
        }
    }
    return answered == 0 ? kNan : static_cast<double>(held) / answered;
}

// Number of specimens for a90's bound at the target, as a factor on the number tested, by Wald or
// likelihood-ratio bounds.
double factor_for(double target, const HitMissPod& pod, const Fitted& best, Scales& scales,
                  const HitMissRequest& request) {
    if (pod.rule.method == BoundMethod::likelihood_ratio) {
        return specimens_for_bound(scales.likelihood(best.fit.curve.form), best.maximum,
                                   kBoundedPod, target, pod.rule);
    }
    const LocationScale wald = location_scale_of(best.fit.curve, request);
    return wald_specimens(wald, best.fit.curve.form, kBoundedPod, target, pod.rule.limit());
}

// Sets the bounds from the first curve, or widens them to one more curve's.
void add_bounds(HitMissPod& pod, const HitMissTable& table, Scales& scales, const Fitted& fitted,
                const HitMissRequest& request) {
    const std::vector<double> sizes = band_sizes(pod, request.band_points);
    SizeBounds a50, a90;
    std::vector<PodPoint> band;
    if (pod.rule.method == BoundMethod::wald) {
        const PodCurve& curve = fitted.fit.curve;
        const LocationScale wald = location_scale_of(curve, request);
        a50 = wald_size_bounds(wald, curve.form, 0.5, pod.rule.limit(), pod.smallest, pod.largest);
        a90 = wald_size_bounds(wald, curve.form, kBoundedPod, pod.rule.limit(), pod.smallest,
                               pod.largest);
        band = wald_band(wald, curve.form, pod.rule.limit(), sizes);
    } else {
        const PodLikelihood likelihood = scales.likelihood(fitted.fit.curve.form);
        a50 = size_bounds(table, likelihood, fitted.maximum, 0.5, pod.rule);
        a90 = size_bounds(table, likelihood, fitted.maximum, kBoundedPod, pod.rule);
        band = pod_band(likelihood, fitted.maximum, sizes, pod.rule);
    }
    pod.supported.push_back(fitted.fit.curve.form);
    if (pod.supported.size() == 1) {
        pod.a50 = a50;
        pod.a90 = a90;
        pod.band = band;
        return;
    }
    pod.a50 = widest(pod.a50, a50);
    pod.a90 = widest(pod.a90, a90);
    for (std::size_t i = 0; i < band.size(); ++i) {
        pod.band[i].lower = std::min(pod.band[i].lower, band[i].lower);
        pod.band[i].upper = std::max(pod.band[i].upper, band[i].upper);
    }
}

}  // namespace

HitMissFit fit_hit_miss(const HitMissTable& table, const PodForm& form) {
    Scales scales(table);
    HitMissFit fit = fit_form(table, scales, form).fit;
    add_goodness(fit, table);
    return fit;
}

std::vector<std::optional<SizeEstimate>> sizes_by_form(const HitMissTable& table,
                                                       std::span<const PodForm> forms, double pod,
                                                       const BoundRule& rule,
                                                       std::optional<Side> side) {
    Scales scales(table);
    std::vector<std::optional<SizeEstimate>> sizes;
    for (const PodForm& form : forms) {
        const Fitted fitted = fit_form(table, scales, form);
        if (!fitted.fit.refusal.empty()) {
            sizes.push_back(std::nullopt);
            continue;
        }
        const PodLikelihood likelihood = scales.likelihood(form);
        sizes.push_back(side ? size_bound(table, likelihood, fitted.maximum, pod, rule, *side)
                             : size_estimate(table, likelihood, fitted.maximum, pod));
    }
    return sizes;
}

HitMissPod hit_miss_pod(const HitMissTable& table, const HitMissRequest& request) {
    HitMissPod pod;
    pod.tests = std::lround(total_tests(table));
    pod.hits = std::lround(total_hits(table));
    pod.smallest = table.empty() ? 0.0 : table.front().size;
    pod.largest = table.empty() ? 0.0 : table.back().size;
    pod.rule = request.rule.value_or(one_sided_bound(request.confidence));
    pod.refusal = outcome_refusal(table, request.tested);
    if (!pod.refusal.empty()) {
        return pod;
    }
    if (!(request.floor >= 0.0 && request.floor < 1.0)) {
        throw std::invalid_argument("hit/miss POD: the floor must be 0 to below 1");
    }
    if (pod.rule.method == BoundMethod::wald && (request.fit_ceiling || request.outcomes.empty())) {
        throw std::invalid_argument(
            "hit/miss POD: Wald bounds need the individual outcomes and no fitted ceiling");
    }
    Scales scales(table);
    std::vector<Fitted> fitted;
    const Fitted* best = nullptr;
    fitted.reserve(2 * forms(request).size());
    for (const PodForm& form : forms(request)) {
        const bool more = !fitted.empty() && fitted.back().fit.curve.form.link == form.link &&
                          fitted.back().fit.curve.form.log_size == form.log_size;
        fitted.push_back(fit_form(table, scales, form, more ? &fitted.back() : nullptr));
        add_goodness(fitted.back().fit, table);
        const HitMissFit& fit = fitted.back().fit;
        pod.candidates.push_back(fit);
        if (fit.refusal.empty() && (best == nullptr || fit.aic < best->fit.aic)) {
            best = &fitted.back();
        }
    }
    if (best == nullptr) {
        pod.refusal = pod.candidates.front().refusal;
        return pod;
    }
    if (pod.rule.method == BoundMethod::calibrated && !request.fit_ceiling && !request.firth) {
        best = add_needed_ceilings(table, scales, fitted, best, pod);
    }
    pod.chosen = best->fit;
    if (!(best->fit.curve.slope > 0.0)) {
        pod.refusal = "the detection rate does not rise with the fault size";
        return pod;
    }
    pod.doubtful = best->fit.fit.p_value < kLackOfFit;
    if (pod.rule.method == BoundMethod::calibrated) {
        pod.refusal = calibrate(pod, fitted, request);
        if (!pod.refusal.empty()) {
            return pod;
        }
    }
    add_bounds(pod, table, scales, *best, request);
    if (!request.outcomes.empty() && !pod.chosen.curve.form.free_ceiling) {
        pod.covariance = location_scale_of(pod.chosen.curve, request).covariance;
    }
    if (request.target) {
        pod.specimens_factor = factor_for(*request.target, pod, *best, scales, request);
    }
    for (const Fitted& other : fitted) {
        if (&other != best && other.fit.refusal.empty() && other.fit.curve.slope > 0.0 &&
            other.fit.aic <= best->fit.aic + kSupported) {
            add_bounds(pod, table, scales, other, request);
        }
    }
    if (request.simulated_tables > 0 && !request.outcomes.empty() && !is_clustered(request) &&
        pod.a90.estimate.where == SizeEstimate::Where::reached) {
        pod.simulated_coverage = coverage_of_bound(pod, request);
    }
    return pod;
}

std::vector<int> outcomes(std::span<const double> values, double threshold, Alarm alarm) {
    std::vector<int> hit;
    for (const double value : values) {
        hit.push_back(!std::isfinite(value) ? -1 : is_alarm(value, threshold, alarm) ? 1 : 0);
    }
    return hit;
}

HitMissPod pod_of_outcomes(std::span<const double> sizes, const std::vector<int>& hit,
                           const LevelDetection& detection, double confidence, int band_points) {
    HitMissPod pod;
    if (std::isnan(detection.threshold)) {
        pod.refusal = "no threshold";
        return pod;
    }
    if (!(detection.healthy_rate >= 0.0 && detection.healthy_rate < 1.0)) {
        pod.refusal = "the healthy test gearboxes contradict the threshold";
        return pod;
    }
    std::vector<double> tested;
    std::vector<char> detected;
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i] >= 0) {
            tested.push_back(sizes[i]);
            detected.push_back(hit[i] == 1 ? 1 : 0);
        }
    }
    return hit_miss_pod(hit_miss_table(tested, detected),
                        {detection.healthy_rate, confidence, band_points});
}

}  // namespace gearpod::analysis
