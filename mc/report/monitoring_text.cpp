// Text and JSON of the monitoring over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "mc/report/monitoring_over_time.hpp"

namespace gearpod::mc {
namespace {

std::string short_name(const std::string& name) {
    return name.substr(name.rfind('/') + 1);
}

std::string percent_interval(const analysis::Interval& bounds) {
    return fmt::format("[{}, {}]", analysis::percent_text(bounds.lower),
                       analysis::percent_text(bounds.upper));
}

// "3.2 day, days.h5 row 40", "none"
std::string alarm_text(const MonitoringOverTime& monitoring,
                       const std::optional<FirstAlarm>& alarm) {
    return alarm ? fmt::format("{}, {}", analysis::quantity_text(alarm->time, monitoring.time_unit),
                               short_name(monitoring.names.at(alarm->row)))
                 : "none";
}

// Recordings and time between the alarm and the last recording.
std::string lead_text(const MonitoringOverTime& monitoring,
                      const std::optional<FirstAlarm>& alarm) {
    return alarm ? fmt::format("{} rec., {}", alarm->recordings_left,
                               analysis::quantity_text(alarm->time_left, monitoring.time_unit))
                 : "";
}

std::string baseline_text(const MonitoringOverTime& monitoring) {
    return monitoring.baseline_records > 0
               ? fmt::format(
                     "Recordings in time order, compared with each gearbox's first {} "
                     "recordings{}; thresholds from the later healthy recordings",
                     monitoring.baseline_records,
                     monitoring.torque_regression ? ", with a linear regression on the torque" : "")
               : "Recordings in time order; thresholds from the healthy recordings";
}

// Rates that the healthy recordings can set.
std::string sample_text(const MonitoringOverTime& monitoring) {
    const double smallest = analysis::smallest_rate(monitoring.healthy);
    std::string text = fmt::format("{} healthy recordings", monitoring.healthy);
    text += monitoring.false_alarm_rate < smallest
                ? fmt::format(
                      " cannot set a threshold with a false-alarm rate of {}: the smallest "
                      "is {}, 1 in {}, which is used instead",
                      analysis::percent_text(monitoring.false_alarm_rate),
                      analysis::percent_text(smallest), monitoring.healthy + 1)
                : fmt::format(
                      " set thresholds with an expected false-alarm rate of {}; the "
                      "smallest that they can set is {}, 1 in {}",
                      analysis::percent_text(monitoring.false_alarm_rate),
                      analysis::percent_text(smallest), monitoring.healthy + 1);
    if (!monitoring.watched.empty()) {
        text += fmt::format(
            ". With a given threshold the rate lies in {} ({} confidence, independent recordings)",
            percent_interval(monitoring.watched.front().rate_bounds),
            analysis::percent_text(monitoring.confidence));
    }
    return text +
           ". Healthy alarms are those of the recordings that set the threshold, so their number "
           "follows from it. Held-out alarms are of the second half of the healthy recordings, "
           "with a threshold from the first half: they show what a drift does to it. Recordings "
           "of one gearbox resemble each other, so the intervals are too narrow.";
}

std::string drift_text(const MonitoringOverTime& monitoring) {
    constexpr double kLevel = 0.01;
    std::string text;
    for (const GearboxSeries& one : monitoring.gearboxes) {
        if (one.level.p_value < kLevel) {
            text += fmt::format(
                "{}The level of the healthy recordings{} drifts: sensor_rms changes by {:+.1f} % "
                "from the first to the last (Theil-Sen; Kendall's tau {:.2f}, p {:.2g} for "
                "independent recordings). Alarms of sensor_rms, change_sensor_rms and "
                "own_sensor_rms are "
                "no evidence of a fault by themselves.",
                text.empty() ? "" : " ", one.name.empty() ? "" : " of " + one.name,
                100.0 * one.level.change, one.level.tau, one.level.p_value);
        }
    }
    return text;
}

nlohmann::json first_json(const MonitoringOverTime& monitoring,
                          const std::optional<FirstAlarm>& alarm) {
    if (!alarm) {
        return nullptr;
    }
    return {{"row", alarm->row},
            {"time", alarm->time},
            {"recording", monitoring.names.at(alarm->row)},
            {"recordings_left", alarm->recordings_left},
            {"time_left", alarm->time_left}};
}

nlohmann::json gearbox_json(const MonitoringOverTime& monitoring, const GearboxAlarms& gearbox) {
    nlohmann::json json = {{"name", gearbox.name},
                           {"recordings", gearbox.recordings},
                           {"alarms", gearbox.alarms},
                           {"first", first_json(monitoring, gearbox.first)},
                           {"sustained", first_json(monitoring, gearbox.sustained)},
                           {"tooth", nullptr}};
    if (gearbox.sustained) {
        json["sustained"]["confirmed_by"] = monitoring.names.at(*gearbox.confirmed);
    }
    if (gearbox.tooth) {
        json["tooth"] = {{"number", gearbox.tooth->tooth},
                         {"same", gearbox.tooth->same},
                         {"recordings", gearbox.tooth->recordings}};
    }
    return json;
}

nlohmann::json series_json(const MonitoringOverTime& monitoring, const GearboxSeries& series) {
    nlohmann::json deviations = nlohmann::json::object(), teeth = nlohmann::json::array(),
                   healthy = nlohmann::json::array();
    for (std::size_t f = 0; f < series.deviations.size(); ++f) {
        deviations[monitoring.shown[f]] = analysis::numbers(series.deviations[f]);
    }
    for (const auto& one : series.teeth) {
        teeth.push_back(analysis::numbers(one));
    }
    for (const char one : series.healthy) {
        healthy.push_back(one != 0);
    }
    return {{"name", series.name},
            {"rows", series.rows},
            {"time", analysis::numbers(series.time)},
            {"healthy", healthy},
            {"alignment", analysis::numbers(series.alignment)},
            {"tooth_rms", teeth},
            {"first_tooth", analysis::numbers(series.first_tooth)},
            {"deviations", deviations},
            {"level",
             {{"change", analysis::number(series.level.change)},
              {"tau", analysis::number(series.level.tau)},
              {"p_value", analysis::number(series.level.p_value)}}}};
}

}  // namespace

analysis::Section monitoring_section(const MonitoringOverTime& monitoring,
                                     const std::vector<std::string>& features) {
    analysis::Section section{"monitoring", "Monitoring over time", {}};
    if (!monitoring.refusal.empty()) {
        section.state("monitoring.refusal",
                      "Monitoring over time is not possible: " + monitoring.refusal + ".");
        return section;
    }
    section.state(
        "monitoring.how",
        fmt::format("{}. The detector restarts after every alarm. An alarm is sustained if at "
                    "least {} of the next {} recordings alarm, too; the lead is counted from it to "
                    "the last recording.",
                    baseline_text(monitoring), monitoring.sustained.needed(),
                    monitoring.sustained.records));
    section.state("monitoring.sample", sample_text(monitoring));
    section.state("monitoring.drift", drift_text(monitoring));
    section.state("monitoring.note",
                  monitoring.note.empty() ? "" : analysis::capitalised(monitoring.note) + ".");
    analysis::Table table{
        "monitoring",
        "",
        {"feature", "detector", "threshold", "healthy alarms", "sustained", "held-out alarms",
         "later alarms", "first alarm", "sustained alarm", "lead", "worst tooth"},
        {}};
    table.labels = 2;
    const auto named = [&](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const RecordingMonitorResult& one : monitoring.watched) {
        if (!named(features, one.feature) && !named(monitoring.shown, one.feature)) {
            continue;
        }
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            if (gearbox.recordings == 0 || std::isnan(one.threshold.value)) {
                continue;
            }
            const analysis::HeldOutAlarms& held = one.held_out;
            table.rows.push_back(
                {one.feature, one.detector, analysis::number_text(one.threshold.value),
                 fmt::format("{} of {}", one.threshold.alarms, one.threshold.records),
                 std::to_string(one.healthy_sustained),
                 std::isnan(held.rate) ? ""
                                       : fmt::format("{} of {} {}", held.alarms, held.records,
                                                     percent_interval(held.bounds)),
                 fmt::format("{} of {}", gearbox.alarms, gearbox.recordings),
                 (gearbox.name.empty() ? "" : gearbox.name + ": ") +
                     alarm_text(monitoring, gearbox.first),
                 alarm_text(monitoring, gearbox.sustained),
                 lead_text(monitoring, gearbox.sustained),
                 gearbox.tooth ? fmt::format("{}, the same in {} of {}", gearbox.tooth->tooth,
                                             gearbox.tooth->same, gearbox.tooth->recordings)
                               : ""});
        }
    }
    section.add(std::move(table));
    return section;
}

