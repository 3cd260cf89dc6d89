#include "analysis/comparison/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/team.hpp"

namespace gearpod::analysis {

std::size_t uniform_index(std::mt19937_64& engine, std::size_t count) {
    return static_cast<std::size_t>((engine() >> 32) * count >> 32);
}

namespace {

constexpr double kComparedPod = 0.9;

// a90 of a table. Where the curve cannot be fitted: the smallest size if all are detected, infinite
// if none is, otherwise NaN.
double a90_of(const HitMissTable& table, const PodForm& form) {
    const double hits = total_hits(table), tests = total_tests(table);
    if (table.empty() || hits == 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    if (hits == tests) {
        return table.front().size;
    }
    const HitMissFit fit = fit_hit_miss(table, form);
    if (!fit.refusal.empty()) {
        return kNan;
    }
    const auto size = fit.curve.size_at(kComparedPod);
    return size && *size <= table.back().size ? std::max(*size, table.front().size)
                                              : std::numeric_limits<double>::infinity();
}

// Number of times every gearbox of a sample is drawn. The same for the same seed and count on every
// platform.
std::vector<int> bootstrap_counts(std::size_t count, std::mt19937_64& engine) {
    std::vector<int> counts(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        ++counts[uniform_index(engine, count)];
    }
    return counts;
}

struct ResampledDetection {
    std::vector<double> pd;  // by size group; NaN where none was drawn
    double a90 = 0.0;        // infinite: not reached; NaN: no curve
};

// One feature at one noise level, sorted once for many resamples.
class Resampling {
  public:
    Resampling(const ComparedSample& sample, const ComparisonRequest& request)
        : false_alarm_rate_(request.false_alarm_rate), groups_(request.groups.size()) {
        const double sign = alarm_sign(sample.alarm);
        for (std::size_t i = 0; i < sample.healthy.size(); ++i) {
            if (std::isfinite(sample.healthy[i])) {
                healthy_.emplace_back(sign * sample.healthy[i], i);
            }
        }
        std::ranges::sort(healthy_);
        const std::vector<std::size_t> group = groups_of(sample.test_size, request.groups);
        for (std::size_t i = 0; i < sample.test.size(); ++i) {
            if (std::isfinite(sample.test[i])) {
                test_.push_back({sample.test_size[i], sign * sample.test[i], i, group[i]});
            }
        }
        std::ranges::sort(test_, [](const TestValue& a, const TestValue& b) {
            return a.size != b.size ? a.size < b.size : a.gearbox < b.gearbox;
        });
    }

    // Detection of one resample, given the number of times each gearbox is drawn. Fits the
    // POD curve `form`, or no curve if it is null.
    ResampledDetection detect(const std::vector<int>& healthy, const std::vector<int>& test,
                              const PodForm* form) const {
        const double limit = threshold(healthy);
        std::vector<double> tested(groups_, 0.0), found(groups_, 0.0);
        HitMissTable table;
        for (const TestValue& row : test_) {
            const double weight = test[row.gearbox];
            const double hits = row.value > limit ? weight : 0.0;
            if (row.group != kNoGroup) {
                tested[row.group] += weight;
                found[row.group] += hits;
            }
            if (row.size > 0.0 && weight > 0.0) {
                if (table.empty() || table.back().size != row.size) {
                    table.push_back({row.size, 0.0, 0.0});
                }
                table.back().hits += hits;
                table.back().tests += weight;
            }
        }
        ResampledDetection result;
        for (std::size_t g = 0; g < groups_; ++g) {
            result.pd.push_back(tested[g] > 0.0 && !std::isnan(limit) ? found[g] / tested[g]
                                                                      : kNan);
        }
        result.a90 = form == nullptr || std::isnan(limit) ? kNan : a90_of(table, *form);
        return result;
    }

  private:
    struct TestValue {
        double size, value;
        std::size_t gearbox, group;
    };

    double threshold(const std::vector<int>& counts) const {
        long sample = 0, passed = 0;
        for (const auto& [value, gearbox] : healthy_) {
            sample += counts[gearbox];
        }
        const long rank = threshold_rank(sample, false_alarm_rate_);
        for (const auto& [value, gearbox] : healthy_) {
            passed += counts[gearbox];
            if (passed >= rank) {
                return value;
            }
        }
        return tail_reaches(sample, false_alarm_rate_) ? beyond(counts, sample) : kNan;
    }

    double beyond(const std::vector<int>& counts, long sample) const {
        const auto needed = static_cast<std::size_t>(exceedances_of(sample)) + 1;
        std::vector<double> largest;
        for (auto entry = healthy_.rbegin(); entry != healthy_.rend() && largest.size() < needed;
             ++entry) {
            const auto left = needed - largest.size();
            largest.insert(largest.end(), std::min<std::size_t>(left, counts[entry->second]),
                           entry->first);
        }
        std::ranges::reverse(largest);
        const TailFit tail(largest, sample);
        return tail.refusal().empty() ? tail.threshold(false_alarm_rate_) : kNan;
    }

    double false_alarm_rate_;
    std::size_t groups_;
    // Large values alarm.
    std::vector<std::pair<double, std::size_t>> healthy_;  // value and gearbox, ascending
    std::vector<TestValue> test_;                          // ascending size
};

// Detection of one sample with the methods of the report.
struct Detected {
    LevelDetection level;
    std::vector<int> hit;
    HitMissPod pod;
};

Detected detected(const ComparedSample& sample, const ComparisonRequest& request) {
    const std::vector<double> no_fault(sample.healthy.size(), 0.0);
    DetectionRequest single_level_request;
    single_level_request.false_alarm_rate = request.false_alarm_rate;
    single_level_request.confidence = request.confidence;
    single_level_request.noise_levels = {1.0};
    single_level_request.groups = request.groups;
    Detected result;
    result.level = detect("", sample.alarm, {no_fault, sample.healthy},
                          {sample.test_size, sample.test}, single_level_request)
                       .levels.front();
    result.hit = outcomes(sample.test, result.level.threshold, sample.alarm);
    constexpr int kNoBand = 2;
    result.pod =
        pod_of_outcomes(sample.test_size, result.hit, result.level, request.confidence, kNoBand);
    return result;
}

// Differences between the two samples over the resamples.
struct Resampled {
    std::vector<std::vector<double>> rates;  // by group
    std::vector<double> a90;
};

Resampled resample(const ComparedSample& a, const ComparedSample& b, const Detected& of_a,
                   const Detected& of_b, const ComparisonRequest& request, int threads) {
    const Resampling first(a, request), second(b, request);
    const bool curves = of_a.pod.refusal.empty() && of_b.pod.refusal.empty();
    const auto count = static_cast<std::size_t>(request.resamples);
    Resampled result;
    result.rates.assign(request.groups.size(), std::vector<double>(count));
    result.a90.resize(count);
    machine::for_each_index(count, threads, [&](std::size_t r) {
        std::mt19937_64 engine(r);
        const auto healthy = bootstrap_counts(a.healthy.size(), engine);
        const auto test = bootstrap_counts(a.test.size(), engine);
        const auto first_rates =
            first.detect(healthy, test, curves ? &of_a.pod.chosen.curve.form : nullptr);
        const auto second_rates =
            second.detect(request.paired ? healthy : bootstrap_counts(b.healthy.size(), engine),
                          request.paired ? test : bootstrap_counts(b.test.size(), engine),
                          curves ? &of_b.pod.chosen.curve.form : nullptr);
        for (std::size_t g = 0; g < request.groups.size(); ++g) {
            result.rates[g][r] = second_rates.pd[g] - first_rates.pd[g];
        }
        result.a90[r] = second_rates.a90 - first_rates.a90;
    });
    return result;
}

// Percentiles of the values that are not NaN; infinite values count.
Interval percentiles(std::vector<double> values, double confidence) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) {
        return {kNan, kNan};
    }
    std::ranges::sort(values);
    const double tail = 0.5 * (1.0 - confidence) * static_cast<double>(values.size() + 1);
    const auto least = static_cast<std::size_t>(std::max(1.0, std::floor(tail))) - 1;
    return {values[least], values[values.size() - 1 - least]};
}

PairedCounts paired_counts(const Detected& a, const Detected& b,
                           const std::vector<std::size_t>& group, std::size_t g) {
    PairedCounts counts;
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i] == g && a.hit[i] >= 0 && b.hit[i] >= 0) {
            counts.add(a.hit[i], b.hit[i]);
        }
    }
    return counts;
}

