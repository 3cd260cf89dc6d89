#include "mc/gearbox/sensor_paths.hpp"

#include "mc/study/housing.hpp"
#include "signals/path/path_window.hpp"

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

}  // namespace gearpod::mc
