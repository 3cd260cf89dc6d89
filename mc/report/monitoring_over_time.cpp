#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/monitoring/baseline_deviations.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "machine/no_value.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kFused = "fused";

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

// Recordings of one gearbox in time order.
struct GearboxRecords {
    std::string name;
    std::vector<std::size_t> rows;
    std::vector<char> healthy, faulty;        // both 0: condition unknown
    std::vector<double> time, torque;         // torque: may be empty
    std::vector<std::vector<double>> values;  // by feature

    bool has_baseline(std::size_t records) const {
        return rows.size() > records && std::ranges::count(std::span(faulty).first(records), 0) ==
                                            static_cast<std::ptrdiff_t>(records);
    }
};

// Groups recordings by gearbox. If no recording has a gearbox name, all belong to one gearbox;
// otherwise recordings without a name are omitted.
std::vector<GearboxRecords> gearboxes_of(const Results& frame, const RowSource& rows,
                                         std::size_t time,
                                         const std::optional<std::size_t>& torque) {
    const RowShape shape = row_shape(frame);
    const std::vector<std::string> names = lines_of(frame.provenance_value("recorded_gearboxes"));
    std::map<std::string, std::vector<std::pair<double, std::size_t>>> rows_of;  // time and row
    std::vector<std::pair<int, std::vector<double>>> all;                        // group and values
    for_each_row(rows, [&](const ResultRow& row) {
        rows_of[all.size() < names.size() ? names[all.size()] : ""].emplace_back(row.values[time],
                                                                                 all.size());
        all.emplace_back(row.group, std::vector(row.values, row.values + shape.values()));
    });
    if (rows_of.size() > 1) {
        rows_of.erase("");
    }
    std::vector<GearboxRecords> gearboxes;
    for (auto& [name, in_order] : rows_of) {
        std::ranges::stable_sort(in_order, {}, &std::pair<double, std::size_t>::first);
        GearboxRecords one{name, {}, {}, {}, {}, {}, {}};
        one.values.resize(shape.features);
        for (const auto& [when, row] : in_order) {
            const auto& [group, values] = all[row];
            one.rows.push_back(row);
            one.healthy.push_back(group == static_cast<int>(Group::threshold));
            one.faulty.push_back(group == static_cast<int>(Group::test));
            one.time.push_back(when);
            if (torque) {
                one.torque.push_back(values[*torque]);
            }
            for (std::size_t f = 0; f < shape.features; ++f) {
                one.values[f].push_back(values[shape.value_of(f, 0)]);
            }
        }
        gearboxes.push_back(std::move(one));
    }
    return gearboxes;
}

// Values of the healthy recordings after the baseline.
analysis::HealthyRecords healthy_values(const GearboxRecords& gearbox,
                                        const std::vector<double>& deviations) {
    analysis::HealthyRecords healthy;
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        if (gearbox.healthy[i] != 0 && !std::isnan(deviations[i])) {
            healthy.push_back({gearbox.time[i], deviations[i]});
        }
    }
    return healthy;
}

FirstAlarm first_alarm(const GearboxRecords& gearbox, std::size_t i) {
    return {gearbox.rows[i], gearbox.time[i], static_cast<long>(gearbox.rows.size() - 1 - i),
            gearbox.time.back() - gearbox.time[i]};
}

// Worst tooth of a recording in mesh periods from the baseline's start; NaN if unknown.
double worst_position(const GearboxSeries& series, std::size_t i) {
    if (series.teeth.empty() || series.teeth[i].empty()) {
        return kNan;
    }
    const auto& rms = series.teeth[i];
    return series.first_tooth[i] + static_cast<double>(std::ranges::max_element(rms) - rms.begin());
}

std::optional<AlarmTooth> alarm_tooth(const GearboxSeries& series,
                                      const analysis::SustainedAlarm& alarm) {
    const double at = worst_position(series, alarm.first);
    if (std::isnan(at)) {
        return std::nullopt;
    }
    const auto teeth = static_cast<double>(series.teeth[alarm.first].size());
    AlarmTooth tooth{static_cast<int>(std::fmod(std::round(at), teeth)) + 1, 0, 0};
    for (std::size_t i = alarm.first; i <= alarm.confirmed; ++i) {
        const double away = std::abs(worst_position(series, i) - at);
        if (!std::isnan(away)) {
            ++tooth.recordings;
            tooth.same += std::min(away, teeth - away) <= 1.0 ? 1 : 0;
        }
    }
    return tooth;
}

