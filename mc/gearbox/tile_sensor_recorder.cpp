#include "mc/gearbox/tile_sensor_recorder.hpp"

#include <algorithm>

#include "machine/wall_clock.hpp"
#include "mc/coupling/record_positions.hpp"
#include "mc/gearbox/tile_random_inputs.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/study/housing.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const Realization> realizations) {
    return std::ranges::any_of(realizations,
                               [](const Realization& one) { return one.inputs.gain != 1.0; });
}

void apply_gain(std::span<const Realization> realizations, machine::AlignedVector& acceleration) {
    for (std::size_t i = 0; i < acceleration.size(); ++i) {
        acceleration[i] *= realizations[i % realizations.size()].inputs.gain;
    }
}

std::vector<double> path_exponents(std::span<const Realization> realizations, std::size_t path) {
    std::vector<double> exponents;
    for (const Realization& one : realizations) {
        exponents.push_back(path == 0 ? one.inputs.path_exponent : 0.0);
    }
    return exponents;
}

TileSensorRecorder::TileSensorRecorder(const Scene& scene, const SensorPaths& path,
                                       std::span<const Realization> realizations, int kept_meshes,
                                       int meshes)
    : realizations_(realizations),
      has_gain_(has_gain(realizations)),
      signal_meshes_(meshes > 0 ? std::max(meshes, scene.span_meshes()) : scene.signal_meshes()),
      recorded_meshes_(meshes > 0 ? signal_meshes_ : scene.recorded_meshes()),
      record_meshes_(has_record_length(scene.study())
                         ? record_turns(scene, realizations.front().inputs) *
                               scene.span().planet_teeth
                         : signal_meshes_) {
    const signals::Tones tones = draw_tones(scene, realizations), none;
    for (std::size_t s = 0; s < path.size(); ++s) {
        const SensorPath& sensor = path[s];
        // Tones are added to the response of a sensor later.
        const signals::Tones& added = has_response(scene.study(), s) ? none : tones;
        auto& recorders = recorders_.emplace_back();
        for (std::size_t p = 0; p < sensor.size(); ++p) {
            const std::vector<double> exponents = path_exponents(realizations, p);
            recorders.push_back(std::make_unique<signals::SensorResponse>(
                sensor[p], scene.span(),
                signals::SensorResponse::Tile{static_cast<int>(realizations.size()), exponents,
                                              &added, scene.te_samples_per_mesh(), signal_meshes_,
                                              kept_meshes < 0 ? signal_meshes_ : kept_meshes,
                                              has_record_length(scene.study()),
                                              dynamics::sources(scene.plan().layout)}));
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
    if (const auto part = std::ranges::find_if(
            parts_, [&](const lockstep::SpanPart& one) { return k >= one.first && k < one.end; });
        part != parts_.end()) {
        end = std::min(end, std::max(part->end, part->first + record_meshes_));
    }
    for (int at = k; at < end; at += recorded_meshes_) {
        for (const auto& sensor : recorders_) {
            for (const auto& path : sensor) {
                path->record_mesh(at, acceleration, record.te.data());
            }
        }
    }
    spent_s_ += seconds_since(start);
}

}  // namespace gearpod::mc
