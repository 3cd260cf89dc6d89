#include "mc/report/monitoring_over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/monitoring/baseline_deviations.hpp"
#include "mc/random/philox.hpp"
#include "mc/study/study.hpp"

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
        return rows.size() > records &&
               std::none_of(faulty.begin(), faulty.begin() + static_cast<std::ptrdiff_t>(records),
                            [](char one) { return one != 0; });
    }
};

struct RecordColumns {
    std::vector<double> time, torque;
    std::vector<int> group;
    std::vector<std::vector<double>> values;
};

RecordColumns columns_of(const Results& frame, const RowSource& rows, std::size_t time,
                         const std::optional<std::size_t>& torque) {
    const RowShape shape = row_shape(frame);
    RecordColumns columns;
    columns.values.resize(shape.features);
    for_each_row(rows, [&](const ResultRow& row) {
        columns.group.push_back(row.group);
        columns.time.push_back(row.values[time]);
        if (torque) {
            columns.torque.push_back(row.values[*torque]);
        }
        for (std::size_t f = 0; f < shape.features; ++f) {
            columns.values[f].push_back(row.values[shape.value_of(f, 0)]);
        }
    });
    return columns;
}

// Groups recordings by gearbox. If no recording has a gearbox name, all belong to one gearbox;
// otherwise recordings without a name are omitted.
std::vector<GearboxRecords> gearboxes_of(const RecordColumns& columns,
                                         const std::vector<std::string>& names) {
    std::map<std::string, std::vector<std::size_t>> rows_of;
    for (std::size_t row = 0; row < columns.time.size(); ++row) {
        rows_of[row < names.size() ? names[row] : ""].push_back(row);
    }
    if (rows_of.size() > 1) {
        rows_of.erase("");
    }
    std::vector<GearboxRecords> gearboxes;
    for (auto& [name, rows] : rows_of) {
        std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
            return columns.time[a] < columns.time[b];
        });
        GearboxRecords one{name, rows, {}, {}, {}, {}, {}};
        const auto in_order = [&](const std::vector<double>& all) {
            std::vector<double> values;
            for (const std::size_t row : all.empty() ? std::vector<std::size_t>() : one.rows) {
                values.push_back(all[row]);
            }
            return values;
        };
        for (const std::size_t row : rows) {
            one.healthy.push_back(columns.group[row] == static_cast<int>(Group::threshold));
            one.faulty.push_back(columns.group[row] == static_cast<int>(Group::graded));
        }
        one.time = in_order(columns.time);
        one.torque = in_order(columns.torque);
        for (const std::vector<double>& feature : columns.values) {
            one.values.push_back(in_order(feature));
        }
        gearboxes.push_back(std::move(one));
    }
    return gearboxes;
}

// Healthy recordings after the baseline, as a life in which each recording counts as one hour.
analysis::HealthyLife healthy_life(const GearboxRecords& gearbox,
                                   const std::vector<double>& deviations) {
    analysis::HealthyLife life;
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        if (gearbox.healthy[i] != 0 && !std::isnan(deviations[i])) {
            life.values.push_back(deviations[i]);
            life.hours += 1.0;
        }
    }
    return life;
}

FirstAlarm first_alarm(const GearboxRecords& gearbox, std::size_t i) {
    return {gearbox.rows[i], gearbox.time[i], static_cast<long>(gearbox.rows.size() - 1 - i),
            gearbox.time.back() - gearbox.time[i]};
}

// Worst tooth of a recording in mesh periods from the baseline's start; NaN if unknown.
double worst_position(const GearboxSeries& series, std::size_t i) {
    if (series.teeth.empty() || series.teeth[i].empty()) {
        return analysis::kNan;
    }
    const auto& rms = series.teeth[i];
    return series.first_tooth[i] +
           static_cast<double>(std::max_element(rms.begin(), rms.end()) - rms.begin());
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
                              const analysis::Detector& detector, double threshold,
                              const analysis::SustainedRule& rule, long& healthy_sustained) {
    GearboxAlarms watched{gearbox.name, 0, 0, {}, {}, {}, {}};
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        watched.recordings += gearbox.healthy[i] == 0 && !std::isnan(deviations[i]) ? 1 : 0;
    }
    for (const std::size_t i : analysis::detector_alarms(detector, deviations, threshold).alarms) {
        if (gearbox.healthy[i] == 0) {
            ++watched.alarms;
            if (!watched.first) {
                watched.first = first_alarm(gearbox, i);
            }
        }
    }
    const auto alarms = analysis::record_alarms(detector, deviations, threshold);
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

// Alignments and tooth maps of the recordings as features stores them, and the drift of the level.
GearboxSeries series_of(const Results& frame, const GearboxRecords& gearbox) {
    GearboxSeries series{
        gearbox.name, gearbox.rows, gearbox.time, gearbox.healthy, {}, {}, {}, {}, {}};
    const auto alignments = lines_of(frame.provenance_value("recorded_alignments"));
    const auto maps = lines_of(frame.provenance_value("recorded_teeth"));
    for (const std::size_t row : gearbox.rows) {
        if (row < alignments.size() && row < maps.size()) {
            series.alignment.push_back(std::strtod(alignments[row].c_str(), nullptr));
            const std::vector<double> map = numbers_of(maps[row]);
            series.first_tooth.push_back(map.empty() ? analysis::kNan : map.front());
            series.teeth.emplace_back(map.begin() + (map.empty() ? 0 : 1), map.end());
        }
    }
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        if (frame.features[f].name == "sensor_rms") {
            std::vector<double> levels;
            for (std::size_t i = 0; i < gearbox.rows.size(); ++i) {
                if (gearbox.healthy[i] != 0 && std::isfinite(gearbox.values[f][i])) {
                    levels.push_back(gearbox.values[f][i]);
                }
            }
            series.level = analysis::drift_of(levels);
        }
    }
    return series;
}

