#include "mc/report/lives_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "analysis/report/text_lines.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/study/assumptions.hpp"

namespace gearpod::mc {
namespace {

using LifeJson = nlohmann::json;

// Adds the text in lines that fit kLineWidth.
void add_text(std::string& out, const std::string& text) {
    analysis::add_wrapped(out, text, 2, kLineWidth);
}

// Formats a depth in mm: "2.31", or "> 4" if the probability is not reached at the last depth.
std::string depth_text(double depth_m, const Study& study) {
    return std::isnan(depth_m)   ? "-"
           : std::isinf(depth_m) ? fmt::format("> {:g}", 1e3 * *study.life.last_depth_m)
                                 : fmt::format("{:.3g}", 1e3 * depth_m);
}

std::string number_or_dash(double value) {
    return std::isnan(value) ? "-" : fmt::format("{:.3g}", value);
}

LifeJson numbers_json(const std::vector<double>& values) {
    LifeJson all = LifeJson::array();
    for (const double value : values) {
        all.push_back(analysis::number(value));
    }
    return all;
}

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
            lives.push_back(numbers_json(life));
        }
        all.push_back({{"feature", fan.feature},
                       {"healthy_05", numbers_json(fan.low)},
                       {"healthy_50", numbers_json(fan.median)},
                       {"healthy_95", numbers_json(fan.high)},
                       {"lives", lives}});
    }
    return all;
}

LifeJson interval_json(const analysis::Interval& interval) {
    return {analysis::number(interval.lower), analysis::number(interval.upper)};
}

std::string costs_text(const Campaign& campaign) {
    const LifeCosts& costs = campaign.costs;
    if (costs.gearbox_count == 0) {
        return "";  // an earlier run had computed all gearboxes
    }
    return fmt::format(
        "processor time: {:.3g} s per gearbox, {:.3g} ms per record ({} gearboxes, {} records)",
        costs.gearboxes / static_cast<double>(std::max(1L, costs.gearbox_count)),
        1e3 * costs.records / static_cast<double>(std::max(1L, costs.record_count)),
        costs.gearbox_count, costs.record_count);
}

// Formats the share found: "27/32 [0.68, 0.93]"; "-" if no tooth fails or there is no threshold.
std::string share_text(const analysis::MonitorPerformance& a) {
    return std::isnan(a.share) ? "-"
                               : fmt::format("{}/{} [{:.2f}, {:.2f}]", a.found, a.ended,
                                             a.share_bounds.lower, a.share_bounds.upper);
}

// Aligns cells in columns; the first two columns are left-aligned, the others right-aligned.
std::string table_text(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            widths[c] = std::max(widths[c], line[c].size());
        }
    }
    std::string text;
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            text += c < 2 ? fmt::format("{:<{}}", line[c], widths[c] + (c == 0 ? 2 : 0))
                          : fmt::format("  {:>{}}", line[c], widths[c]);
        }
        text += '\n';
    }
    return text;
}

std::string interpolation_text(const Campaign& campaign, const Life& life) {
    const InterpolationErrors& off = campaign.interpolation;
    if (std::isnan(off.first)) {
        return "";  // none of the gearboxes used for the error estimate was integrated
    }
    std::string text = fmt::format(
        "interpolation error of the signals (rms): {:.2g} of the crack's effect at {:.3g} mm, "
        "{:.2g} of it at {:.3g} mm",
        off.first, 1e3 * first_interpolated_m(life), off.last, 1e3 * last_interpolated_m(life));
    if (off.load > 0.0) {
        text += fmt::format("; {:.2g} of the signal between the integrated torques and speeds",
                            off.load);
    }
    return text;
}

// Explains the dashes in the table; "" if there are none.
std::string missing_results_text(const LifeMonitor& monitor, std::ptrdiff_t ended) {
    std::string out;
    const Study& study = monitor.study();
    const double rate = study.monitoring.false_alarms_per_1000_h;
    if (ended == 0) {
        add_text(out, fmt::format("no tooth fails within {} records, one every {:g} h: no crack "
                                  "can be found before failure; raise life.records",
                                  study.life.records, *study.life.interval_h));
    }
    for (const MonitoredFeature& one : monitor.results()) {
        const analysis::MonitorThreshold& threshold = one.performance.threshold;
        if (!std::isnan(threshold.value)) {
            continue;
        }
        const bool few = threshold.least_per_1000_h > rate;
        add_text(
            out,
            few ? fmt::format("no threshold: {:.0f} h of healthy lives are too few for {:g} false "
                              "alarms in 1000 h{}",
                              threshold.hours, rate,
                              threshold.hours > 0.0
                                  ? fmt::format("; the smallest number possible is {:.3g}",
                                                threshold.least_per_1000_h)
                                  : "")
                : fmt::format("no threshold: {} needs more than {} records after the baseline",
                              one.detector,
                              study.life.records - study.monitoring.baseline_records));
        break;
    }
    return out;
}

// A column of a table: its head, and the index of its cell in life_result_cells().
struct ShownCell {
    const char* head;
    std::size_t cell;
};

// Title and table of some results of every feature with every detector.
std::string results_table(const LifeMonitor& monitor, const std::string& title,
                          const std::vector<ShownCell>& shown) {
    std::vector<std::vector<std::string>> lines{{"feature", "detector"}};
    for (const ShownCell& column : shown) {
        lines.front().emplace_back(column.head);
    }
    for (const MonitoredFeature& one : monitor.results()) {
        const std::vector<std::string> cells = life_result_cells(one.performance, monitor.study());
        lines.push_back({one.feature, one.detector});
        for (const ShownCell& column : shown) {
            lines.back().push_back(cells[column.cell]);
        }
    }
    std::string text = "\n";
    add_text(text, title);
    return text + table_text(lines);
}

}  // namespace

