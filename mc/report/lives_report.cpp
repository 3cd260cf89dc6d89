#include "mc/report/lives_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"

namespace gearpod::mc {
namespace {

using LifeJson = nlohmann::json;

// "2.31", "> 4" where that many are not found before the last depth.
std::string depth_text(double depth_m, const Study& study) {
    return std::isnan(depth_m)   ? "-"
           : std::isinf(depth_m) ? fmt::format("> {:g}", 1e3 * *study.life.last_depth_m)
                                 : fmt::format("{:.3g}", 1e3 * depth_m);
}

std::string number_or_dash(double value) {
    return std::isnan(value) ? "-" : fmt::format("{:.3g}", value);
}

LifeJson interval_json(const analysis::Interval& interval) {
    return {analysis::number(interval.lower), analysis::number(interval.upper)};
}

std::string costs_text(const Campaign& campaign) {
    const LifeCosts& costs = campaign.costs;
    return fmt::format(
        "processor time: {:.3g} s a gearbox, {:.3g} ms a record ({} gearboxes, {} records)\n",
        costs.gearboxes / static_cast<double>(std::max(1L, costs.gearbox_count)),
        1e3 * costs.records / static_cast<double>(std::max(1L, costs.record_count)),
        costs.gearbox_count, costs.record_count);
}

std::string row_text(const MonitoredFeature& one, const Study& study) {
    const analysis::LifeAnswers& a = one.answers;
    const analysis::FalseAlarms& f = a.false_alarms;
    return fmt::format(
        "{:<20}{:<12}{:>10}{:>22}{:>20}{:>8}{:>16}{:>9}{:>9}\n", one.feature, one.detector,
        number_or_dash(a.threshold.value),
        fmt::format("{} [{}, {}]", number_or_dash(f.per_1000_h), number_or_dash(f.bounds.lower),
                    number_or_dash(f.bounds.upper)),
        fmt::format("{}/{} [{:.2f}, {:.2f}]", a.found, a.ended, a.share_bounds.lower,
                    a.share_bounds.upper),
        depth_text(a.size_50.value, study),
        depth_text(a.size_90.value, study) + " (" + depth_text(a.size_90.bound, study) + ")",
        number_or_dash(a.warning_50), number_or_dash(a.warning_90));
}

}  // namespace

std::string lives_text(const Study& study, const Campaign& campaign,
                       const std::vector<MonitoredFeature>& monitored) {
    const auto ended = std::ranges::count_if(
        campaign.cracked, [](const GearboxLife& one) { return one.history.end_hours.has_value(); });
    std::string out = fmt::format(
        "{} cracks grow from {:g} to {:g} mm, a record each {:g} h: {} teeth go within {} records\n"
        "thresholds: {} healthy lives, {:g} false alarms in 1000 h; false alarms: {} other healthy "
        "lives\n",
        campaign.cracked.size(), 1e3 * *study.life.first_depth_m, 1e3 * *study.life.last_depth_m,
        *study.life.interval_h, ended, study.life.records, campaign.setting.size(),
        study.monitoring.false_alarms_per_1000_h, campaign.healthy.size());
    if (campaign.failed > 0) {
        out += fmt::format("{} gearboxes failed and are left out\n", campaign.failed);
    }
    const InterpolationErrors& off = campaign.interpolation;
    out += fmt::format(
        "interpolated signals are off (rms): by {:.2g} of what the crack changes at {:.3g} mm, by "
        "{:.2g} of it at {:.3g} mm; between torques by {:.2g} of the signal\n",
        off.first, 1e3 * off.first_m, off.last, 1e3 * off.last_m, off.torque);
    out += costs_text(campaign) + "\n";
    out += fmt::format("{:<20}{:<12}{:>10}{:>22}{:>20}{:>8}{:>16}{:>9}{:>9}\n", "feature",
                       "detector", "threshold", "false alarms/1000 h", "found before end",
                       "mm 50 %", "90 % (95 % conf.)", "warn h", "9 in 10");
    for (const MonitoredFeature& one : monitored) {
        out += row_text(one, study);
    }
    for (const MonitoredFeature& one : monitored) {
        if (std::isnan(one.answers.threshold.value)) {
            out += fmt::format(
                "no threshold: {:.0f} h of healthy lives are too few for {:g} false alarms in 1000 "
                "h; {:.3g} is the least that they can set\n",
                one.answers.threshold.hours, study.monitoring.false_alarms_per_1000_h,
                one.answers.threshold.least_per_1000_h);
            break;
        }
    }
    return out;
}

nlohmann::json lives_json(const Study& study, const Campaign& campaign,
                          const std::vector<MonitoredFeature>& monitored) {
    LifeJson watched = LifeJson::array(), lives = LifeJson::array();
    const InterpolationErrors& off = campaign.interpolation;
    for (const MonitoredFeature& one : monitored) {
        const analysis::LifeAnswers& a = one.answers;
        watched.push_back({{"feature", one.feature},
                           {"detector", one.detector},
                           {"threshold", analysis::number(a.threshold.value)},
                           {"threshold_hours", a.threshold.hours},
                           {"false_alarms",
                            {{"count", a.false_alarms.alarms},
                             {"hours", a.false_alarms.hours},
                             {"per_1000_h", analysis::number(a.false_alarms.per_1000_h)},
                             {"bounds", interval_json(a.false_alarms.bounds)},
                             {"dispersion", a.false_alarms.dispersion},
                             {"expected", interval_json(a.expected_per_1000_h)}}},
                           {"ended", a.ended},
                           {"found", a.found},
                           {"share", analysis::number(a.share)},
                           {"share_bounds", interval_json(a.share_bounds)},
                           {"depth_50_m", analysis::number(a.size_50.value)},
                           {"depth_50_bound_m", analysis::number(a.size_50.bound)},
                           {"depth_90_m", analysis::number(a.size_90.value)},
                           {"depth_90_bound_m", analysis::number(a.size_90.bound)},
                           {"warning_50_h", analysis::number(a.warning_50)},
                           {"warning_90_h", analysis::number(a.warning_90)}});
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
    return {{"title", study.title},
            {"false_alarms_per_1000_h", study.monitoring.false_alarms_per_1000_h},
            {"failed", campaign.failed},
            {"interpolation",
             {{"first_depth_m", off.first_m},
              {"first", analysis::number(off.first)},
              {"last_depth_m", off.last_m},
              {"last", analysis::number(off.last)},
              {"torque", analysis::number(off.torque)}}},
            {"costs",
             {{"gearboxes", campaign.costs.gearbox_count},
              {"gearbox_s", campaign.costs.gearboxes},
              {"records", campaign.costs.record_count},
              {"record_s", campaign.costs.records}}},
            {"monitored", watched},
            {"lives", lives}};
}

}  // namespace gearpod::mc
