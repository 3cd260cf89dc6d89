// Measures the recordings of a list in blocks, with their baselines and averages.
#include "mc/recordings/measure_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "machine/no_value.hpp"
#include "machine/team.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/sha256.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

class ListMeasurement {
  public:
    ListMeasurement(const RecordingList& list, const SignalColumns& columns,
                    const MeasurementPlan& plan, const HealthyReference& healthy,
                    const RecordingComparison& comparison, int threads)
        : list_(list),
          columns_(columns),
          plan_(plan),
          healthy_(healthy),
          comparison_(comparison),
          threads_(threads),
          compared_(comparison.any(list)),
          groups_(recording_groups(comparison.options, list)),
          signals_(list.recordings.size()),
          aligned_(list.recordings.size()) {
        measured_.recordings.resize(list.recordings.size());
    }

    MeasuredList run(const std::function<void()>& done) {
        for (const RecordingGroup& group : groups_) {
            baselines_.push_back(baseline_of(group));
        }
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            for (std::size_t p = 0; p < groups_[g].recordings.size(); ++p) {
                positions_.push_back({g, p});
            }
        }
        std::mutex reporting;
        // Bounds the signals in memory to a block and the recordings averaged with its first.
        constexpr std::size_t kBlock = 64;
        for (std::size_t begin = 0; begin < positions_.size(); begin += kBlock) {
            const std::size_t count = std::min(kBlock, positions_.size() - begin);
            machine::for_each_index(count, threads_,
                                    [&](std::size_t i) { read(positions_[begin + i]); });
            machine::for_each_index(count, threads_, [&](std::size_t i) {
                measure_one(positions_[begin + i]);
                const std::lock_guard lock(reporting);
                done();
            });
            for (std::size_t i = 0; i < count; ++i) {
                signals_[index_of(positions_[begin + i])].reset();
            }
            const auto kept = static_cast<std::size_t>(comparison_.options.average);
            for (std::size_t i = 0; i + kept < begin + count; ++i) {
                aligned_[index_of(positions_[i])].reset();
            }
        }
        return std::move(measured_);
    }

  private:
    struct Position {
        std::size_t group, number;  // of the recording in the group
    };
    std::size_t index_of(const Position& position) const {
        return groups_[position.group].recordings[position.number];
    }

    MeasuredSignal signal_of(std::size_t i) const {
        SignalColumns columns = columns_;
        columns.row = list_.recordings[i].row;
        return read_measured_signal(list_.recordings[i].file, columns, plan_);
    }

    // Empty if nothing is compared. Adds a note on the baseline.
    std::optional<GroupBaseline> baseline_of(const RecordingGroup& group) {
        if (!compared_) {
            return std::nullopt;
        }
        if (comparison_.given != nullptr) {
            MeasuredBaseline given = *comparison_.given;
            given.scaled = comparison_.options.scaled;
            return GroupBaseline(std::move(given));
        }
        std::vector<MeasuredSignal> signals(group.chosen.size());
        machine::for_each_index(signals.size(), threads_, [&](std::size_t k) {
            try {
                signals[k] = signal_of(group.chosen[k]);
            } catch (const std::exception&) {
                signals[k] = {};  // reported when the recording itself is measured
            }
        });
        GroupBaseline baseline(group, list_, signals, plan_.record, comparison_.options.scaled,
                               measured_.notes);
        measured_.notes.push_back(
            baseline.refusal().empty()
                ? fmt::format("{}: mean of {} recordings; the least correlation of one with it is "
                              "{:.3f}",
                              group.name, baseline.members(), baseline.least_correlation())
                : baseline.refusal());
        return baseline;
    }

    const GroupBaseline* usable_baseline(const Position& position) const {
        const auto& baseline = baselines_[position.group];
        return baseline && baseline->refusal().empty() ? &*baseline : nullptr;
    }

    void read(const Position& position) {
        const std::size_t i = index_of(position);
        MeasuredRecording& measured = measured_.recordings[i];
        measured.alignment = kNan;
        try {
            signals_[i] = signal_of(i);
            const GroupBaseline* baseline = usable_baseline(position);
            if (comparison_.options.average > 1 && baseline != nullptr) {
                try {
                    aligned_[i] = baseline->aligned(*signals_[i], plan_.record);
                } catch (const SignalError& error) {
                    throw SignalError(
                        fmt::format("{}: {}", list_.recordings[i].name(), error.what()));
                }
                measured.alignment = aligned_[i]->correlation;
            }
        } catch (const std::exception& error) {
            measured.problem = exception_text(error);
        }
    }

    // Replaces the signal by the mean of the last aligned recordings. Returns their indices.
    std::vector<std::size_t> average(const Position& position, MeasuredSignal& signal) const {
        const std::size_t last = position.number + 1;
        const auto most = static_cast<std::size_t>(comparison_.options.average);
        std::vector<std::size_t> used;
        std::vector<std::span<const double>> signals;
        for (std::size_t p = last - std::min(last, most); p < last; ++p) {
            const std::size_t i = groups_[position.group].recordings[p];
            if (aligned_[i]) {
                used.push_back(i);
                signals.push_back(aligned_[i]->sensor);
            }
        }
        signal.sensor = mean_signal(signals);
        signal.sensor_meshes =
            static_cast<int>(signal.sensor.size() / static_cast<std::size_t>(plan_.record.samples));
        return used;
    }

    void measure_one(const Position& position) {
        const std::size_t i = index_of(position);
        MeasuredRecording& measured = measured_.recordings[i];
        try {
            if (measured.problem.empty()) {
                fill(position, measured);
            }
        } catch (const std::exception& error) {
            measured.problem = exception_text(error);
        }
        std::replace(measured.problem.begin(), measured.problem.end(), '\n', ';');
    }

    void fill(const Position& position, MeasuredRecording& measured) {
        const std::size_t i = index_of(position);
        MeasuredSignal& signal = *signals_[i];
        measured.notes = signal.notes;
        std::vector<std::size_t> used{i};
        if (aligned_[i]) {
            used = average(position, signal);
        }
        measured.averaged = static_cast<int>(used.size());
        measured.sensor_meshes = signal.sensor_meshes;
        measured.planet_turns = signal.planet_turns(plan_.record.span);
        const GroupBaseline* group = usable_baseline(position);
        const auto baseline = group != nullptr ? std::optional(group->without(used)) : std::nullopt;
        Measurement all = measure(plan_, signal, healthy_, baseline ? &*baseline : nullptr);
        measured.teeth = std::move(all.teeth);
        measured.map = std::move(all.map);
        if (all.change && std::isnan(measured.alignment)) {
            measured.alignment = all.change->correlation;
        }
        // A group without a usable baseline has no values of features that compare.
        const auto columns = measurable(plan_.features, compared_);
        measured.values.assign(columns.size(), kNan);
        std::string why;
        bool any = false;
        for (const MeasuredFeature& feature : all.features) {
            if (feature.missing.empty()) {
                const auto column = std::ranges::find(columns, feature.feature);
                measured.values[static_cast<std::size_t>(column - columns.begin())] = feature.value;
                any = true;
                continue;
            }
            const bool there = feature.feature->from_sensor ? signal.has_sensor : signal.has_te;
            why = why.empty() && there ? feature.missing : why;
            if (feature.feature->external && there) {
                measured.notes.push_back(
                    fmt::format("{}: {}", feature.feature->name, feature.missing));
            }
        }
        if (!any) {
            measured.problem =
                fmt::format("{}: no feature can be computed: {}", list_.recordings[i].name(), why);
        }
    }

    const RecordingList& list_;
    const SignalColumns& columns_;
    const MeasurementPlan& plan_;
    const HealthyReference& healthy_;
    const RecordingComparison& comparison_;
    const int threads_;
    const bool compared_;
    const std::vector<RecordingGroup> groups_;
    std::vector<std::optional<GroupBaseline>> baselines_;
    std::vector<Position> positions_;
    std::vector<std::optional<MeasuredSignal>> signals_;
    std::vector<std::optional<AlignedSensor>> aligned_;
    MeasuredList measured_;
};

}  // namespace

