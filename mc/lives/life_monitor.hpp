// What the study's monitoring makes of a campaign's lives.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/monitoring/life_answers.hpp"
#include "mc/lives/campaign.hpp"

namespace gearpod::mc {

// Of a feature of the study, or "fused", by one detector.
struct MonitoredFeature {
    std::string feature, detector;
    analysis::LifeAnswers answers;
};

// The better one finds more, then shallower.
bool better(const analysis::LifeAnswers& a, const analysis::LifeAnswers& b);

// What more or fewer false alarms would win or lose, by the detector that is best at the study's.
struct TradeOff {
    struct Point {
        double stated_per_1000_h, per_1000_h;  // set, and counted on other lives
        double share, depth_50_m, depth_90_m;
    };
    std::string feature, detector;
    std::vector<Point> points;
};

// Deviations from the own baseline, by record: of the healthy lives that count false alarms 5, 50
// and 95 %, and of the first lives with a crack each; NaN where the monitor sees none.
struct FeatureFan {
    std::string feature;
    std::vector<double> low, median, high;
    std::vector<std::vector<double>> lives;
};

// Study and campaign must outlive it.
class LifeMonitor {
  public:
    LifeMonitor(const Study& study, const Campaign& campaign);
    LifeMonitor(LifeMonitor&&) noexcept;
    ~LifeMonitor();

    const Study& study() const { return study_; }
    const Campaign& campaign() const { return campaign_; }

    // Every feature, and all fused where that is more, by every detector.
    const std::vector<MonitoredFeature>& answers() const { return answers_; }
    std::vector<TradeOff> trade_offs() const;
    std::vector<FeatureFan> fans() const;

  private:
    class Watched;
    struct Named;

    const Study& study_;
    const Campaign& campaign_;
    std::vector<Named> watched_;
    std::vector<MonitoredFeature> answers_;
};

}  // namespace gearpod::mc