nlohmann::json monitoring_json(const MonitoringOverTime& monitoring) {
    nlohmann::json watched = nlohmann::json::array(), series = nlohmann::json::array();
    for (const RecordingMonitorResult& one : monitoring.watched) {
        nlohmann::json gearboxes = nlohmann::json::array();
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            gearboxes.push_back(gearbox_json(monitoring, gearbox));
        }
        watched.push_back({{"feature", one.feature},
                           {"detector", one.detector},
                           {"threshold", analysis::number(one.threshold.value)},
                           {"healthy",
                            {{"recordings", one.threshold.records},
                             {"alarms", one.threshold.alarms},
                             {"sustained", one.healthy_sustained},
                             {"rate", one.rate},
                             {"lower", analysis::number(one.rate_bounds.lower)},
                             {"upper", analysis::number(one.rate_bounds.upper)}}},
                           {"held_out",
                            {{"recordings", one.held_out.records},
                             {"alarms", one.held_out.alarms},
                             {"rate", analysis::number(one.held_out.rate)},
                             {"lower", analysis::number(one.held_out.bounds.lower)},
                             {"upper", analysis::number(one.held_out.bounds.upper)}}},
                           {"gearboxes", gearboxes}});
    }
    for (const GearboxSeries& one : monitoring.gearboxes) {
        series.push_back(series_json(monitoring, one));
    }
    return {{"baseline_records", monitoring.baseline_records},
            {"false_alarm_rate", monitoring.false_alarm_rate},
            {"smallest_rate", analysis::smallest_rate(monitoring.healthy)},
            {"sustained",
             {{"records", monitoring.sustained.records}, {"share", monitoring.sustained.share}}},
            {"torque_regression", monitoring.torque_regression},
            {"time_unit", monitoring.time_unit},
            {"note", monitoring.note},
            {"refusal", monitoring.refusal},
            {"watched", watched},
            {"recordings", series}};
}

}  // namespace gearpod::mc
