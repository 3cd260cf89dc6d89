#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

LifeTiles::LifeTiles(const Scene& scene)
    : scene_((check_superposable(scene), scene)),
      distributions_(scene.study()),
      torques_(distributions_.torque, integrated_torques(scene.study().life),
               scene.study().life.polynomial_torques),
      speeds_(distributions_.speed, integrated_speeds(scene.study().life),
              scene.study().life.polynomial_speeds),
      sampler_(study_of_gearboxes(scene.study())),
      path_(sensor_paths(scene)),
      crack_(scene) {}

std::size_t LifeTiles::lanes() const {
    return static_cast<std::size_t>(scene_.study().numerics.lanes);
}

std::size_t LifeTiles::gap_count() const {
    const bool interpolates = torques_.interpolates() || speeds_.interpolates();
    return load_count() == 1 || !interpolates
               ? 0
               : torques_.between().size() * speeds_.between().size();
}

Realization LifeTiles::draw(const GearboxId& id) const {
    Realization gearbox = sampler_.draw(id);
    gearbox.inputs.fault_size = 0.0;
    return gearbox;
}

double LifeTiles::depth(int step) const {
    return *scene_.study().life.last_depth_m * step / scene_.study().life.depth_steps;
}

std::vector<LifeTiles::Load> LifeTiles::loads() const {
    std::vector<Load> all;
    for (const double torque : torques_.factors()) {
        for (const double speed : speeds_.factors()) {
            all.push_back({torque, speed});
        }
    }
    return all;
}

std::vector<double> LifeTiles::load_weights(const Load& load) const {
    std::vector<double> all;
    for (const double torque : torques_.weights(load.torque)) {
        for (const double speed : speeds_.weights(load.speed)) {
            all.push_back(torque * speed);
        }
    }
    return all;
}

HealthySolution LifeTiles::healthy_solution(std::span<const Realization> gearboxes,
                                            const Load& load) const {
    std::vector<Realization> all(gearboxes.begin(), gearboxes.end());
    for (Realization& one : all) {
        one.inputs.torque_N_m *= load.torque;
        one.inputs.fixed_shaft.load_torque_N_m *= load.torque;
        one.inputs.speed_rad_s *= load.speed;
    }
    return {scene_, path_, std::move(all), static_cast<int>(lanes())};
}

}  // namespace gearpod::mc