GearboxAlarms monitor_gearbox(const GearboxRecords& gearbox, const GearboxSeries& series,
                              const std::vector<double>& deviations,
                              const analysis::Detector& detector,
                              const analysis::RecordThreshold& threshold,
                              const analysis::SustainedRule& rule, long& healthy_sustained) {
    GearboxAlarms watched{gearbox.name, 0, 0, {}, {}, {}, {}};
    const auto alarms = analysis::record_alarms(detector, deviations, threshold);
    for (std::size_t i = 0; i < alarms.size(); ++i) {
        if (gearbox.healthy[i] != 0 || !alarms[i]) {
            continue;
        }
        ++watched.recordings;
        watched.alarms += *alarms[i] ? 1 : 0;
        if (*alarms[i] && !watched.first) {
            watched.first = first_alarm(gearbox, i);
        }
    }
    for (const analysis::SustainedAlarm& one : analysis::sustained_alarms(alarms, rule)) {
        if (gearbox.healthy[one.first] != 0) {
            ++healthy_sustained;
        } else if (!watched.sustained) {
            watched.sustained = first_alarm(gearbox, one.first);
            watched.confirmed = gearbox.rows[one.confirmed];
            watched.tooth = alarm_tooth(series, one);
        }
    }
    return watched;
}

std::vector<double> numbers_of(const std::string& line) {
    std::istringstream stream(line);
    std::vector<double> numbers;
    for (std::string field; std::getline(stream, field, ',');) {
        numbers.push_back(std::strtod(field.c_str(), nullptr));
    }
    return numbers;
}

// Alignments and tooth maps of the recordings as features stores them.
GearboxSeries series_of(const Results& frame, const GearboxRecords& gearbox) {
    GearboxSeries series{gearbox.name, gearbox.rows, gearbox.time, gearbox.healthy, {}, {}, {}, {}};
    const auto alignments = lines_of(frame.provenance_value("recorded_alignments"));
    const auto maps = lines_of(frame.provenance_value("recorded_teeth"));
    for (const std::size_t row : gearbox.rows) {
        if (row < alignments.size() && row < maps.size()) {
            series.alignment.push_back(std::strtod(alignments[row].c_str(), nullptr));
            const std::vector<double> map = numbers_of(maps[row]);
            series.first_tooth.push_back(map.empty() ? kNan : map.front());
            series.teeth.emplace_back(map.begin() + (map.empty() ? 0 : 1), map.end());
        }
    }
    return series;
}

// Deviations of a feature, or of several combined, from the gearbox's first recordings.
std::vector<double> deviations_of(const Results& frame, const GearboxRecords& gearbox,
                                  const std::vector<std::size_t>& features, std::size_t baseline) {
    if (features.size() == 1) {
        return analysis::baseline_deviations(gearbox.values[features[0]], gearbox.torque, baseline,
                                             frame.features[features[0]].alarm);
    }
    std::vector<std::vector<double>> values;
    std::vector<analysis::Alarm> alarms;
    for (const std::size_t f : features) {
        values.push_back(gearbox.values[f]);
        alarms.push_back(frame.features[f].alarm);
    }
    return analysis::fused_deviations(values, gearbox.torque, baseline, alarms);
}

// Recordings of a series without a fault that are drawn at most.
long longest_run(double rate) {
    constexpr double kIntervals = 5.0, kMost = 2000.0;  // expected intervals between alarms
    return std::lround(std::min(kMost, kIntervals / rate));
}

