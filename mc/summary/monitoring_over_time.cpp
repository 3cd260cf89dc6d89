#include "mc/summary/monitoring_over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/monitoring/baseline_deviations.hpp"
#include "analysis/report/json_values.hpp"
#include "mc/input/wrapped_text.hpp"
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
    rows.visit([&](const RowBlock& block) {
        for (std::size_t row = 0; row < block.count(); ++row) {
            const double* of_row = block.values.data() + row * shape.values();
            columns.group.push_back(block.group[row]);
            columns.time.push_back(of_row[time]);
            if (torque) {
                columns.torque.push_back(of_row[*torque]);
            }
            for (std::size_t f = 0; f < shape.features; ++f) {
                columns.values[f].push_back(of_row[shape.value_of(f, 0)]);
            }
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

GearboxAlarms monitor_gearbox(const GearboxRecords& gearbox, const std::vector<double>& deviations,
                              const analysis::Detector& detector, double threshold) {
    GearboxAlarms watched{gearbox.name, 0, 0, {}, 0.0};
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        watched.recordings += gearbox.healthy[i] == 0 && !std::isnan(deviations[i]) ? 1 : 0;
    }
    for (const std::size_t i : analysis::detector_alarms(detector, deviations, threshold).alarms) {
        if (gearbox.healthy[i] == 0) {
            ++watched.alarms;
            if (!watched.first) {
                watched.first = gearbox.rows[i];
                watched.first_time = gearbox.time[i];
            }
        }
    }
    return watched;
}

std::optional<std::size_t> parameter_place(const Results& frame, const std::string& name) {
    for (std::size_t p = 0; p < frame.parameters.size(); ++p) {
        if (frame.parameters[p].name == name) {
            return p;
        }
    }
    return std::nullopt;
}

// Monitors every feature separately, and the study's features combined ("fused").
class RecordingMonitor {
  public:
    RecordingMonitor(const Results& frame, const Study& study,
                     const std::vector<GearboxRecords>& gearboxes)
        : frame_(frame), study_(study), gearboxes_(gearboxes) {}

    std::vector<RecordingMonitorResult> all() const {
        std::vector<RecordingMonitorResult> watched;
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
             std::vector<RecordingMonitorResult>& watched) const {
        std::vector<std::vector<double>> of_gearbox;
        std::vector<analysis::HealthyLife> lives;
        for (const GearboxRecords& gearbox : gearboxes_) {
            of_gearbox.push_back(deviations(gearbox, features));
            lives.push_back(healthy_life(gearbox, of_gearbox.back()));
        }
        for (const std::string& text : study_.monitoring.detectors) {
            const analysis::Detector detector = *analysis::parse_detector(text);
            RecordingMonitorResult one{
                name,
                text,
                monitor_threshold(detector, lives, 1000.0 * frame_.request.false_alarm_rate),
                {}};
            for (std::size_t g = 0; g < gearboxes_.size(); ++g) {
                one.gearboxes.push_back(
                    monitor_gearbox(gearboxes_[g], of_gearbox[g], detector, one.threshold.value));
            }
            watched.push_back(std::move(one));
        }
    }

    const Results& frame_;
    const Study& study_;
    const std::vector<GearboxRecords>& gearboxes_;
};

// Reason why these gearboxes cannot be monitored; "" if they can.
std::string refusal_of(const std::vector<GearboxRecords>& gearboxes, int baseline, double rate) {
    if (gearboxes.empty()) {
        return fmt::format(
            "no gearbox has more than {0} recordings of which the first {0} are without a fault",
            baseline);
    }
    long healthy = 0;
    for (const GearboxRecords& gearbox : gearboxes) {
        healthy += std::count(gearbox.healthy.begin() + baseline, gearbox.healthy.end(), char{1});
    }
    const auto needed = analysis::sample_for_threshold(rate);
    return healthy >= needed
               ? ""
               : fmt::format(
                     "{} healthy recordings after the first {} of a gearbox are too few for a "
                     "false-alarm rate of {:g}: at least {} are needed",
                     healthy, baseline, rate, needed);
}

}  // namespace

std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame,
                                                       const RowSource& rows) {
    const auto time = parameter_place(frame, "time");
    const auto study = read_study_text(frame.provenance_value("measured_by_study"), "").study;
    if (!time || !study || frame.provenance_value("kind") != kRecordingsKind) {
        return std::nullopt;
    }
    const Monitoring& requested = study->monitoring;
    const auto torque =
        requested.torque_regression ? parameter_place(frame, "torque") : std::nullopt;
    MonitoringOverTime monitoring;
    monitoring.baseline_records = requested.baseline_records;
    monitoring.false_alarm_rate = frame.request.false_alarm_rate;
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
    monitoring.refusal =
        refusal_of(gearboxes, requested.baseline_records, frame.request.false_alarm_rate);
    if (monitoring.refusal.empty()) {
        monitoring.watched = RecordingMonitor(frame, *study, gearboxes).all();
    }
    return monitoring;
}

