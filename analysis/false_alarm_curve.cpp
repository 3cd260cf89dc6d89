#include "analysis/false_alarm_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/pod/hit_miss_pod.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kTargetPod = 0.9;

// Test gearboxes with a value, by size: rows are sorted once for all thresholds.
struct TestRows {
    std::vector<double> size, value;
    Alarm alarm;

    explicit TestRows(const TestValues& values) : alarm(values.alarm) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < values.value.size(); ++i) {
            if (std::isfinite(values.value[i])) {
                order.push_back(i);
            }
        }
        std::ranges::sort(
            order, [&](std::size_t a, std::size_t b) { return values.size[a] < values.size[b]; });
        for (const std::size_t i : order) {
            size.push_back(values.size[i]);
            value.push_back(values.value[i]);
        }
    }

    HitMissTable outcomes_at(double threshold) const {
        std::vector<char> hit;
        for (const double each : value) {
            hit.push_back(is_alarm(each, threshold, alarm) ? 1 : 0);
        }
        return hit_miss_table(size, hit);
    }
};

// Estimates of a90 by each form, or its bounds; empty where no curve fits.
std::vector<std::optional<SizeEstimate>> a90_by_form(const HitMissTable& table,
                                                     std::span<const PodForm> forms,
                                                     double confidence, std::optional<Side> side) {
    if (table.empty() || total_hits(table) == 0.0) {
        return {forms.size(), SizeEstimate{SizeEstimate::Where::not_reached, kNan}};
    }
    if (total_hits(table) == total_tests(table)) {
        return {forms.size(), SizeEstimate{SizeEstimate::Where::below_tested, kNan}};
    }
    return sizes_by_form(table, forms, kTargetPod, one_sided_bound(confidence), side);
}

bool is_smaller(const SizeEstimate& a, const SizeEstimate& b) {
    return place_of(a) < place_of(b);
}

// Extrapolation factor 1 / (rate x n), where n is the size of the healthy sample, or its number of
// gearboxes if the records are importance-sampled. 0 if the threshold is not extrapolated.
double extrapolation_of(const Threshold& threshold, double rate) {
    const auto rarer = [&](long sample) { return 1.0 / (rate * static_cast<double>(sample)); };
    if (threshold.importance_sampled) {
        const double beyond = rarer(threshold.gearboxes);
        return beyond > 1.0 ? beyond : 0.0;
    }
    return threshold.tail ? rarer(threshold.sample) : 0.0;
}

RatePoint point_of(const HealthyThresholds& healthy, double rate, const Threshold& threshold,
                   double confidence) {
    RatePoint point;
    point.false_alarm_rate = rate;
    point.threshold = threshold.value;
    point.extrapolation = extrapolation_of(threshold, rate);
    point.importance_sampled = threshold.importance_sampled.has_value();
    point.threshold_bounds = healthy.value_bounds(threshold, rate, confidence);
    return point;
}

// Makes estimates and bounds monotone. A threshold farther from the healthy values detects no
// smaller faults. A lower bound at a nearer threshold is therefore also valid at a farther one,
// even where the sample has little information about the rarer alarms.
void make_monotone(std::vector<RatePoint>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const SizeBounds& before = points[i - 1].a90;
        SizeBounds& here = points[i].a90;
        here.estimate = std::max(before.estimate, here.estimate, is_smaller);
        here.lower = std::max(before.lower, here.lower, is_smaller);
        here.upper = std::max(before.upper, here.upper, is_smaller);
    }
}

}  // namespace

FalseAlarmCurve false_alarm_curve(const TestValues& values, std::span<const PodForm> forms,
                                  double confidence) {
    FalseAlarmCurve curve;
    const HealthyThresholds healthy(values.healthy, values.alarm);
    const TestRows test(values);
    // The bounds of the threshold and the bounds of a90 each get half of the error probability.
    const double half = 1.0 - 0.5 * (1.0 - confidence), two_sided = confidence;
    for (const double rate : kCurveRates) {
        const Threshold threshold = healthy.at(rate, two_sided);
        if (std::isnan(threshold.value)) {
            break;
        }
        RatePoint point = point_of(healthy, rate, threshold, two_sided);
        // The threshold bound nearer to the healthy values detects more faults.
        const bool high = values.alarm == Alarm::high;
        const Interval& bounds = point.threshold_bounds;
        const double near = high ? bounds.lower : bounds.upper,
                     far = high ? bounds.upper : bounds.lower;
        std::vector<PodForm> floored(forms.begin(), forms.end());
        for (PodForm& form : floored) {
            form.floor = form.floor > 0.0 ? rate : 0.0;
        }
        const auto middle =
            a90_by_form(test.outcomes_at(threshold.value), floored, half, std::nullopt);
        const auto least = a90_by_form(test.outcomes_at(near), floored, half, Side::lower);
        const auto most = a90_by_form(test.outcomes_at(far), floored, half, Side::upper);
        bool fitted = false;
        for (std::size_t i = 0; i < floored.size(); ++i) {
            if (middle[i] && least[i] && most[i]) {
                const SizeBounds a90{*middle[i], *least[i], *most[i]};
                point.a90 = fitted ? widest(point.a90, a90) : a90;
                fitted = true;
            }
        }
        if (fitted) {
            curve.points.push_back(point);
        } else {
            curve.unfitted.push_back(rate);
        }
    }
    if (curve.points.empty()) {
        curve.refusal = curve.unfitted.empty() ? "too few healthy values for a threshold"
                                               : "no curve fits at any of the rates";
        curve.unfitted.clear();
    }
    make_monotone(curve.points);
    return curve;
}

}  // namespace gearpod::analysis
