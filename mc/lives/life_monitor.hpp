// Applies the monitoring to the lives of a campaign.
#pragma once

#include <string>
#include <vector>

#include "analysis/monitoring/monitor_performance.hpp"
#include "machine/fields.hpp"
#include "mc/lives/campaign.hpp"

namespace gearpod::mc {

// Results of one feature, or of all features ("fused"), with one detector.
struct MonitoredFeature {
    std::string feature, detector;
    analysis::MonitorPerformance performance;
    std::string unranked = "";     // result of why_unranked()
    bool best_of_feature = false;  // its detector ranks first among those of the feature
};

// True if `a` ranks before `b`; those without a rank come last.
bool ranks_before(const MonitoredFeature& a, const MonitoredFeature& b);

// Effect of the false-alarm rate on detection, for the detector that is best at the stated rate.
struct TradeOff {
    struct Point {
        double stated_per_1000_h, per_1000_h;  // target rate, and rate counted on other lives
        double share, depth_50_m, depth_90_m;
    };
    std::string feature, detector;
    std::vector<Point> points;
};
GEARPOD_FIELDS(TradeOff::Point, stated_per_1000_h, per_1000_h, share, depth_50_m, depth_90_m)
GEARPOD_FIELDS(TradeOff, feature, detector, points)

// Deviations from each gearbox's baseline, by record: the 5, 50 and 95 % quantiles of the healthy
// lives that count false alarms, and the first lives with a crack. NaN if there is no value.
struct FeatureQuantiles {
    std::string feature;
    std::vector<double> low, median, high;
    std::vector<std::vector<double>> lives;
};
GEARPOD_FIELDS(FeatureQuantiles, feature, healthy_05, healthy_50, healthy_95, lives)

// Plan and campaign must outlive the object.
class LifeMonitor {
  public:
    LifeMonitor(const CampaignPlan& plan, const Campaign& campaign);
    LifeMonitor(LifeMonitor&&) noexcept;
    ~LifeMonitor();

    const CampaignPlan& plan() const { return plan_; }
    const Campaign& campaign() const { return campaign_; }

    // Results of every feature, and of all features together if there are several, with every
    // detector.
    const std::vector<MonitoredFeature>& results() const { return results_; }
    // Indices of the results that have a rank (why_unranked()), best first.
    const std::vector<std::size_t>& ranking() const { return ranking_; }
    std::vector<TradeOff> trade_offs() const;
    std::vector<FeatureQuantiles> feature_quantiles() const;

  private:
    class MonitoredDeviations;

    const CampaignPlan& plan_;
    const Campaign& campaign_;
    std::vector<MonitoredDeviations> monitored_;
    std::vector<MonitoredFeature> results_;
    std::vector<std::size_t> ranking_;
};

}  // namespace gearpod::mc