std::vector<std::string> life_result_columns(const Study& study) {
    return {
        "threshold",        "false alarms/1000 h",
        "found before end", "by chance",
        "a50, mm",          fmt::format("a90 ({:g} % bound)", 100.0 * study.detection.confidence),
        "w50, h",           "w90, h"};
}

std::vector<std::string> life_result_cells(const analysis::MonitorPerformance& a,
                                           const Study& study) {
    const analysis::FalseAlarms& f = a.false_alarms;
    return {number_or_dash(a.threshold.value),
            std::isnan(f.per_1000_h)
                ? "-"
                : fmt::format("{} [{}, {}]", number_or_dash(f.per_1000_h),
                              number_or_dash(f.bounds.lower), number_or_dash(f.bounds.upper)),
            share_text(a),
            std::isnan(a.share_by_chance) ? "-" : fmt::format("{:.2f}", a.share_by_chance),
            depth_text(a.size_50.value, study),
            std::isnan(a.size_90.value) ? "-"
                                        : depth_text(a.size_90.value, study) + " (" +
                                              depth_text(a.size_90.bound, study) + ")",
            number_or_dash(a.warning_50),
            number_or_dash(a.warning_90)};
}

std::string lives_text(const LifeMonitor& monitor) {
    const Study& study = monitor.study();
    const Campaign& campaign = monitor.campaign();
    const auto ended = std::ranges::count_if(campaign.cracked, [](const GearboxLife& one) {
        return one.status == Status::ok && one.history.end_hours.has_value();
    });
    const double confidence = 100.0 * study.detection.confidence;
    std::string out;
    add_text(out, fmt::format("{} cracks grow from {:g} to {:g} mm, with a record every {:g} h; {} "
                              "teeth fail within {} records",
                              campaign.cracked.size(), 1e3 * crack_begin_m(study.life),
                              1e3 * *study.life.last_depth_m, *study.life.interval_h, ended,
                              study.life.records));
    add_text(out, fmt::format("thresholds: {:g} false alarms in 1000 h, from {} healthy lives; "
                              "false alarms: counted on {} other healthy lives",
                              study.monitoring.false_alarms_per_1000_h,
                              campaign.threshold_lives.size(), campaign.healthy.size()));
    if (const std::string holds = assumptions(study, true); !holds.empty()) {
        add_text(out, holds);
    }
    add_text(out, "record: " + printable(campaign.record));
    if (campaign.failed > 0) {
        out += fmt::format("{} gearboxes failed and are ignored\n", campaign.failed);
    }
    for (const std::string& line :
         {interpolation_text(campaign, study.life), costs_text(campaign)}) {
        if (!line.empty()) {
            add_text(out, line);
        }
    }
    out += results_table(
        monitor,
        fmt::format("Threshold, and false alarms in 1000 h with their {:g} % interval:",
                    confidence),
        {{"threshold", 0}, {"false alarms", 1}});
    out += results_table(
        monitor,
        fmt::format("Cracks found before the tooth fails, with the {:g} % interval of the share; "
                    "by chance: the share that false alarms alone would find:",
                    confidence),
        {{"found", 2}, {"by chance", 3}});
    out += results_table(
        monitor,
        fmt::format("Crack depth in mm at which 50 % (a50) and 90 % of the cracks are found (a90, "
                    "with its bound at {:g} % confidence). Time in h from the alarm to failure: "
                    "median (w50), and time that 90 % of the cracks found exceed (w90):",
                    confidence),
        {{"a50", 4}, {"a90 (bound)", 5}, {"w50", 6}, {"w90", 7}});
    return out + missing_results_text(monitor, ended);
}

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
              {"bounds", interval_json(a.false_alarms.bounds)},
              {"dispersion", a.false_alarms.dispersion},
              {"expected", interval_json(a.expected_per_1000_h)}}},
            {"ended", a.ended},
            {"found", a.found},
            {"share", analysis::number(a.share)},
            {"share_bounds", interval_json(a.share_bounds)},
            {"share_by_chance", analysis::number(a.share_by_chance)},
            {"depth_50_m", analysis::number(a.size_50.value)},
            {"depth_50_bound_m", analysis::number(a.size_50.bound)},
            {"depth_90_m", analysis::number(a.size_90.value)},
            {"depth_90_bound_m", analysis::number(a.size_90.bound)},
            {"warning_50_h", analysis::number(a.warning_50)},
            {"warning_90_h", analysis::number(a.warning_90)}};
}

nlohmann::json lives_json(const LifeMonitor& monitor) {
    const Study& study = monitor.study();
    const Campaign& campaign = monitor.campaign();
    LifeJson watched = LifeJson::array(), lives = LifeJson::array();
    const InterpolationErrors& off = campaign.interpolation;
    for (const MonitoredFeature& one : monitor.results()) {
        watched.push_back(life_result_json(one));
        watched.back()["alarm_h"] = numbers_json(one.performance.alarm_hours);
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
    return {{"kind", "lives"},
            {"title", study.title},
            {"assumptions", assumptions(study, true)},
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
              {"load", analysis::number(off.load)}}},
            {"costs",
             {{"gearboxes", campaign.costs.gearbox_count},
              {"gearbox_s", campaign.costs.gearboxes},
              {"records", campaign.costs.record_count},
              {"record_s", campaign.costs.records}}},
            {"monitored", watched},
            {"trade_offs", trade_offs_json(monitor)},
            {"fans", fans_json(monitor)},
            {"lives", lives}};
}

}  // namespace gearpod::mc
