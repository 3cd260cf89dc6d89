#include "mc/recordings/recording_baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "features/statistics/signal_statistics.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

bool marked(const RecordingList& list) {
    return std::ranges::any_of(list.recordings, &Recording::in_baseline);
}

// Largest number of recordings that are tried as the first reference.
constexpr std::size_t kCandidates = 5;

// The candidate with the largest median correlation with all recordings, which are aligned to it.
std::vector<AlignedSensor> aligned_with_best(const std::vector<std::span<const double>>& all,
                                             int turns, const signals::SpanLayout& span) {
    std::vector<AlignedSensor> best;
    double best_median = -2.0;
    const std::size_t candidates = std::min(kCandidates, all.size());
    for (std::size_t c = 0; c < candidates; ++c) {
        const std::size_t reference = c * all.size() / candidates;
        std::vector<AlignedSensor> found;
        std::vector<double> correlations;
        for (std::size_t i = 0; i < all.size(); ++i) {
            found.push_back(aligned_with(all[reference], all[i], turns, span));
            if (i != reference) {
                correlations.push_back(found.back().correlation);
            }
        }
        if (const double median = features::median(correlations); median > best_median) {
            best_median = median;
            best = std::move(found);
        }
    }
    return best;
}

// True for recordings that resemble the mean.
std::vector<char> resembling(const std::vector<AlignedSensor>& all) {
    std::vector<double> correlations;
    for (const AlignedSensor& aligned : all) {
        correlations.push_back(aligned.correlation);
    }
    const double least = std::max(kLeastCorrelation, 0.5 * features::median(correlations));
    std::vector<char> used;
    for (const double correlation : correlations) {
        used.push_back(correlation >= least ? 1 : 0);
    }
    return used;
}

}  // namespace

std::vector<double> mean_signal(const std::vector<std::span<const double>>& signals) {
    std::vector<double> mean(signals.front().size(), 0.0);
    for (const std::span<const double> signal : signals) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += signal[i];
        }
    }
    for (double& value : mean) {
        value /= static_cast<double>(signals.size());
    }
    return mean;
}

bool BaselineOptions::any(const RecordingList& list) const {
    return records > 0 || average > 1 || scaled || marked(list);
}

Problems baseline_problems(const BaselineOptions& options, const RecordingList& list,
                           const std::string& manifest, bool has_baseline_file) {
    Problems problems;
    const auto reject = [&](const std::string& what, const std::string& remedy) {
        problems.push_back({"features", 0, "", what, remedy});
    };
    const bool mean = options.records > 0 || marked(list);
    if (mean && has_baseline_file) {
        reject(options.records > 0
                   ? "--baseline and --baseline-records are both given"
                   : "--baseline is given, and " + printable(manifest) + " has a column baseline",
               "give one baseline");
    }
    if (options.records == 1) {
        reject("--baseline-records 1: a mean has at least two recordings",
               "give 2 or more, or one recording by --baseline");
    }
    if (!mean && !has_baseline_file && options.average > 1) {
        reject(fmt::format("{} consecutive recordings are to be averaged "
                           "(monitoring.average_records, --average), but no baseline is given to "
                           "align them with",
                           options.average),
               "give --baseline-records N, a column baseline in the manifest, or --baseline");
    }
    if (!mean && !has_baseline_file && options.scaled) {
        reject("--baseline-scale fit is given without a baseline", "give --baseline-records N");
    }
    if (!mean && !options.conditions.empty()) {
        reject("--baseline-by is given without a mean baseline", "give --baseline-records N");
    }
    for (const std::string& name : options.conditions) {
        if (std::ranges::count(list.inputs, name, &TableColumn::name) == 0) {
            reject(fmt::format("--baseline-by {}: the manifest has no such operating condition",
                               printable(name)),
                   "name one of its other columns than file, row, gearbox, time, label, size");
        }
    }
    return problems;
}

std::vector<RecordingGroup> recording_groups(const BaselineOptions& options,
                                             const RecordingList& list) {
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < list.inputs.size(); ++c) {
        if (std::ranges::count(options.conditions, list.inputs[c].name) > 0) {
            columns.push_back(c);
        }
    }
    std::map<std::pair<std::string, std::vector<double>>, RecordingGroup> groups;
    for (std::size_t i = 0; i < list.recordings.size(); ++i) {
        const Recording& recording = list.recordings[i];
        std::vector<double> values;
        for (const std::size_t c : columns) {
            values.push_back(recording.inputs[c]);
        }
        RecordingGroup& group = groups[{recording.gearbox, values}];
        group.name = recording.gearbox.empty()
                         ? "baseline"
                         : fmt::format("baseline of gearbox {}", recording.gearbox);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            group.name += fmt::format("{} {} {:g}", k == 0 ? " at" : ",",
                                      list.inputs[columns[k]].name, values[k]);
        }
        group.recordings.push_back(i);
    }
    const bool by_mark = marked(list);
    std::vector<RecordingGroup> result;
    for (auto& [key, group] : groups) {
        if (list.time) {
            std::ranges::stable_sort(group.recordings, {},
                                     [&](std::size_t i) { return list.recordings[i].time; });
        }
        for (const std::size_t i : group.recordings) {
            const Recording& recording = list.recordings[i];
            const bool first = recording.condition == Condition::healthy &&
                               group.chosen.size() < static_cast<std::size_t>(options.records);
            if (by_mark ? recording.in_baseline : first) {
                group.chosen.push_back(i);
            }
        }
        result.push_back(std::move(group));
    }
    return result;
}