MeasuredList measure_recordings(const RecordingList& list, const SignalColumns& columns,
                                const MeasurementPlan& plan, const HealthyReference& healthy,
                                const RecordingComparison& comparison, int threads,
                                const std::function<void()>& done) {
    return ListMeasurement(list, columns, plan, healthy, comparison, threads).run(done);
}

namespace {

// Quotes a field that contains any common separator.
std::string quoted_field(const std::string& text) {
    return csv_field(text, ",;\t");
}

std::string header_of(const TableColumn& column) {
    return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

const char* label_of(Condition condition) {
    return condition == Condition::healthy  ? "healthy"
           : condition == Condition::faulty ? "faulty"
                                            : "";
}

std::string field_text(double value) {
    return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}

double shown_size(const RecordingList& list, double size) {
    return list.size->unit == "mm" ? 1e3 * size : size;
}

bool any_value(const std::vector<MeasuredRecording>& measured, std::size_t feature) {
    return std::any_of(measured.begin(), measured.end(), [&](const MeasuredRecording& recording) {
        return recording.problem.empty() && std::isfinite(recording.values[feature]);
    });
}

std::string unit_or_one(const TableColumn& column) {
    return column.unit.empty() ? "1" : column.unit;
}

// Size of the fault of each row: the fault size, or the label.
struct Grading {
    std::string name, unit;
    bool sized;

    // Faulty rows without a size are not evaluated if other rows have one.
    int group(const Recording& recording) const {
        if (recording.condition == Condition::healthy) {
            return static_cast<int>(Group::threshold);
        }
        const bool known =
            recording.condition == Condition::faulty && (!sized || recording.size.has_value());
        return known ? static_cast<int>(Group::test) : kNoGroup;
    }
    double size(const Recording& recording) const {
        return sized ? recording.size.value_or(0.0)
                     : (recording.condition == Condition::faulty ? 1.0 : 0.0);
    }
};

Grading grading_of(const RecordingList& list) {
    const bool sized =
        std::any_of(list.recordings.begin(), list.recordings.end(),
                    [](const Recording& recording) { return recording.size.value_or(0.0) > 0.0; });
    if (!sized) {
        return {"label", "1", false};
    }
    return {"size", list.size->unit == "mm" ? "m" : unit_or_one(*list.size), true};
}

// Hashes of the files of the recordings, a line each (kRecordedFiles).
std::string file_hashes(const RecordingList& list) {
    std::set<std::string> files;
    for (const Recording& recording : list.recordings) {
        files.insert(recording.file);
    }
    std::string lines;
    for (const std::string& file : files) {
        const std::string hash = file_sha256(file);
        lines += fmt::format("{}  {}\n", hash.empty() ? "unread" : hash, file);
    }
    return lines;
}

// Returns one group for each size, or twenty groups with about equal numbers of sizes.
std::vector<analysis::SizeGroup> groups_of(const std::set<double>& sizes) {
    constexpr std::size_t kMost = 20;
    std::vector<analysis::SizeGroup> groups;
    const std::vector<double> all(sizes.begin(), sizes.end());
    const std::size_t parts = std::min(all.size(), kMost);
    for (std::size_t i = 0; i < parts; ++i) {
        const double high = all[(i + 1) * all.size() / parts - 1];
        groups.push_back({all.size() <= kMost ? high : i == 0 ? 0.0 : groups.back().high, high});
    }
    return groups;
}

}  // namespace

void print_notes(const RecordingList& list, const std::vector<MeasuredRecording>& measured) {
    std::vector<std::pair<std::string, std::size_t>> notes;  // in order, with the first recording
    std::map<std::string, int> times;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        for (const std::string& note : measured[i].notes) {
            if (times[note]++ == 0) {
                notes.emplace_back(note, i);
            }
        }
    }
    for (const auto& [note, first] : notes) {
        const int more = times[note] - 1;
        const std::string rest = more > 0 ? fmt::format(" and {} more", more) : "";
        fmt::print(stderr, "{}\n",
                   wrapped_text(fmt::format("note: {}{}: {}",
                                            printable(list.recordings[first].name()), rest, note),
                                2));
    }
}

