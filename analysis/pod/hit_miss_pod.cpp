#include "analysis/pod/hit_miss_pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "analysis/pod/pod_bounds.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kLackOfFit = 0.05;
constexpr double kSupported = 2.0;  // AIC

// Why no curve can be fitted to these outcomes at all, or "".
std::string outcome_refusal(const HitMissTable& table) {
    if (table.empty()) {
        return "no faulty gearbox gave a value";
    }
    const double hits = total_hits(table);
    if (hits == 0.0) {
        return "no faulty gearbox was detected: not reached at any tested size";
    }
    if (hits == total_tests(table)) {
        return "every faulty gearbox was detected: a90 lies below the smallest tested size";
    }
    if (table.size() < 2) {
        return "one fault size only, a curve needs two at least";
    }
    return {};
}

// The maximum of the likelihood without a floor exists only if hits and misses overlap:
// A. Albert, J. A. Anderson, Biometrika 71 (1984), 1-10.
bool separated(const HitMissTable& table) {
    const double smallest_miss = [&] {
        for (const HitMissRow& row : table) {
            if (row.hits < row.tests) {
                return row.size;
            }
        }
        return std::numeric_limits<double>::quiet_NaN();
    }();
    double largest_hit = std::numeric_limits<double>::quiet_NaN();
    for (const HitMissRow& row : table) {
        if (row.hits > 0.0) {
            largest_hit = row.size;
        }
    }
    return smallest_hit(table) >= largest_miss(table) || smallest_miss >= largest_hit;
}

struct Fitted {
    HitMissFit fit;
    PodLikelihood::Maximum maximum;
};

// Sizes and their logarithms, as far as forms ask for them.
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

// `start`: the maximum of a form with fewer terms of its own, if there is one.
Fitted fit_form(const HitMissTable& table, Scales& scales, const PodForm& form,
                const Fitted* start = nullptr) {
    Fitted result;
    HitMissFit& fit = result.fit;
    fit.curve.form = form;
    fit.log_likelihood = fit.aic = std::numeric_limits<double>::quiet_NaN();
    fit.refusal = outcome_refusal(table);
    if (!fit.refusal.empty()) {
        return result;
    }
    if (form.floor == 0.0 && !form.free_ceiling && separated(table)) {
        fit.refusal = "hits and misses do not overlap, any slope from some value on fits";
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
    fit.aic = 2.0 * form.parameters() - 2.0 * maximum.log_likelihood;
    if (likelihood.sizes_in_transition(maximum.parameters) < 2) {
        fit.refusal = "the rate steps up between two tested sizes, any steeper slope fits as well";
    } else if (!maximum.converged) {
        fit.refusal = "the likelihood has no maximum within reach";
    } else if (form.free_ceiling && fit.curve.ceiling >= 1.0 - 1e-9) {
        fit.refusal = "the ceiling is 1";
    } else {
        fit.fit = goodness_of_fit(table, fit.curve);
    }
    return result;
}

std::vector<PodForm> forms(double floor) {
    std::vector<PodForm> all;
    for (const Link link : {Link::logit, Link::probit}) {
        for (const bool log_size : {false, true}) {
            all.push_back({link, log_size, 0.0, false});
            if (floor > 0.0) {
                all.push_back({link, log_size, floor, false});
            }
            all.push_back({link, log_size, floor, true});
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

// The first curve's bounds, or those so far widened to one more curve's.
void add_bounds(HitMissPod& pod, const HitMissTable& table, Scales& scales, const Fitted& fitted,
                const HitMissRequest& request) {
    const PodLikelihood likelihood = scales.likelihood(fitted.fit.curve.form);
    const auto bounds = [&](double rate) {
        return size_bounds(table, likelihood, fitted.maximum, rate, request.confidence);
    };
    const SizeBounds a50 = bounds(0.5), a90 = bounds(0.9);
    const std::vector<PodPoint> band = pod_band(
        likelihood, fitted.maximum, band_sizes(pod, request.band_points), request.confidence);
    if (pod.supported++ == 0) {
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
    return fit_form(table, scales, form).fit;
}

HitMissPod hit_miss_pod(const HitMissTable& table, const HitMissRequest& request) {
    HitMissPod pod;
    pod.tests = std::lround(total_tests(table));
    pod.hits = std::lround(total_hits(table));
    pod.smallest = table.empty() ? 0.0 : table.front().size;
    pod.largest = table.empty() ? 0.0 : table.back().size;
    pod.refusal = outcome_refusal(table);
    if (!pod.refusal.empty()) {
        return pod;
    }
    Scales scales(table);
    std::vector<Fitted> fitted;
    const Fitted* best = nullptr;
    fitted.reserve(forms(request.floor).size());
    for (const PodForm& form : forms(request.floor)) {
        const bool more = !fitted.empty() && fitted.back().fit.curve.form.link == form.link &&
                          fitted.back().fit.curve.form.log_size == form.log_size;
        fitted.push_back(fit_form(table, scales, form, more ? &fitted.back() : nullptr));
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
    pod.chosen = best->fit;
    if (!(best->fit.curve.slope > 0.0)) {
        pod.refusal = "the rate does not rise with the fault size";
        return pod;
    }
    pod.doubtful = best->fit.fit.p_value < kLackOfFit;
    add_bounds(pod, table, scales, *best, request);
    for (const Fitted& other : fitted) {
        if (&other != best && other.fit.refusal.empty() && other.fit.curve.slope > 0.0 &&
            other.fit.aic <= best->fit.aic + kSupported) {
            add_bounds(pod, table, scales, other, request);
        }
    }
    return pod;
}

}  // namespace gearpod::analysis