// Monitors every feature separately, and the study's features combined ("fused").
void monitor_all(const Results& frame, const MeasuringFacts& facts,
                 const std::vector<GearboxRecords>& gearboxes, MonitoringOverTime& monitoring) {
    const auto baseline = static_cast<std::size_t>(facts.monitoring.baseline_records);
    const double stated = frame.request.false_alarm_rate, confidence = frame.request.confidence;
    const auto add = [&](const std::string& name, const std::vector<std::size_t>& features,
                         bool shown) {
        std::vector<std::vector<double>> deviations;
        std::vector<analysis::HealthyRecords> healthy;
        for (std::size_t g = 0; g < gearboxes.size(); ++g) {
            deviations.push_back(deviations_of(frame, gearboxes[g], features, baseline));
            healthy.push_back(healthy_values(gearboxes[g], deviations.back()));
            if (shown) {
                monitoring.gearboxes[g].deviations.push_back(deviations.back());
            }
        }
        if (shown) {
            monitoring.shown.push_back(name);
        }
        for (const std::string& text : facts.monitoring.detectors) {
            const analysis::Detector detector = *analysis::parse_detector(text);
            RecordingMonitorResult one{
                name, text, record_threshold(detector, healthy, stated),
                kNan, 0,    held_out_alarms(detector, healthy, stated, confidence),
                {}};
            for (std::size_t g = 0; g < gearboxes.size(); ++g) {
                one.gearboxes.push_back(
                    monitor_gearbox(gearboxes[g], monitoring.gearboxes[g], deviations[g], detector,
                                    one.threshold, monitoring.sustained, one.healthy_sustained));
            }
            if (shown && !std::isnan(one.threshold.value)) {
                one.run_length =
                    run_length(detector, healthy, one.threshold, longest_run(one.threshold.rate));
            }
            monitoring.watched.push_back(std::move(one));
        }
    };
    for (const GearboxRecords& gearbox : gearboxes) {
        monitoring.gearboxes.push_back(series_of(frame, gearbox));
    }
    std::vector<std::size_t> order;  // those of the study first, in its order
    for (const std::string& name : facts.features) {
        const auto found = std::ranges::find(frame.features, name, &FeatureResult::name);
        if (found != frame.features.end()) {
            order.push_back(static_cast<std::size_t>(found - frame.features.begin()));
        }
    }
    const std::vector<std::size_t> used = order;
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        if (std::ranges::count(used, f) == 0) {
            order.push_back(f);
        }
    }
    for (const std::size_t f : order) {
        add(frame.features[f].name, {f}, std::ranges::count(used, f) > 0);
    }
    if (baseline > 0 && used.size() > 1) {
        add(kFused, used, true);
    }
}

// Fewest healthy recordings that set a threshold: with fewer, more than one in ten alarms.
constexpr long kFewestHealthy = 10;

// Reason why these gearboxes cannot be monitored; "" if they can.
std::string refusal_of(const std::vector<GearboxRecords>& gearboxes, int baseline, long healthy) {
    if (gearboxes.empty()) {
        return fmt::format(
            "no gearbox has more than {0} recordings of which the first {0} are without a fault",
            baseline);
    }
    return healthy >= kFewestHealthy
               ? ""
               : fmt::format(
                     "{} healthy recordings after the first {} of a gearbox are too few to set a "
                     "threshold: at least {} are needed",
                     healthy, baseline, kFewestHealthy);
}

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

// "1 of 131 [0.019 %, 4.2 %]"; "" without a threshold.
std::string held_out_text(const analysis::HeldOutAlarms& held) {
    return std::isnan(held.rate) ? ""
                                 : fmt::format("{} of {} {}", held.alarms, held.records,
                                               percent_interval(held.bounds));
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
    std::string text = fmt::format(
        fmt::runtime(
            monitoring.false_alarm_rate < smallest
                ? "{} healthy recordings cannot set a threshold with a false-alarm rate of "
                  "{}: the smallest is {}, 1 in {}, which is used instead"
                : "{} healthy recordings set thresholds with an expected false-alarm rate "
                  "of {}; the smallest that they can set is {}, 1 in {}"),
        monitoring.healthy, analysis::percent_text(monitoring.false_alarm_rate),
        analysis::percent_text(smallest), monitoring.healthy + 1);
    return text +
           ". Thresholds allow for levels that drift as those of the healthy sessions do. Healthy "
           "alarms are those of the recordings that set the "
           "threshold, so their number follows from it. Held-out alarms are of the second half of "
           "the healthy recordings, with a threshold from the first half. Recordings of one "
           "gearbox resemble each other, so the intervals are too narrow.";
}

nlohmann::json first_json(const MonitoringOverTime& monitoring,
                          const std::optional<FirstAlarm>& alarm) {
    nlohmann::json json = analysis::json_of(alarm);
    if (alarm) {
        json["recording"] = monitoring.names.at(alarm->row);
    }
    return json;
}

nlohmann::json gearbox_json(const MonitoringOverTime& monitoring, const GearboxAlarms& gearbox) {
    nlohmann::json json = analysis::fields_json(gearbox);
    json["first"] = first_json(monitoring, gearbox.first);
    json["sustained"] = first_json(monitoring, gearbox.sustained);
    if (gearbox.sustained) {
        json["sustained"]["confirmed_by"] = monitoring.names.at(*gearbox.confirmed);
    }
    return json;
}

