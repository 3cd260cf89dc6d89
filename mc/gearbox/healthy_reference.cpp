#include "mc/gearbox/healthy_reference.hpp"

#include <algorithm>

#include "machine/cancellation.hpp"
#include "mc/gearbox/realization_signals.hpp"
#include "mc/gearbox/record_window.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {
namespace {

double variance(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    for (const double value : values) {
        sum += value;
    }
    for (const double value : values) {
        squares += (value - sum / count) * (value - sum / count);
    }
    return squares / count;
}

}  // namespace

HealthyRecordsMean::HealthyRecordsMean(std::size_t levels) : records_(levels, 0) {
    sum_.residual_variance.resize(levels, 0.0);
    sum_.envelope_variance.resize(levels, 0.0);
    sum_.amplitude.resize(levels);
}

void HealthyRecordsMean::add(std::size_t level, const features::FeatureInput& input) {
    const auto& sensor = input.get<features::SensorTurn>();
    ++records_[level];
    sum_.residual_variance[level] += variance(sensor.residual);
    sum_.envelope_variance[level] += variance(sensor.envelope);
    std::vector<double>& amplitude = sum_.amplitude[level];
    amplitude.resize(sensor.amplitude.size(), 0.0);
    for (std::size_t k = 0; k < amplitude.size(); ++k) {
        amplitude[k] += sensor.amplitude[k];
    }
}

HealthyReference HealthyRecordsMean::mean() const {
    HealthyReference mean = sum_;
    for (std::size_t level = 0; level < records_.size(); ++level) {
        mean.residual_variance[level] /= records_[level];
        mean.envelope_variance[level] /= records_[level];
        for (double& amplitude : mean.amplitude[level]) {
            amplitude /= records_[level];
        }
    }
    return mean;
}

namespace {

HealthyReference reference_of(const Scene& scene, const SensorPaths& path, std::uint64_t sensor) {
    const int lanes = scene.study().numerics.lanes;
    RealizationSignals records(scene, features::SignalSet::of<features::SensorTurn>());
    const std::size_t levels = scene.study().sensor.noise_levels.size();
    HealthyRecordsMean mean(levels);
    for (int first = 0; first < HealthyReference::kRecords; first += lanes) {
        std::vector<GearboxId> ids;
        for (int i = first; i < std::min(first + lanes, HealthyReference::kRecords); ++i) {
            ids.push_back({Group::threshold, static_cast<std::uint64_t>(i)});
        }
        const GearboxTile tile =
            run_gearboxes(scene, path, ids, lanes, {.signal_meshes = records.meshes()});
        auto signals = all_lane_signals(scene, path, tile, records.meshes());
        for (std::size_t lane = 0; lane < ids.size(); ++lane) {
            machine::throw_if_cancelled();
            if (tile.status[lane] == Status::ok) {
                Realization realization = tile.realizations[lane];
                if (sensor > 0) {
                    realization = at_sensor(scene.study(), realization, sensor);
                    signals[lane] =
                        signals_of_sensor(scene.study(), signals[lane], sensor - 1).record;
                }
                const LaneSignals record =
                    drawn_record(scene, std::move(signals[lane]), realization);
                records.load(record, realization);
                for (std::size_t level = 0; level < levels; ++level) {
                    mean.add(level, records.at(level));
                }
            }
        }
    }
    return mean.mean();
}

}  // namespace

HealthyReference healthy_reference(const Scene& scene, const SensorPaths& path,
                                   std::uint64_t sensor) {
    if (!needs_of(used_features(scene.study())).has<features::HealthyRecords>()) {
        return {};
    }
    return reference_of(scene, path, sensor);
}

HealthyReference simulated_reference(const Scene& scene, const SensorPaths& path) {
    return reference_of(scene, path, 0);
}

}  // namespace gearpod::mc