GroupBaseline::GroupBaseline(MeasuredBaseline given) : mean_(std::move(given)) {}

GroupBaseline::GroupBaseline(const RecordingGroup& group, const RecordingList& list,
                             const std::vector<MeasuredSignal>& signals, const RecordPlan& plan,
                             bool scaled, std::vector<std::string>& notes)
    : mean_{group.name, {}, scaled} {
    int turns = plan.span.ring_teeth;
    std::vector<std::size_t> readable;
    for (std::size_t k = 0; k < signals.size(); ++k) {
        if (const int has = signals[k].planet_turns(plan.span); has > 0) {
            readable.push_back(k);
            turns = std::min(turns, has);
        }
    }
    const auto refuse = [&](std::size_t remaining) {
        refusal_ = fmt::format(
            "{}: {} usable recordings of {} chosen (healthy ones, or marked in the column "
            "baseline), but at least 2 are needed",
            group.name, remaining, group.chosen.size());
    };
    if (readable.size() < 2) {
        refuse(readable.size());
        return;
    }
    const std::size_t samples = static_cast<std::size_t>(turns) * plan.turn_samples();
    std::vector<std::span<const double>> records;
    for (const std::size_t k : readable) {
        records.push_back(std::span(signals[k].sensor).first(samples));
    }
    std::vector<AlignedSensor> aligned = aligned_with_best(records, turns, plan.span);
    std::vector<char> used = resembling(aligned);
    for (int round = 0; round < 2; ++round) {
        if (std::ranges::count(used, 1) < 2) {
            refuse(static_cast<std::size_t>(std::ranges::count(used, 1)));
            return;
        }
        std::vector<std::span<const double>> similar;
        for (std::size_t i = 0; i < aligned.size(); ++i) {
            if (used[i] != 0) {
                similar.push_back(aligned[i].sensor);
            }
        }
        const std::vector<double> mean = mean_signal(similar);
        for (std::size_t i = 0; i < records.size(); ++i) {
            aligned[i] = aligned_with(mean, records[i], turns, plan.span);
        }
        used = resembling(aligned);
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
        const std::size_t recording = group.chosen[readable[i]];
        if (used[i] == 0) {
            notes.push_back(fmt::format(
                "{}: left out of the {}: correlation {:.2f} with the mean of the others",
                list.recordings[recording].name(), group.name, aligned[i].correlation));
            continue;
        }
        least_correlation_ = std::min(least_correlation_, aligned[i].correlation);
        members_.push_back(
            {recording, std::move(aligned[i].sensor), signals[readable[i]].sensor_rounding});
    }
    if (members_.size() < 2) {
        refuse(members_.size());
        return;
    }
    mean_.signal.has_sensor = true;
    mean_.signal.sensor_meshes = turns * plan.span.planet_teeth;
    mean_ = without({});
}

MeasuredBaseline GroupBaseline::without(std::span<const std::size_t> recordings) const {
    if (members_.empty()) {
        return mean_;
    }
    MeasuredBaseline baseline{mean_.file, mean_.signal, mean_.scaled};
    std::vector<std::span<const double>> others;
    for (const Member& member : members_) {
        if (std::ranges::find(recordings, member.recording) == recordings.end()) {
            others.push_back(member.sensor);
            baseline.signal.sensor_rounding =
                std::max(baseline.signal.sensor_rounding, member.rounding);
        }
    }
    if (others.empty()) {
        throw SignalError(fmt::format(
            "{}: the recordings averaged are all that it has, so none is left to compare with: "
            "raise --baseline-records, or lower --average",
            mean_.file));
    }
    baseline.signal.sensor = mean_signal(others);
    return baseline;
}

AlignedSensor GroupBaseline::aligned(const MeasuredSignal& record, const RecordPlan& plan) const {
    const int teeth = plan.span.planet_teeth;
    const int turns = std::min(mean_.signal.sensor_meshes / teeth, plan.span.ring_teeth);
    if (!record.has_sensor || record.sensor_meshes < turns * teeth) {
        throw SignalError(fmt::format("{} mesh periods of sensor signal, but the {} has {}",
                                      record.sensor_meshes, mean_.file, turns * teeth));
    }
    const std::size_t samples = static_cast<std::size_t>(turns) * plan.turn_samples();
    AlignedSensor found = aligned_with(std::span(mean_.signal.sensor).first(samples),
                                       std::span(record.sensor).first(samples), turns, plan.span);
    if (!(found.correlation >= kLeastCorrelation)) {
        throw SignalError(fmt::format("does not resemble the {} (correlation {:.2f})", mean_.file,
                                      found.correlation));
    }
    return found;
}

}  // namespace gearpod::mc