// Sets the detection rates of both; if both have the same gearboxes, from the counts of pairs.
void add_rates(RateDifference& rate, const DetectionCell& a, const DetectionCell& b,
               const ComparisonRequest& request, const Interval& resampled) {
    long found_a = a.detected, found_b = b.detected;
    rate.tested_a = a.tested;
    rate.tested_b = b.tested;
    if (request.paired) {
        rate.tested_a = rate.tested_b = rate.pairs.pairs();
        found_a = rate.pairs.both + rate.pairs.only_a;
        found_b = rate.pairs.both + rate.pairs.only_b;
    }
    if (rate.tested_a == 0 || rate.tested_b == 0 || std::isnan(a.pd) || std::isnan(b.pd)) {
        rate.a = rate.b = rate.p_value = kNan;
        rate.bounds = {kNan, kNan};
        return;
    }
    rate.a = static_cast<double>(found_a) / static_cast<double>(rate.tested_a);
    rate.b = static_cast<double>(found_b) / static_cast<double>(rate.tested_b);
    rate.bounds =
        difference_interval(rate.a, wilson_interval(found_a, rate.tested_a, request.confidence),
                            rate.b, wilson_interval(found_b, rate.tested_b, request.confidence),
                            request.paired ? outcome_correlation(rate.pairs) : 0.0);
    rate.bounds.lower = std::fmin(rate.bounds.lower, resampled.lower);
    rate.bounds.upper = std::fmax(rate.bounds.upper, resampled.upper);
    rate.p_value = request.paired ? mcnemar_p_value(rate.pairs)
                                  : pooled_p_value(found_a, rate.tested_a, found_b, rate.tested_b);
}

