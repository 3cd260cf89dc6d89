#include <nlohmann/json.hpp>

#include "analysis/monitoring/monitor_ranking.hpp"
#include "analysis/report/json_values.hpp"
#include "mc/input/printable.hpp"
#include "mc/report/lives_report.hpp"

namespace gearpod::mc {
namespace {

using LifeJson = nlohmann::json;

LifeJson trade_offs_json(const LifeMonitor& monitor) {
    LifeJson all = LifeJson::array();
    for (const TradeOff& trade : monitor.trade_offs()) {
        LifeJson points = LifeJson::array();
        for (const TradeOff::Point& point : trade.points) {
            points.push_back({{"stated_per_1000_h", point.stated_per_1000_h},
                              {"per_1000_h", analysis::number(point.per_1000_h)},
                              {"share", analysis::number(point.share)},
                              {"depth_50_m", analysis::number(point.depth_50_m)},
                              {"depth_90_m", analysis::number(point.depth_90_m)}});
        }
        all.push_back(
            {{"feature", trade.feature}, {"detector", trade.detector}, {"points", points}});
    }
    return all;
}

LifeJson fans_json(const LifeMonitor& monitor) {
    LifeJson all = LifeJson::array();
    for (const FeatureQuantiles& fan : monitor.feature_quantiles()) {
        LifeJson lives = LifeJson::array();
        for (const std::vector<double>& life : fan.lives) {
            lives.push_back(analysis::numbers(life));
        }
        all.push_back({{"feature", fan.feature},
                       {"healthy_05", analysis::numbers(fan.low)},
                       {"healthy_50", analysis::numbers(fan.median)},
                       {"healthy_95", analysis::numbers(fan.high)},
                       {"lives", lives}});
    }
    return all;
}

}  // namespace

nlohmann::json life_result_json(const MonitoredFeature& one) {
    const analysis::MonitorPerformance& a = one.performance;
    return {{"feature", one.feature},
            {"detector", one.detector},
            {"threshold", analysis::number(a.threshold.value)},
            {"threshold_hours", a.threshold.hours},
            {"false_alarms",
             {{"count", a.false_alarms.alarms},
              {"hours", a.false_alarms.hours},
              {"per_1000_h", analysis::number(a.false_alarms.per_1000_h)},
              {"bounds", analysis::to_json(a.false_alarms.bounds)},
              {"dispersion", a.false_alarms.dispersion},
              {"expected", analysis::to_json(a.expected_per_1000_h)}}},
            {"ended", a.ended},
            {"found", a.found},
            {"share", analysis::number(a.share)},
            {"share_bounds", analysis::to_json(a.share_bounds)},
            {"share_by_chance", analysis::number(a.share_by_chance)},
            {"share_at_stated_rate", analysis::number(a.share_at_stated_rate)},
            {"net_share", analysis::number(analysis::net_share(a))},
            {"unranked", analysis::text_or_null(one.unranked)},
            {"best_of_feature", one.best_of_feature},
            {"effect_depth_m", analysis::number(a.effect_size)},
            {"early_alarms", a.early_alarms},
            {"early_hours", a.early_hours},
            {"depth_50_m", analysis::number(a.size_50.value)},
            {"depth_50_bound_m", analysis::number(a.size_50.bound)},
            {"depth_90_m", analysis::number(a.size_90.value)},
            {"depth_90_bound_m", analysis::number(a.size_90.bound)},
            {"warning_50_h", analysis::number(a.warning_50)},
            {"warning_90_h", analysis::number(a.warning_90)}};
}

nlohmann::json lives_json(const LifeMonitor& monitor, bool shows_withheld) {
    const Study& study = monitor.study();
    const Campaign& campaign = monitor.campaign();
    LifeJson watched = LifeJson::array(), lives = LifeJson::array();
    const InterpolationErrors& off = campaign.interpolation;
    for (const MonitoredFeature& one : monitor.results()) {
        watched.push_back(life_result_json(one));
        watched.back()["alarm_h"] = analysis::numbers(one.performance.alarm_hours);
    }
    for (const GearboxLife& life : campaign.cracked) {
        LifeJson hours = LifeJson::array(), depths = LifeJson::array();
        for (const LifeRecord& record : life.history.records) {
            hours.push_back(record.hours);
            depths.push_back(record.depth_m);
        }
        lives.push_back({{"status", static_cast<int>(life.status)},
                         {"end_h", life.history.end_hours ? LifeJson(*life.history.end_hours)
                                                          : LifeJson(nullptr)},
                         {"hours", hours},
                         {"depth_m", depths}});
    }
    return {
        {"kind", "lives"},
        {"title", study.title},
        {"interval_h", *study.life.interval_h},
        {"record", printable(campaign.record)},
        {"baseline_records", study.monitoring.baseline_records},
        {"first_depth_m", crack_begin_m(study.life)},
        {"last_depth_m", *study.life.last_depth_m},
        {"healthy_lives",
         {{"setting", campaign.threshold_lives.size()}, {"counting", campaign.healthy.size()}}},
        {"false_alarms_per_1000_h", study.monitoring.false_alarms_per_1000_h},
        {"failed", campaign.failed},
        {"interpolation",
         {{"first_depth_m", first_interpolated_m(study.life)},
          {"first", analysis::number(off.first)},
          {"last_depth_m", last_interpolated_m(study.life)},
          {"last", analysis::number(off.last)},
          {"load", analysis::number(off.load)},
          {"smallest_depth_m", smallest_depth_m(study.life)},
          {"change", analysis::number(off.change)}}},
        {"costs",
         {{"gearboxes", campaign.costs.gearbox_count},
          {"gearbox_s", campaign.costs.gearboxes},
          {"records", campaign.costs.record_count},
          {"record_s", campaign.costs.records}}},
        {"withheld", analysis::text_or_null(shows_withheld ? "" : why_withheld(study, campaign))},
        {"findings", findings_json(lives_report(monitor, shows_withheld))},
        {"monitored", watched},
        {"ranking", monitor.ranking()},
        {"trade_offs", trade_offs_json(monitor)},
        {"fans", fans_json(monitor)},
        {"lives", lives}};
}

}  // namespace gearpod::mc