std::string monitoring_text(const MonitoringOverTime& monitoring,
                            const std::vector<std::string>& features) {
    if (!monitoring.refusal.empty()) {
        return wrapped_text("Monitoring over time is not possible: " + monitoring.refusal, 2) +
               "\n";
    }
    std::string out =
        wrapped_text(
            monitoring.baseline_records > 0
                ? fmt::format(
                      "Monitoring over time (deviations from the first {} recordings of a "
                      "gearbox{}; thresholds: {:g} of the later healthy recordings alarm; an "
                      "alarm resets the detector)",
                      monitoring.baseline_records,
                      monitoring.torque_regression ? ", with a linear regression on the torque"
                                                   : "",
                      monitoring.false_alarm_rate)
                : fmt::format(
                      "Monitoring over time (thresholds: {:g} of the healthy recordings alarm; an "
                      "alarm resets the detector)",
                      monitoring.false_alarm_rate),
            2) +
        "\n";
    if (!monitoring.note.empty()) {
        out += wrapped_text(monitoring.note, 2) + "\n";
    }
    out += fmt::format("{:<20}{:<13}{:>9}{:>9}{:>9}  {}\n", "feature", "detector", "threshold",
                       "healthy", "others", "first alarm");
    for (const RecordingMonitorResult& one : monitoring.watched) {
        if (one.feature != kFused &&
            std::find(features.begin(), features.end(), one.feature) == features.end()) {
            continue;
        }
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            if (gearbox.recordings == 0 || std::isnan(one.threshold.value)) {
                continue;
            }
            std::string first = "none";
            if (gearbox.first) {
                const std::string& name = monitoring.names.at(*gearbox.first);
                first = fmt::format("{:g} {}, {}", gearbox.first_time, monitoring.time_unit,
                                    name.substr(name.rfind('/') + 1));
            }
            out += fmt::format("{:<20}{:<13}{:>9.3g}{:>9}{:>9}  {}{}\n", one.feature, one.detector,
                               one.threshold.value,
                               fmt::format("{}/{}", one.threshold.alarms, one.threshold.records),
                               fmt::format("{}/{}", gearbox.alarms, gearbox.recordings),
                               gearbox.name.empty() ? "" : gearbox.name + ": ", first);
        }
    }
    return out;
}

nlohmann::json monitoring_json(const MonitoringOverTime& monitoring) {
    nlohmann::json watched = nlohmann::json::array();
    for (const RecordingMonitorResult& one : monitoring.watched) {
        nlohmann::json gearboxes = nlohmann::json::array();
        for (const GearboxAlarms& gearbox : one.gearboxes) {
            nlohmann::json first = nullptr;
            if (gearbox.first) {
                first = {{"row", *gearbox.first},
                         {"time", gearbox.first_time},
                         {"recording", monitoring.names.at(*gearbox.first)}};
            }
            gearboxes.push_back({{"name", gearbox.name},
                                 {"recordings", gearbox.recordings},
                                 {"alarms", gearbox.alarms},
                                 {"first", first}});
        }
        watched.push_back(
            {{"feature", one.feature},
             {"detector", one.detector},
             {"threshold", analysis::number(one.threshold.value)},
             {"healthy", {{"recordings", one.threshold.records}, {"alarms", one.threshold.alarms}}},
             {"gearboxes", gearboxes}});
    }
    return {{"baseline_records", monitoring.baseline_records},
            {"false_alarm_rate", monitoring.false_alarm_rate},
            {"torque_regression", monitoring.torque_regression},
            {"note", monitoring.note},
            {"refusal", monitoring.refusal},
            {"watched", watched}};
}

}  // namespace gearpod::mc
