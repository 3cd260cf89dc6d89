#include "analysis/comparison/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/size_groups.hpp"
#include "analysis/detection/tail.hpp"
#include "analysis/pod/hit_miss_pod.hpp"

namespace gearpod::analysis {
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

}  // namespace

std::vector<int> bootstrap_counts(std::size_t count, std::mt19937_64& engine) {
    std::vector<int> counts(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        // Upper half of the product: uniform to count / 2^32, and the same with every library.
        ++counts[static_cast<std::size_t>((engine() >> 32) * count >> 32)];
    }
    return counts;
}

Resampling::Resampling(Alarm alarm, std::span<const double> healthy,
                       std::span<const double> graded_size, std::span<const double> graded,
                       const std::vector<SizeGroup>& groups, double false_alarm_rate)
    : sign_(alarm_sign(alarm)), false_alarm_rate_(false_alarm_rate), groups_(groups.size()) {
    for (std::size_t i = 0; i < healthy.size(); ++i) {
        if (std::isfinite(healthy[i])) {
            healthy_.emplace_back(sign_ * healthy[i], i);
        }
    }
    std::sort(healthy_.begin(), healthy_.end());
    const std::vector<std::size_t> group = groups_of(graded_size, groups);
    for (std::size_t i = 0; i < graded.size(); ++i) {
        if (std::isfinite(graded[i])) {
            graded_.push_back({graded_size[i], sign_ * graded[i], i, group[i]});
        }
    }
    std::sort(graded_.begin(), graded_.end(), [](const TestValue& a, const TestValue& b) {
        return a.size != b.size ? a.size < b.size : a.gearbox < b.gearbox;
    });
}

double Resampling::threshold(const std::vector<int>& counts) const {
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

double Resampling::beyond(const std::vector<int>& counts, long sample) const {
    const auto needed = static_cast<std::size_t>(exceedances_of(sample)) + 1;
    std::vector<double> largest;
    for (auto at = healthy_.rbegin(); at != healthy_.rend() && largest.size() < needed; ++at) {
        const auto left = needed - largest.size();
        largest.insert(largest.end(), std::min<std::size_t>(left, counts[at->second]), at->first);
    }
    std::reverse(largest.begin(), largest.end());
    const TailFit tail(largest, sample);
    return tail.refusal().empty() ? tail.threshold(false_alarm_rate_) : kNan;
}

ResampledDetection Resampling::detect(const std::vector<int>& healthy,
                                      const std::vector<int>& graded, const PodForm* form) const {
    const double limit = threshold(healthy);
    std::vector<double> tested(groups_, 0.0), found(groups_, 0.0);
    HitMissTable table;
    for (const TestValue& row : graded_) {
        const double weight = graded[row.gearbox];
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
        result.pd.push_back(tested[g] > 0.0 && !std::isnan(limit) ? found[g] / tested[g] : kNan);
    }
    result.a90 = form == nullptr || std::isnan(limit) ? kNan : a90_of(table, *form);
    return result;
}

}  // namespace gearpod::analysis
