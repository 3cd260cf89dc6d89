#include "mc/gearbox/tile_sensor_recorder.hpp"

#include <algorithm>

#include "machine/wall_clock.hpp"
#include "mc/gearbox/tile_random_inputs.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const InstanceInputs> inputs) {
    return std::ranges::any_of(inputs, [](const InstanceInputs& one) { return one.gain != 1.0; });
}

void apply_gain(std::span<const InstanceInputs> inputs, machine::AlignedVector& acceleration) {
    for (std::size_t i = 0; i < acceleration.size(); ++i) {
        acceleration[i] *= inputs[i % inputs.size()].gain;
    }
}

std::vector<double> path_exponents(std::span<const InstanceInputs> inputs) {
    std::vector<double> exponents;
    for (const InstanceInputs& instance : inputs) {
        exponents.push_back(instance.path_exponent);
    }
    return exponents;
}

TileSensorRecorder::TileSensorRecorder(const Scene& scene, const signals::PathGrid& path,
                                       std::span<const GearboxId> ids,
                                       std::span<const InstanceInputs> inputs, int kept_meshes)
    : inputs_(inputs),
      has_gain_(has_gain(inputs)),
      signal_meshes_(scene.signal_meshes()),
      recorded_meshes_(scene.recorded_meshes()) {
    const signals::Tones tones = draw_tones(scene, ids, inputs);
    const std::vector<double> exponents = path_exponents(inputs);
    response_ = std::make_unique<signals::SensorResponse>(
        path, scene.span(),
        signals::SensorResponse::Tile{static_cast<int>(inputs.size()), exponents, &tones,
                                      scene.te_samples_per_mesh(), signal_meshes_,
                                      kept_meshes < 0 ? signal_meshes_ : kept_meshes});
}

void TileSensorRecorder::operator()(int k, const lockstep::MeshRecord& record) {
    const auto start = WallClock::now();
    const double* acceleration = record.acceleration.data();
    if (has_gain_) {
        amplified_acceleration_ = record.acceleration;
        apply_gain(inputs_, amplified_acceleration_);
        acceleration = amplified_acceleration_.data();
    }
    for (int at = k; at < signal_meshes_; at += recorded_meshes_) {
        response_->record_mesh(at, acceleration, record.te.data());
    }
    spent_s_ += seconds_since(start);
}

}  // namespace gearpod::mc