// Monitors every feature separately, and the study's features combined ("fused").
class RecordingMonitor {
  public:
    RecordingMonitor(const Results& frame, const Study& study,
                     const std::vector<GearboxRecords>& gearboxes, MonitoringOverTime& monitoring)
        : frame_(frame), study_(study), gearboxes_(gearboxes), monitoring_(monitoring) {}

    std::vector<RecordingMonitorResult> all() {
        std::vector<RecordingMonitorResult> watched;
        for (const GearboxRecords& gearbox : gearboxes_) {
            monitoring_.gearboxes.push_back(series_of(frame_, gearbox));
        }
        for (std::size_t f = 0; f < frame_.features.size(); ++f) {
            add(frame_.features[f].name, {f}, watched);
        }
        std::vector<std::size_t> used;
        for (std::size_t f = 0; f < frame_.features.size(); ++f) {
            const auto& use = study_.features.use;
            if (std::find(use.begin(), use.end(), frame_.features[f].name) != use.end()) {
                used.push_back(f);
            }
        }
        if (baseline() > 0 && used.size() > 1) {
            add(kFused, used, watched);
        }
        return watched;
    }

  private:
    std::size_t baseline() const {
        return static_cast<std::size_t>(study_.monitoring.baseline_records);
    }

    std::vector<double> deviations(const GearboxRecords& gearbox,
                                   const std::vector<std::size_t>& features) const {
        if (features.size() == 1) {
            return analysis::baseline_deviations(gearbox.values[features[0]], gearbox.torque,
                                                 baseline(), frame_.features[features[0]].alarm);
        }
        std::vector<std::vector<double>> values;
        std::vector<analysis::Alarm> alarms;
        for (const std::size_t f : features) {
            values.push_back(gearbox.values[f]);
            alarms.push_back(frame_.features[f].alarm);
        }
        return analysis::fused_deviations(values, gearbox.torque, baseline(), alarms);
    }

    void add(const std::string& name, const std::vector<std::size_t>& features,
             std::vector<RecordingMonitorResult>& watched) {
        std::vector<std::vector<double>> of_gearbox;
        std::vector<analysis::HealthyLife> lives;
        for (const GearboxRecords& gearbox : gearboxes_) {
            of_gearbox.push_back(deviations(gearbox, features));
            lives.push_back(healthy_life(gearbox, of_gearbox.back()));
        }
        const auto& use = study_.features.use;
        if (name == kFused || std::find(use.begin(), use.end(), name) != use.end()) {
            monitoring_.shown.push_back(name);
            for (std::size_t g = 0; g < gearboxes_.size(); ++g) {
                monitoring_.gearboxes[g].deviations.push_back(of_gearbox[g]);
            }
        }
        long records = 0;
        for (const analysis::HealthyLife& life : lives) {
            records += static_cast<long>(life.values.size());
        }
        const double stated = frame_.request.false_alarm_rate;
        const double rate = std::max(stated, analysis::smallest_rate(records));
        const double confidence = frame_.request.confidence;
        for (const std::string& text : study_.monitoring.detectors) {
            const analysis::Detector detector = *analysis::parse_detector(text);
            RecordingMonitorResult one{name,
                                       text,
                                       monitor_threshold(detector, lives, 1000.0 * rate),
                                       rate,
                                       analysis::threshold_rate_interval(records, rate, confidence),
                                       0,
                                       held_out_alarms(detector, lives, stated, confidence),
                                       {}};
            for (std::size_t g = 0; g < gearboxes_.size(); ++g) {
                one.gearboxes.push_back(monitor_gearbox(
                    gearboxes_[g], monitoring_.gearboxes[g], of_gearbox[g], detector,
                    one.threshold.value, monitoring_.sustained, one.healthy_sustained));
            }
            watched.push_back(std::move(one));
        }
    }

    const Results& frame_;
    const Study& study_;
    const std::vector<GearboxRecords>& gearboxes_;
    MonitoringOverTime& monitoring_;
};

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

}  // namespace

std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame,
                                                       const RowSource& rows) {
    const auto time = frame.parameter_index("time");
    const auto study = read_study_text(frame.provenance_value("measured_by_study"), "").study;
    if (!time || !study || frame.provenance_value("kind") != kRecordingsKind) {
        return std::nullopt;
    }
    const Monitoring& requested = study->monitoring;
    const auto torque =
        requested.torque_regression ? frame.parameter_index("torque") : std::nullopt;
    MonitoringOverTime monitoring;
    monitoring.baseline_records = requested.baseline_records;
    monitoring.false_alarm_rate = frame.request.false_alarm_rate;
    monitoring.confidence = frame.request.confidence;
    monitoring.sustained = {requested.sustained_records, requested.sustained_share};
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
    auto gearboxes = gearboxes_of(columns_of(frame, rows, *time, torque),
                                  lines_of(frame.provenance_value("recorded_gearboxes")));
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
        monitoring.watched = RecordingMonitor(frame, *study, gearboxes, monitoring).all();
    }
    return monitoring;
}

}  // namespace gearpod::mc