Problems condition_name_problems(const std::string& manifest, const RecordingList& list) {
    Problems problems;
    for (const TableColumn& column : list.inputs) {
        const std::string& name = column.name;
        const bool reserved = name.empty() || name == "." || name == "group" ||
                              name == kNoiseWeight || name.find('/') != std::string::npos;
        if (reserved) {
            problems.push_back(
                {manifest, 0, printable(name),
                 "the name of this column cannot be stored in a results file (a slash, a point, "
                 "group, noise_weight or no name)",
                 "rename the column; a unit stands in brackets after the name, as load [N/m]"});
        }
    }
    return problems;
}

std::string recordings_csv(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature* const> features, bool compared) {
    std::string out = "file,row,gearbox,label";
    for (const auto& column : {list.time, list.size}) {
        out += column ? "," + quoted_field(header_of(*column)) : "";
    }
    for (const TableColumn& column : list.inputs) {
        out += "," + quoted_field(header_of(column));
    }
    for (const features::Feature* feature : features) {
        out += feature->unit == "1" ? fmt::format(",{}", feature->name)
                                    : fmt::format(",{} [{}]", feature->name, feature->unit);
    }
    out += compared ? ",planet_turns,alignment,averaged,worst_tooth,problem\n"
                    : ",planet_turns,problem\n";
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Recording& recording = list.recordings[i];
        out += fmt::format("{},{},{},{}", quoted_field(recording.file),
                           recording.row ? std::to_string(*recording.row) : "",
                           quoted_field(recording.gearbox), label_of(recording.condition));
        out += list.time ? "," + field_text(recording.time) : "";
        out += list.size ? "," + (recording.size ? field_text(shown_size(list, *recording.size))
                                                 : std::string())
                         : "";
        for (const double input : recording.inputs) {
            out += "," + field_text(input);
        }
        for (std::size_t f = 0; f < features.size(); ++f) {
            out += "," +
                   (measured[i].values.empty() ? std::string() : field_text(measured[i].values[f]));
        }
        out += fmt::format(",{}", measured[i].planet_turns);
        if (compared) {
            out += fmt::format(",{},{},{}", field_text(measured[i].alignment), measured[i].averaged,
                               field_text(measured[i].map.worst()));
        }
        out += "," + quoted_field(measured[i].problem) + "\n";
    }
    return out;
}