std::string a90_refusal(const HitMissPod& pod, const char* which) {
    const std::string name = which;
    if (!pod.refusal.empty()) {
        return name + ": " + pod.refusal;
    }
    using Where = SizeEstimate::Where;
    const Where where = pod.a90.estimate.where;
    return where == Where::reached
               ? ""
               : name + (where == Where::below_tested ? ": a90 is below the tested sizes"
                                                      : ": a90 is not reached");
}

NumberDifference a90_difference(const Detected& a, const Detected& b,
                                const std::vector<double>& resampled, double confidence) {
    NumberDifference result{kNan, kNan, {kNan, kNan}, kNan, a90_refusal(a.pod, "A")};
    if (result.refusal.empty()) {
        result.a = a.pod.a90.estimate.size;
    }
    if (std::string second = a90_refusal(b.pod, "B"); second.empty()) {
        result.b = b.pod.a90.estimate.size;
    } else if (result.refusal.empty()) {
        result.refusal = std::move(second);
    }
    if (result.refusal.empty()) {
        result.bounds = percentiles(resampled, confidence);
    }
    return result;
}

struct Areas {
    std::vector<double> healthy, faulty;  // larger on the alarm side
};

Areas areas_of(const ComparedSample& sample, const ComparedSample& other, bool paired) {
    const double sign = alarm_sign(sample.alarm);
    Areas areas;
    const auto usable = [&](std::span<const double> mine, std::span<const double> others,
                            std::size_t i) {
        return std::isfinite(mine[i]) && (!paired || std::isfinite(others[i]));
    };
    for (std::size_t i = 0; i < sample.healthy.size(); ++i) {
        if (usable(sample.healthy, other.healthy, i)) {
            areas.healthy.push_back(sign * sample.healthy[i]);
        }
    }
    for (std::size_t i = 0; i < sample.test.size(); ++i) {
        if (usable(sample.test, other.test, i)) {
            (sample.test_size[i] > 0.0 ? areas.faulty : areas.healthy)
                .push_back(sign * sample.test[i]);
        }
    }
    return areas;
}

