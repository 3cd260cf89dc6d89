#include "mc/lives/life_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/monitoring/baseline_deviations.hpp"

namespace gearpod::mc {

// A feature of all lives, or the combination of several features.
class LifeMonitor::MonitoredDeviations {
  public:
    MonitoredDeviations(std::string given, const CampaignPlan& plan, const Campaign& campaign,
                        std::vector<std::size_t> features)
        : name(std::move(given)), plan_(plan), features_(std::move(features)) {
        for (const features::Feature* feature : plan.ensemble.features) {
            alarms_.push_back(feature->alarm);
        }
        threshold_lives_ = healthy(campaign.threshold_lives);
        healthy_ = healthy(campaign.healthy);
        cracked_ = cracked(campaign.cracked);
    }

    const std::string name;

    analysis::MonitorPerformance performance(const analysis::Detector& detector,
                                             double per_1000_h) const {
        return analysis::monitor_performance(detector, threshold_lives_, healthy_, cracked_,
                                             per_1000_h, plan_.ensemble.request.confidence);
    }

    FeatureQuantiles quantiles() const {
        constexpr std::size_t kPlottedLives = 32;
        FeatureQuantiles result{name, {}, {}, {}, {}};
        for (std::size_t r = 0; r < static_cast<std::size_t>(plan_.records); ++r) {
            std::vector<double> all;
            for (const analysis::HealthyLife& life : healthy_) {
                if (!std::isnan(life.values[r])) {
                    all.push_back(life.values[r]);
                }
            }
            std::ranges::sort(all);
            for (const auto& [share, into] :
                 {std::pair{0.05, &result.low}, {0.5, &result.median}, {0.95, &result.high}}) {
                into->push_back(all.empty() ? std::nan("")
                                            : all[static_cast<std::size_t>(
                                                  share * static_cast<double>(all.size() - 1))]);
            }
        }
        for (std::size_t g = 0; g < std::min(kPlottedLives, cracked_.size()); ++g) {
            result.lives.push_back(cracked_[g].values);
        }
        return result;
    }

  private:
    std::vector<double> deviations(const GearboxLife& life) const {
        std::vector<double> torque;
        if (plan_.torque_regression) {
            for (const LifeRecord& record : life.history.records) {
                torque.push_back(record.torque);
            }
        }
        const auto baseline = static_cast<std::size_t>(plan_.baseline_records);
        if (features_.size() == 1) {
            return analysis::baseline_deviations(life.values[features_[0]], torque, baseline,
                                                 alarms_[features_[0]]);
        }
        return analysis::fused_deviations(life.values, torque, baseline, alarms_);
    }

    std::vector<analysis::HealthyLife> healthy(const std::vector<GearboxLife>& lives) const {
        std::vector<analysis::HealthyLife> all;
        for (const GearboxLife& life : lives) {
            if (life.status == Status::ok) {
                analysis::HealthyLife healthy{deviations(life), 0.0};
                healthy.hours =
                    plan_.interval_h *
                    static_cast<double>(std::ranges::count_if(
                        healthy.values, [](double value) { return !std::isnan(value); }));
                all.push_back(std::move(healthy));
            }
        }
        return all;
    }

    std::vector<analysis::CrackedLife> cracked(const std::vector<GearboxLife>& lives) const {
        std::vector<analysis::CrackedLife> all;
        for (const GearboxLife& life : lives) {
            if (life.status != Status::ok) {
                continue;
            }
            analysis::CrackedLife cracked;
            cracked.values = deviations(life);
            for (const LifeRecord& record : life.history.records) {
                cracked.hours.push_back(record.hours);
                cracked.sizes.push_back(record.depth_m);
            }
            cracked.first = life.history.first_cracked;
            cracked.end_hours = life.history.end_hours;
            all.push_back(std::move(cracked));
        }
        return all;
    }

    const CampaignPlan& plan_;
    const std::vector<std::size_t> features_;
    std::vector<analysis::Alarm> alarms_;
    std::vector<analysis::HealthyLife> threshold_lives_, healthy_;
    std::vector<analysis::CrackedLife> cracked_;
};

bool ranks_before(const MonitoredFeature& a, const MonitoredFeature& b) {
    return a.unranked.empty() != b.unranked.empty()
               ? a.unranked.empty()
               : analysis::ranks_before(a.performance, b.performance);
}

LifeMonitor::LifeMonitor(const CampaignPlan& plan, const Campaign& campaign)
    : plan_(plan), campaign_(campaign) {
    std::vector<std::size_t> all(plan.ensemble.features.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const std::size_t f : all) {
        monitored_.emplace_back(std::string(plan.ensemble.features[f]->name), plan, campaign,
                                std::vector<std::size_t>{f});
    }
    if (all.size() > 1 && plan.baseline_records > 0) {
        monitored_.emplace_back("fused", plan, campaign, all);
    }
    const double rate = plan.false_alarms_per_1000_h;
    for (const MonitoredDeviations& monitored : monitored_) {
        for (const std::string& text : plan.detectors) {
            results_.push_back({monitored.name, text,
                                monitored.performance(*analysis::parse_detector(text), rate)});
            results_.back().unranked = analysis::why_unranked(results_.back().performance, rate);
        }
    }
    for (std::size_t i = 0; i < results_.size(); ++i) {
        const auto same_feature = [&](const MonitoredFeature& other) {
            return other.feature == results_[i].feature;
        };
        const auto first = std::ranges::find_if(results_, same_feature);
        const auto end = std::find_if_not(first, results_.end(), same_feature);
        results_[i].best_of_feature =
            &results_[i] == &*std::min_element(first, end, [](const auto& a, const auto& b) {
                return ranks_before(a, b);
            });
        if (results_[i].unranked.empty()) {
            ranking_.push_back(i);
        }
    }
    std::ranges::stable_sort(ranking_, [&](std::size_t a, std::size_t b) {
        return ranks_before(results_[a], results_[b]);
    });
}

LifeMonitor::LifeMonitor(LifeMonitor&&) noexcept = default;
LifeMonitor::~LifeMonitor() = default;

std::vector<TradeOff> LifeMonitor::trade_offs() const {
    std::vector<TradeOff> all;
    for (const MonitoredDeviations& monitored : monitored_) {
        const auto best = std::ranges::find_if(results_, [&](const MonitoredFeature& candidate) {
            return candidate.feature == monitored.name && candidate.best_of_feature;
        });
        TradeOff trade{monitored.name, best->detector, {}};
        for (const double factor : {0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
            const double rate = factor * plan_.false_alarms_per_1000_h;
            const auto performance =
                monitored.performance(*analysis::parse_detector(best->detector), rate);
            if (!std::isnan(performance.threshold.value)) {
                trade.points.push_back({rate, performance.false_alarms.per_1000_h,
                                        performance.share, performance.size_50.value,
                                        performance.size_90.value});
            }
        }
        all.push_back(std::move(trade));
    }
    return all;
}

std::vector<FeatureQuantiles> LifeMonitor::feature_quantiles() const {
    std::vector<FeatureQuantiles> all;
    for (const MonitoredDeviations& monitored : monitored_) {
        all.push_back(monitored.quantiles());
    }
    return all;
}

}  // namespace gearpod::mc