nlohmann::json series_json(const MonitoringOverTime& monitoring, const GearboxSeries& series) {
    nlohmann::json json = analysis::fields_json(series);
    json["deviations"] = nlohmann::json::object();
    for (std::size_t f = 0; f < series.deviations.size(); ++f) {
        json["deviations"][monitoring.shown[f]] = analysis::json_of(series.deviations[f]);
    }
    json["healthy"] = std::vector<bool>(series.healthy.begin(), series.healthy.end());
    return json;
}

}  // namespace

std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame,
                                                       const RowSource& rows) {
    const auto time = frame.parameter_index("time");
    const auto facts = measuring_facts(frame.provenance_value("measured_by_study"));
    if (!time || !facts || frame.provenance_value("kind") != kRecordingsKind) {
        return std::nullopt;
    }
    const Monitoring& requested = facts->monitoring;
    const auto torque =
        requested.torque_regression ? frame.parameter_index("torque") : std::nullopt;
    MonitoringOverTime monitoring;
    monitoring.baseline_records = requested.baseline_records;
    monitoring.false_alarm_rate = frame.request.false_alarm_rate;
    monitoring.confidence = frame.request.confidence;
    // One bad recording is in as many averages as there are recordings in an average.
    analysis::SustainedRule& sustained = monitoring.sustained;
    while (sustained.needed() <= requested.average_records) {
        ++sustained.records;
    }
    monitoring.torque_regression = torque.has_value();
    monitoring.names = lines_of(frame.provenance_value("recordings"));
    const std::string& unit = frame.parameters[*time].unit;
    monitoring.time_unit = unit == "1" ? "" : unit;
    if (requested.torque_regression && !torque) {
        monitoring.refusal =
            "monitoring.torque_regression needs the torque of each recording, but the manifest "
            "has no column torque";
        return monitoring;
    }
    auto gearboxes = gearboxes_of(frame, rows, *time, torque);
    if (gearboxes.size() == 1 && gearboxes.front().name.empty()) {
        monitoring.note =
            "no recording names its gearbox (column gearbox): all are assumed to be of one machine";
    }
    std::erase_if(gearboxes, [&](const GearboxRecords& one) {
        return !one.has_baseline(static_cast<std::size_t>(requested.baseline_records));
    });
    for (const GearboxRecords& gearbox : gearboxes) {
        monitoring.healthy += std::count(gearbox.healthy.begin() + requested.baseline_records,
                                         gearbox.healthy.end(), char{1});
    }
    monitoring.refusal = refusal_of(gearboxes, requested.baseline_records, monitoring.healthy);
    if (monitoring.refusal.empty()) {
        monitor_all(frame, *facts, gearboxes, monitoring);
    }
    return monitoring;
}

