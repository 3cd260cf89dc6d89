#include "mc/ensemble/gearbox/tile_sensors.hpp"

#include <algorithm>

#include "machine/clocks.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "mc/study/housing.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::mc {
namespace {

SensorPath path_of(const Scene& scene, const signals::SensorPlace& sensor) {
    const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(&scene.drivetrain());
    if (planetary == nullptr || scene.study().effects.path == nullptr) {
        // A sensor on the housing: one window with constant weight.
        return {{signals::path_window("rectangular"), 1, scene.samples_per_mesh(), scene.span()}};
    }
    const auto sense = planetary->carrier_turns_backwards() ? signals::CarrierSense::negative
                                                            : signals::CarrierSense::positive;
    SensorPath path;
    const auto add = [&](const auto& kind) {
        path.emplace_back(kind, gears::planet_places(planetary->train()), scene.samples_per_mesh(),
                          scene.span(), sense, sensor);
    };
    add(*scene.study().effects.path);
    for (const int nodal_diameters : ring_modes(scene.study())) {
        add(signals::RingLoad{nodal_diameters, signals::RingLoad::Axis::x});
        add(signals::RingLoad{nodal_diameters, signals::RingLoad::Axis::y});
    }
    for (const HousingBearing& bearing : housing_bearings(scene.study())) {
        const int after_planets = bearing.shaft == Member::sun ? 0 : 1;
        path.emplace_back(signals::BearingSource{planetary->train().planets + after_planets},
                          scene.samples_per_mesh(), scene.span(), sense, sensor);
    }
    return path;
}

}  // namespace

SensorPaths sensor_paths(const Scene& scene) {
    SensorPaths paths{path_of(scene, {})};
    for (const AdditionalSensor& sensor : scene.study().sensor.additional) {
        paths.push_back(path_of(scene, {sensor.angle_deg, sensor.tangential, sensor.gain}));
    }
    return paths;
}

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
      record_meshes_(scene.record().length ? scene.record().turns(realizations.front().inputs) *
                                                 scene.span().planet_teeth
                                           : signal_meshes_) {
    const signals::Tones tones = draw_tones(scene.study().sensor.tones, scene.gearbox(),
                                            scene.draw().seed, realizations),
                         none;
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
                                              scene.record().length.has_value(),
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
