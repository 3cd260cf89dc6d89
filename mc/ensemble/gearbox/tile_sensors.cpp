#include "mc/ensemble/gearbox/tile_sensors.hpp"

#include <algorithm>

#include "machine/clocks.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const Realization> realizations) {
    return std::ranges::any_of(realizations, [](const Realization& realization) {
        return realization.inputs.gain != 1.0;
    });
}

void apply_gain(std::span<const Realization> realizations, machine::AlignedVector& acceleration) {
    for (std::size_t i = 0; i < acceleration.size(); ++i) {
        acceleration[i] *= realizations[i % realizations.size()].inputs.gain;
    }
}

std::vector<double> path_exponents(std::span<const Realization> realizations, std::size_t path) {
    std::vector<double> exponents;
    for (const Realization& realization : realizations) {
        exponents.push_back(path == 0 ? realization.inputs.path_exponent : 0.0);
    }
    return exponents;
}

TileSensorRecorder::TileSensorRecorder(const RecordPlan& plan, std::span<const SensorPlan> sensors,
                                       const signals::Tones& tones,
                                       std::span<const Realization> realizations, int kept_meshes,
                                       int meshes)
    : realizations_(realizations),
      has_gain_(has_gain(realizations)),
      signal_meshes_(meshes > 0 ? std::max(meshes, plan.span.meshes()) : plan.signal_meshes),
      recorded_meshes_(meshes > 0 ? signal_meshes_ : plan.recorded_meshes),
      record_meshes_(signal_meshes_) {
    if (plan.length) {
        record_meshes_ = 0;
        for (const Realization& realization : realizations) {
            record_meshes_ =
                std::max(record_meshes_, plan.turns(realization.inputs) * plan.span.planet_teeth);
        }
    }
    const signals::Tones none;
    for (const SensorPlan& sensor : sensors) {
        // Tones are added to the response of a sensor later.
        const signals::Tones& added = sensor.find<PathStage>() != nullptr ? tones : none;
        auto& recorders = recorders_.emplace_back();
        for (std::size_t p = 0; p < sensor.paths.size(); ++p) {
            const std::vector<double> exponents = path_exponents(realizations, p);
            recorders.push_back(std::make_unique<signals::SensorResponse>(
                sensor.paths[p], plan.span,
                signals::SensorResponse::Tile{static_cast<int>(realizations.size()), exponents,
                                              &added, plan.te_samples, signal_meshes_,
                                              kept_meshes < 0 ? signal_meshes_ : kept_meshes,
                                              plan.length.has_value(), plan.sources}));
        }
    }
}

void TileSensorRecorder::operator()(int k, const lockstep::MeshRecord& record) {
    const auto start = WallClock::now();
    const double* acceleration = record.acceleration.data();
    if (has_gain_) {
        amplified_acceleration_ = record.acceleration;
        apply_gain(realizations_, amplified_acceleration_);
        acceleration = amplified_acceleration_.data();
    }
    int end = signal_meshes_;
    const auto holds = [&](const lockstep::SpanPart& part) {
        return k >= part.first && k < part.end;
    };
    if (const auto part = std::ranges::find_if(parts_, holds); part != parts_.end()) {
        end = std::min(end, std::max(part->end, part->first + record_meshes_));
    }
    for (int mesh = k; mesh < end; mesh += recorded_meshes_) {
        for (const auto& sensor : recorders_) {
            for (const auto& path : sensor) {
                path->record_mesh(mesh, acceleration, record.te.data());
            }
        }
    }
    spent_s_ += seconds_since(start);
}

}  // namespace gearpod::mc
