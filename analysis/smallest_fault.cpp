#include "analysis/smallest_fault.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gearpod::analysis {
namespace {

using Where = SizeEstimate::Where;

std::optional<SmallestFault> single_feature_fault(const std::string& feature,
                                                  const LevelReliability& at) {
    const HitMissPod& pod = at.hit_miss;
    const SmallestFault::Source source{feature, at.noise_level};
    if (pod.refusal.empty() && !pod.doubtful && pod.a90.upper.where != Where::not_reached) {
        const bool inside = pod.a90.upper.where == Where::reached;
        return SmallestFault{feature, inside ? pod.a90.upper.size : pod.smallest, true, source};
    }
    if (std::isnan(at.demonstrated_size)) {
        return std::nullopt;
    }
    return SmallestFault{feature, at.demonstrated_size, false, source};
}

// True if `a` finds at least as many faults as `b` in every size group, and both tested the same
// groups, at least one.
bool finds_no_less(const LevelReliability& a, const LevelReliability& b) {
    bool any = false;
    for (std::size_t i = 0; i < a.pd.size(); ++i) {
        if (std::isnan(a.pd[i]) != std::isnan(b.pd[i]) || a.pd[i] < b.pd[i]) {
            return false;
        }
        any |= !std::isnan(a.pd[i]);
    }
    return any;
}

double found(const LevelReliability& at) {
    return std::accumulate(at.pd.begin(), at.pd.end(), 0.0,
                           [](double sum, double pd) { return sum + (std::isnan(pd) ? 0.0 : pd); });
}

}  // namespace

std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level,
                                            std::size_t feature) {
    const FeatureReliability& requested_feature = reliability.features[feature];
    const LevelReliability& at = requested_feature.levels[level];
    auto least = single_feature_fault(requested_feature.feature, at);
    for (const FeatureReliability& other : reliability.features) {
        for (const LevelReliability& there : other.levels) {
            const auto bound = single_feature_fault(other.feature, there);
            if (bound && (!least || bound->size < least->size) && finds_no_less(at, there)) {
                least = bound;
                least->feature = requested_feature.feature;
                least->own = false;
            }
        }
    }
    return least;
}

bool without_threshold(const Reliability& reliability, std::size_t level) {
    return std::none_of(
        reliability.features.begin(), reliability.features.end(),
        [&](const FeatureReliability& feature) { return feature.levels[level].has_threshold; });
}

std::optional<SmallestFault> smallest_fault(const Reliability& reliability, std::size_t level) {
    std::optional<SmallestFault> least;
    double most = 0.0;
    for (const std::size_t f : in_rank_order(reliability, level)) {
        const auto fault = smallest_fault(reliability, level, f);
        const double finds = found(reliability.features[f].levels[level]);
        if (fault &&
            (!least || fault->size < least->size || (fault->size == least->size && finds > most))) {
            least = fault;
            most = finds;
        }
    }
    return least;
}

}  // namespace gearpod::analysis
