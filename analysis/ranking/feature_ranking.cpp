#include "analysis/ranking/feature_ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

// Finite values, the most alarming first.
std::vector<double> from_alarm_side(std::span<const double> values, bool high) {
    std::vector<double> sorted;
    for (const double value : values) {
        if (std::isfinite(value)) {
            sorted.push_back(high ? value : -value);
        }
    }
    std::ranges::sort(sorted, std::greater<>());
    return sorted;
}

std::vector<RocPoint> corners(const std::vector<double>& healthy,
                              const std::vector<double>& faulty) {
    std::vector<RocPoint> points{{0.0, 0.0}};
    std::size_t h = 0, f = 0;
    while (h < healthy.size() || f < faulty.size()) {
        const double next = std::max(h < healthy.size() ? healthy[h] : -HUGE_VAL,
                                     f < faulty.size() ? faulty[f] : -HUGE_VAL);
        while (h < healthy.size() && healthy[h] == next) {
            ++h;
        }
        while (f < faulty.size() && faulty[f] == next) {
            ++f;
        }
        points.push_back({static_cast<double>(h) / static_cast<double>(healthy.size()),
                          static_cast<double>(f) / static_cast<double>(faulty.size())});
    }
    return points;
}

double way(const RocPoint& point) {
    return 0.5 * (point.false_alarm_rate + point.detection_rate);
}

// Corners nearest to `most` points that divide the path from (0, 0) to (1, 1) evenly.
std::vector<RocPoint> thinned(const std::vector<RocPoint>& points, std::size_t most) {
    std::vector<RocPoint> kept;
    std::size_t point = 0, last = points.size();
    for (std::size_t corner = 0; corner < most; ++corner) {
        const double target = static_cast<double>(corner) / static_cast<double>(most - 1);
        while (point + 1 < points.size() && way(points[point]) < target) {
            ++point;
        }
        const bool before =
            point > 0 && target - way(points[point - 1]) < way(points[point]) - target;
        const std::size_t nearest = before ? point - 1 : point;
        if (nearest != last) {
            kept.push_back(points[nearest]);
            last = nearest;
        }
    }
    return kept;
}

std::vector<std::size_t> complete_rows(const std::vector<const RankedFeature*>& features,
                                       std::span<const double> RankedFeature::*group) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < (features.front()->*group).size(); ++i) {
        if (std::ranges::all_of(features, [&](const RankedFeature* feature) {
                return std::isfinite((feature->*group)[i]);
            })) {
            rows.push_back(i);
        }
    }
    return rows;
}

std::vector<double> picked(std::span<const double> values, const std::vector<std::size_t>& rows,
                           Alarm alarm) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        out.push_back(alarm_sign(alarm) * values[row]);
    }
    return out;
}

// Two-sided p-value. NaN if the difference has no variance but is not 0; 1 if it is 0.
double paired_p_value(const AucComponents& a, const AucComponents& b) {
    const double difference = std::abs(a.auc - b.auc);
    if (difference == 0.0) {
        return 1.0;
    }
    const double variance =
        auc_covariance(a, a) + auc_covariance(b, b) - 2.0 * auc_covariance(a, b);
    if (!(variance > 0.0)) {
        return kNan;
    }
    return 2.0 * link_probability(Link::probit, -difference / std::sqrt(variance));
}

}  // namespace

std::vector<RocPoint> roc_curve(std::span<const double> healthy, std::span<const double> faulty,
                                bool high, std::size_t most_points) {
    EXPECTS(most_points >= 2);
    const std::vector<double> below = from_alarm_side(healthy, high);
    const std::vector<double> beyond = from_alarm_side(faulty, high);
    if (below.empty() || beyond.empty()) {
        return {};
    }
    const std::vector<RocPoint> points = corners(below, beyond);
    return points.size() <= most_points ? points : thinned(points, most_points);
}

FeatureRanking rank_features(const std::vector<RankedFeature>& features, double confidence) {
    EXPECTS(std::ranges::all_of(features, [&](const RankedFeature& feature) {
        return feature.healthy.size() == features.front().healthy.size() &&
               feature.faulty.size() == features.front().faulty.size();
    }));
    FeatureRanking ranking;
    std::vector<const RankedFeature*> used;
    for (const RankedFeature& feature : features) {
        const auto finite = [](std::span<const double> values) {
            return std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
        };
        const auto all = static_cast<long>(feature.healthy.size() + feature.faulty.size());
        const long missing = all - finite(feature.healthy) - finite(feature.faulty);
        if (static_cast<double>(missing) > kMostMissing * static_cast<double>(all)) {
            ranking.left_out.push_back(
                fmt::format("{}: no value for {} of {} gearboxes", feature.name, missing, all));
        } else {
            used.push_back(&feature);
        }
    }
    if (used.empty()) {
        ranking.refusal = "no feature has values for at least 90 % of the gearboxes";
        return ranking;
    }
    const auto healthy = complete_rows(used, &RankedFeature::healthy);
    const auto faulty = complete_rows(used, &RankedFeature::faulty);
    ranking.healthy = static_cast<long>(healthy.size());
    ranking.faulty = static_cast<long>(faulty.size());
    if (healthy.size() < 2 || faulty.size() < 2) {
        ranking.refusal = fmt::format("{} healthy and {} faulty gearboxes, two of each are needed",
                                      healthy.size(), faulty.size());
        return ranking;
    }
    std::vector<AucComponents> components;
    for (const RankedFeature* feature : used) {
        components.push_back(auc_components(picked(feature->healthy, healthy, feature->alarm),
                                            picked(feature->faulty, faulty, feature->alarm)));
    }
    std::vector<std::size_t> order(used.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return components[a].auc > components[b].auc; });
    std::vector<double> p_values;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            p_values.push_back(paired_p_value(components[order[i]], components[order[j]]));
        }
    }
    p_values = holm_adjusted(p_values);
    const long pairs = std::min(ranking.healthy, ranking.faulty);
    for (const std::size_t f : order) {
        const double variance = auc_covariance(components[f], components[f]);
        ranking.ranks.push_back(
            {used[f]->name,
             {components[f].auc, auc_interval(components[f].auc, variance, pairs, confidence),
              ranking.healthy, ranking.faulty},
             std::vector<double>(order.size(), 1.0)});
    }
    std::size_t pair = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j, ++pair) {
            ranking.ranks[i].p_values[j] = ranking.ranks[j].p_values[i] = p_values[pair];
        }
    }
    return ranking;
}

}  // namespace gearpod::analysis
