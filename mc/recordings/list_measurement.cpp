// Measures the recordings of a list in blocks, with their baselines and averages.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "machine/team.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/recordings/measure_recordings.hpp"

namespace gearpod::mc {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

class ListMeasurement {
  public:
    ListMeasurement(const RecordingList& list, const SignalColumns& columns, const Scene& scene,
                    const HealthyReference& healthy, const RecordingComparison& comparison,
                    int threads)
        : list_(list),
          columns_(columns),
          scene_(scene),
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
                places_.push_back({g, p});
            }
        }
        std::mutex one_at_a_time;
        // Bounds the signals in memory to a block and the recordings averaged with its first.
        constexpr std::size_t kBlock = 64;
        for (std::size_t begin = 0; begin < places_.size(); begin += kBlock) {
            const std::size_t count = std::min(kBlock, places_.size() - begin);
            machine::for_each_index(count, threads_,
                                    [&](std::size_t i) { read(places_[begin + i]); });
            machine::for_each_index(count, threads_, [&](std::size_t i) {
                measure_one(places_[begin + i]);
                const std::lock_guard lock(one_at_a_time);
                done();
            });
            for (std::size_t i = 0; i < count; ++i) {
                signals_[index_of(places_[begin + i])].reset();
            }
            const auto kept = static_cast<std::size_t>(comparison_.options.average);
            for (std::size_t i = 0; i + kept < begin + count; ++i) {
                aligned_[index_of(places_[i])].reset();
            }
        }
        return std::move(measured_);
    }

  private:
    struct Place {
        std::size_t group, position;
    };
    std::size_t index_of(const Place& place) const {
        return groups_[place.group].recordings[place.position];
    }

    MeasuredSignal signal_of(std::size_t i) const {
        SignalColumns columns = columns_;
        columns.row = list_.recordings[i].row;
        return read_measured_signal(list_.recordings[i].file, columns, scene_);
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
        GroupBaseline baseline(group, list_, signals, scene_, comparison_.options.scaled,
                               measured_.notes);
        measured_.notes.push_back(
            baseline.refusal().empty()
                ? fmt::format("{}: mean of {} recordings; the least correlation of one with it is "
                              "{:.3f}",
                              group.name, baseline.members(), baseline.least_correlation())
                : baseline.refusal());
        return baseline;
    }

    const GroupBaseline* usable_baseline(const Place& place) const {
        const auto& baseline = baselines_[place.group];
        return baseline && baseline->refusal().empty() ? &*baseline : nullptr;
    }

    void read(const Place& place) {
        const std::size_t i = index_of(place);
        MeasuredRecording& measured = measured_.recordings[i];
        measured.alignment = kUnknown;
        try {
            signals_[i] = signal_of(i);
            const GroupBaseline* baseline = usable_baseline(place);
            if (comparison_.options.average > 1 && baseline != nullptr) {
                try {
                    aligned_[i] = baseline->aligned(*signals_[i], scene_);
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
    std::vector<std::size_t> average(const Place& place, MeasuredSignal& signal) const {
        const std::size_t last = place.position + 1;
        const auto most = static_cast<std::size_t>(comparison_.options.average);
        std::vector<std::size_t> used;
        std::vector<double> sum(aligned_[index_of(place)]->sensor.size(), 0.0);
        for (std::size_t p = last - std::min(last, most); p < last; ++p) {
            const std::size_t i = groups_[place.group].recordings[p];
            if (aligned_[i]) {
                used.push_back(i);
                for (std::size_t s = 0; s < sum.size(); ++s) {
                    sum[s] += aligned_[i]->sensor[s];
                }
            }
        }
        for (double& value : sum) {
            value /= static_cast<double>(used.size());
        }
        signal.sensor_meshes =
            static_cast<int>(sum.size() / static_cast<std::size_t>(scene_.samples_per_mesh()));
        signal.sensor = std::move(sum);
        return used;
    }

    void measure_one(const Place& place) {
        const std::size_t i = index_of(place);
        MeasuredRecording& measured = measured_.recordings[i];
        try {
            if (measured.problem.empty()) {
                fill(place, measured);
            }
        } catch (const std::exception& error) {
            measured.problem = exception_text(error);
        }
        std::replace(measured.problem.begin(), measured.problem.end(), '\n', ';');
    }

    void fill(const Place& place, MeasuredRecording& measured) {
        const std::size_t i = index_of(place);
        MeasuredSignal& signal = *signals_[i];
        measured.notes = signal.notes;
        std::vector<std::size_t> used{i};
        if (aligned_[i]) {
            used = average(place, signal);
        }
        measured.averaged = static_cast<int>(used.size());
        measured.sensor_meshes = signal.sensor_meshes;
        measured.planet_turns = planet_turns(signal, scene_);
        const GroupBaseline* group = usable_baseline(place);
        const auto baseline = group != nullptr ? std::optional(group->without(used)) : std::nullopt;
        Measurement all = measure(scene_, signal, healthy_, baseline ? &*baseline : nullptr);
        measured.teeth = std::move(all.teeth);
        measured.map = std::move(all.map);
        if (all.change && std::isnan(measured.alignment)) {
            measured.alignment = all.change->correlation;
        }
        // A group without a usable baseline has no values of features that compare.
        const auto columns = measurable(scene_.study(), compared_);
        measured.values.assign(columns.size(), kUnknown);
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
    const Scene& scene_;
    const HealthyReference& healthy_;
    const RecordingComparison& comparison_;
    const int threads_;
    const bool compared_;
    const std::vector<RecordingGroup> groups_;
    std::vector<std::optional<GroupBaseline>> baselines_;
    std::vector<Place> places_;
    std::vector<std::optional<MeasuredSignal>> signals_;
    std::vector<std::optional<AlignedSensor>> aligned_;
    MeasuredList measured_;
};

}  // namespace

MeasuredList measure_recordings(const RecordingList& list, const SignalColumns& columns,
                                const Scene& scene, const HealthyReference& healthy,
                                const RecordingComparison& comparison, int threads,
                                const std::function<void()>& done) {
    return ListMeasurement(list, columns, scene, healthy, comparison, threads).run(done);
}

}  // namespace gearpod::mc