analysis::Section monitoring_answer(const MonitoringOverTime& monitoring) {
    constexpr std::size_t kMost = 6;
    std::vector<std::string> sustained, others;
    const std::string* feature = nullptr;  // of the line before: each has its first detector
    for (const RecordingMonitorResult& one : monitoring.watched) {
        if (std::ranges::count(monitoring.shown, one.feature) == 0 ||
            (feature != nullptr && *feature == one.feature) || std::isnan(one.threshold.value)) {
            continue;
        }
        feature = &one.feature;
        const analysis::HeldOutAlarms& held = one.held_out;
        const std::string false_alarms =
            std::isnan(held.rate)
                ? "False alarms were not counted."
                : fmt::format(
                      "Of the second half of the healthy ones {} alarm at a threshold from the "
                      "first half, stated {}{}.",
                      held_out_text(held), analysis::percent_text(held.rate),
                      held.bounds.lower > held.rate
                          ? ": more, because the level drifts or alarms cluster"
                          : "");
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            if (gearbox.recordings > 0) {
                (gearbox.sustained ? sustained : others)
                    .push_back(fmt::format(
                        "{}{} ({}): {}; {} of the {} recordings not labelled healthy alarm. {}",
                        gearbox.name.empty() ? "" : gearbox.name + ": ", one.feature, one.detector,
                        gearbox.sustained ? "sustained alarm from " +
                                                alarm_text(monitoring, gearbox.sustained) + " on"
                                          : "no sustained alarm",
                        gearbox.alarms, gearbox.recordings, false_alarms));
            }
        }
    }
    sustained.insert(sustained.end(), others.begin(), others.end());
    if (const std::size_t all = sustained.size(); all > kMost) {
        sustained.resize(kMost);
        sustained.push_back(
            fmt::format("{} further results are in the section monitoring.", all - kMost));
    }
    analysis::Section section{"found", "", {}};
    for (std::size_t i = 0; i < sustained.size(); ++i) {
        section.state(fmt::format("found.{}", i), sustained[i], analysis::Shown::screen);
    }
    return section;
}

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
        fmt::format("{}. A recording alarms while the detector's statistic lies beyond the "
                    "threshold; ewma, cusum and trend, which accumulate, count what exceeds "
                    "the drift, and need that of the recording itself. An alarm is sustained if at "
                    "least {} of the next {} "
                    "recordings alarm, too; the lead is counted from it to the last recording. Run "
                    "length: median number of recordings up to an alarm without a fault, in 101 "
                    "series drawn from the healthy recordings.",
                    baseline_text(monitoring), monitoring.sustained.needed(),
                    monitoring.sustained.records));
    section.state("monitoring.sample", sample_text(monitoring));
    section.state("monitoring.note",
                  monitoring.note.empty() ? "" : analysis::capitalised(monitoring.note) + ".");
    analysis::Table table{
        "monitoring",
        "",
        {"feature", "detector", "sustained alarm", "later alarms", "held-out alarms", "first alarm",
         "lead", "worst tooth", "threshold", "healthy alarms", "sustained", "run length"},
        {},
        analysis::Shown::screen};
    table.labels = 2;
    for (const RecordingMonitorResult& one : monitoring.watched) {
        if (std::ranges::count(features, one.feature) +
                std::ranges::count(monitoring.shown, one.feature) ==
            0) {
            continue;
        }
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            if (gearbox.recordings == 0 || std::isnan(one.threshold.value)) {
                continue;
            }
            table.rows.push_back(
                {one.feature, one.detector,
                 (gearbox.name.empty() ? "" : gearbox.name + ": ") +
                     alarm_text(monitoring, gearbox.sustained),
                 fmt::format("{} of {}", gearbox.alarms, gearbox.recordings),
                 held_out_text(one.held_out), alarm_text(monitoring, gearbox.first),
                 lead_text(monitoring, gearbox.sustained),
                 gearbox.tooth ? fmt::format("{}, the same in {} of {}", gearbox.tooth->tooth,
                                             gearbox.tooth->same, gearbox.tooth->recordings)
                               : "",
                 analysis::number_text(one.threshold.value),
                 fmt::format("{} of {}", one.threshold.alarms, one.threshold.records),
                 std::to_string(one.healthy_sustained),
                 std::isnan(one.run_length)   ? ""
                 : std::isinf(one.run_length) ? fmt::format("> {}", longest_run(one.threshold.rate))
                                              : analysis::number_text(one.run_length)});
        }
    }
    section.add(std::move(table));
    return section;
}

nlohmann::json monitoring_json(const MonitoringOverTime& monitoring) {
    nlohmann::json json = analysis::fields_json(monitoring);
    json["smallest_rate"] = analysis::smallest_rate(monitoring.healthy);
    json["refusal"] = monitoring.refusal;
    json["watched"] = json["recordings"] = nlohmann::json::array();
    for (const RecordingMonitorResult& result : monitoring.watched) {
        nlohmann::json gearboxes = nlohmann::json::array();
        for (const GearboxAlarms& gearbox : result.gearboxes) {
            gearboxes.push_back(gearbox_json(monitoring, gearbox));
        }
        json["watched"].push_back({{"feature", result.feature},
                                   {"detector", result.detector},
                                   {"threshold", analysis::number(result.threshold.value)},
                                   {"healthy",
                                    {{"recordings", result.threshold.records},
                                     {"alarms", result.threshold.alarms},
                                     {"drift", result.threshold.drift},
                                     {"run_length", analysis::number(result.run_length)},
                                     {"sustained", result.healthy_sustained},
                                     {"rate", analysis::number(result.threshold.rate)}}},
                                   {"held_out", analysis::fields_json(result.held_out)},
                                   {"gearboxes", gearboxes}});
    }
    for (const GearboxSeries& series : monitoring.gearboxes) {
        json["recordings"].push_back(series_json(monitoring, series));
    }
    return json;
}

}  // namespace gearpod::mc
