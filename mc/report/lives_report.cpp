#include "mc/report/lives_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "analysis/report/text_lines.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/study/assumptions.hpp"

namespace gearpod::mc {
namespace {

using LifeJson = nlohmann::json;

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
    for (const FeatureFan& fan : monitor.fans()) {
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
        "processor time: {:.3g} s for each of {} gearboxes, {:.3g} ms for each of {} records\n",
        costs.gearboxes / static_cast<double>(std::max(1L, costs.gearbox_count)),
        costs.gearbox_count,
        1e3 * costs.records / static_cast<double>(std::max(1L, costs.record_count)),
        costs.record_count);
}

// Formats the share found: "27/32 [0.68, 0.93]"; "-" if no tooth fails or there is no threshold.
std::string share_text(const analysis::LifeAnswers& a) {
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
        "interpolation error (rms): {:.2g} of the change due to the crack at {:.3g} mm, {:.2g} at "
        "{:.3g} mm",
        off.first, 1e3 * first_interpolated_m(life), off.last, 1e3 * last_interpolated_m(life));
    if (off.load > 0.0) {
        text += fmt::format("; {:.2g} of the signal between the integrated torques and speeds",
                            off.load);
    }
    return text;
}

// Explains the dashes in the table; "" if there are none.
std::string unanswered_text(const LifeMonitor& monitor, std::ptrdiff_t ended) {
    std::string out;
    const Study& study = monitor.study();
    const double rate = study.monitoring.false_alarms_per_1000_h;
    if (ended == 0) {
        analysis::add_wrapped(out,
                              fmt::format("no tooth fails within {} records of {:g} h, so no crack "
                                          "can be found before the end; raise life.records",
                                          study.life.records, *study.life.interval_h),
                              2);
    }
    for (const MonitoredFeature& one : monitor.answers()) {
        const analysis::MonitorThreshold& threshold = one.answers.threshold;
        if (!std::isnan(threshold.value)) {
            continue;
        }
        const bool few = threshold.least_per_1000_h > rate;
        analysis::add_wrapped(
            out,
            few ? fmt::format("no threshold: {:.0f} h of healthy lives are too few for {:g} false "
                              "alarms per 1000 h{}",
                              threshold.hours, rate,
                              threshold.hours > 0.0
                                  ? fmt::format("; the lowest rate that they allow is {:.3g}",
                                                threshold.least_per_1000_h)
                                  : "")
                : fmt::format("no threshold: {} needs more than {} records after the baseline",
                              one.detector, study.life.records - study.monitoring.baseline_records),
            2);
        break;
    }
    return out;
}

}  // namespace

std::vector<std::string> answer_columns(const Study& study) {
    return {"threshold",        "false alarms/1000 h",
            "found before end", "by chance",
            "mm 50 %",          fmt::format("90 % (at {:g} %)", 100.0 * study.detection.confidence),
            "warning h 50 %",   "90 %"};
}

std::vector<std::string> answer_cells(const analysis::LifeAnswers& a, const Study& study) {
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
    std::string out = fmt::format(
        "{} cracks grow from {:g} to {:g} mm, with a record every {:g} h\n"
        "{} teeth fail within {} records\n"
        "thresholds: from {} healthy lives, for {:g} false alarms per 1000 h\n"
        "false alarms: counted in {} other healthy lives\n",
        campaign.cracked.size(), 1e3 * crack_begin_m(study.life), 1e3 * *study.life.last_depth_m,
        *study.life.interval_h, ended, study.life.records, campaign.setting.size(),
        study.monitoring.false_alarms_per_1000_h, campaign.healthy.size());
    if (const std::string holds = assumptions(study, true); !holds.empty()) {
        analysis::add_wrapped(out, holds, 2);
    }
    out += wrapped_text("record: " + printable(campaign.record), 2) + "\n";
    if (campaign.failed > 0) {
        out += fmt::format("{} gearboxes failed and are ignored\n", campaign.failed);
    }
    if (const std::string off = interpolation_text(campaign, study.life); !off.empty()) {
        analysis::add_wrapped(out, off, 2);
    }
    out += costs_text(campaign) + "\n";
    std::vector<std::vector<std::string>> lines{{"feature", "detector"}};
    std::ranges::copy(answer_columns(study), std::back_inserter(lines.front()));
    for (const MonitoredFeature& one : monitor.answers()) {
        lines.push_back({one.feature, one.detector});
        std::ranges::copy(answer_cells(one.answers, study), std::back_inserter(lines.back()));
    }
    return out + table_text(lines) + unanswered_text(monitor, ended);
}

nlohmann::json answers_json(const MonitoredFeature& one) {
    const analysis::LifeAnswers& a = one.answers;
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
    for (const MonitoredFeature& one : monitor.answers()) {
        watched.push_back(answers_json(one));
        watched.back()["alarm_h"] = numbers_json(one.answers.alarm_hours);
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
             {{"setting", campaign.setting.size()}, {"counting", campaign.healthy.size()}}},
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