NumberDifference auc_difference(const ComparedSample& a, const ComparedSample& b,
                                const ComparisonRequest& request) {
    const Areas of_a = areas_of(a, b, request.paired), of_b = areas_of(b, a, request.paired);
    NumberDifference result{kNan, kNan, {kNan, kNan}, kNan, ""};
    for (const Areas* areas : {&of_a, &of_b}) {
        if (areas->healthy.size() < 2 || areas->faulty.size() < 2) {
            result.refusal = "two healthy and two faulty gearboxes with values are needed";
            return result;
        }
    }
    const AucComponents first = auc_components(of_a.healthy, of_a.faulty);
    const AucComponents second = auc_components(of_b.healthy, of_b.faulty);
    const double var_a = auc_covariance(first, first), var_b = auc_covariance(second, second);
    const double both = request.paired ? auc_covariance(first, second) : 0.0;
    const auto interval = [&](const Areas& areas, double area, double variance) {
        const auto pairs = static_cast<long>(std::min(areas.healthy.size(), areas.faulty.size()));
        const Interval known = auc_interval(area, variance, pairs, request.confidence);
        // The area of constant values is known.
        return std::isnan(known.lower) ? Interval{area, area} : known;
    };
    result.a = first.auc;
    result.b = second.auc;
    const double scatter = std::sqrt(var_a * var_b);
    result.bounds = difference_interval(first.auc, interval(of_a, first.auc, var_a), second.auc,
                                        interval(of_b, second.auc, var_b),
                                        scatter > 0.0 ? both / scatter : 0.0);
    const double variance = var_a + var_b - 2.0 * both, distance = std::abs(second.auc - first.auc);
    result.p_value = distance == 0.0 ? 1.0
                     : variance > 0.0
                         ? 2.0 * link_probability(Link::probit, -distance / std::sqrt(variance))
                         : kNan;
    return result;
}

}  // namespace

Comparison compare_detection(const ComparedSample& a, const ComparedSample& b,
                             const ComparisonRequest& request, int threads) {
    if (request.paired && (a.healthy.size() != b.healthy.size() ||
                           !std::equal(a.test_size.begin(), a.test_size.end(), b.test_size.begin(),
                                       b.test_size.end()))) {
        throw std::invalid_argument("comparison: paired samples have different gearboxes");
    }
    const Detected of_a = detected(a, request), of_b = detected(b, request);
    const Resampled resampled = resample(a, b, of_a, of_b, request, threads);
    const std::vector<std::size_t> group = groups_of(a.test_size, request.groups);
    Comparison result;
    for (std::size_t g = 0; g < request.groups.size(); ++g) {
        RateDifference rate;
        rate.size = request.groups[g];
        if (request.paired) {
            rate.pairs = paired_counts(of_a, of_b, group, g);
        }
        add_rates(rate, of_a.level.cells[g], of_b.level.cells[g], request,
                  percentiles(resampled.rates[g], request.confidence));
        result.rates.push_back(rate);
    }
    result.a90 = a90_difference(of_a, of_b, resampled.a90, request.confidence);
    result.auc = auc_difference(a, b, request);
    return result;
}

}  // namespace gearpod::analysis