Results recordings_results(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature* const> features, bool compared,
                           const EnsemblePlan& plan, int threads) {
    const Grading grading = grading_of(list);
    Results results;
    results.noise_levels = {1.0};
    for (const TableColumn& column : list.inputs) {
        results.parameters.push_back({column.name, unit_or_one(column), {}});
    }
    if (list.time) {
        results.parameters.push_back({"time", unit_or_one(*list.time), {}});
    }
    results.parameters.push_back({grading.name, grading.unit, {}});
    std::vector<std::size_t> used;
    for (std::size_t f = 0; f < features.size(); ++f) {
        const features::Feature& feature = *features[f];
        if (any_value(measured, f)) {
            used.push_back(f);
            results.features.push_back(
                {std::string(feature.name), std::string(feature.unit), feature.alarm, {}});
        }
    }
    std::string names, gearboxes, alignments, maps;
    std::set<double> sizes;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Recording& recording = list.recordings[i];
        if (!measured[i].problem.empty()) {
            continue;
        }
        results.group.push_back(grading.group(recording));
        results.status.push_back(static_cast<int>(Status::ok));
        auto parameter = results.parameters.begin();
        for (const double input : recording.inputs) {
            (parameter++)->values.push_back(input);
        }
        if (list.time) {
            (parameter++)->values.push_back(recording.time);
        }
        const double size = grading.size(recording);
        parameter->values.push_back(size);
        if (results.group.back() == static_cast<int>(Group::test)) {
            sizes.insert(size);
        }
        for (std::size_t f = 0; f < used.size(); ++f) {
            results.features[f].values.push_back(measured[i].values[used[f]]);
        }
        names += recording.name() + "\n";
        gearboxes += recording.gearbox + "\n";
        alignments += fmt::format("{:.4f}\n", measured[i].alignment);
        maps += fmt::format("{:.3f}", measured[i].map.first);
        for (const double rms : measured[i].map.rms) {
            maps += fmt::format(",{:.4g}", rms);
        }
        maps += "\n";
    }
    results.request = {plan.request.false_alarm_rate,
                       plan.request.confidence,
                       results.noise_levels,
                       groups_of(sizes),
                       {grading.name, grading.unit}};
    for (const auto& [name, value] : provenance(plan, 1, threads)) {
        // The study only defines how the recordings were evaluated; it did not create them.
        results.provenance.emplace_back(name == "study" ? "measured_by_study" : name, value);
    }
    results.provenance.emplace_back("kind", kRecordingsKind);
    results.provenance.emplace_back("recordings", names);
    results.provenance.emplace_back(kRecordedFiles, file_hashes(list));
    results.provenance.emplace_back("recorded_gearboxes", gearboxes);
    if (compared) {
        results.provenance.emplace_back("recorded_alignments", alignments);
        results.provenance.emplace_back("recorded_teeth", maps);
    }
    results.detection = detect_all(results, ColumnRows(results));
    return results;
}

}  // namespace gearpod::mc
