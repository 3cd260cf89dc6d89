#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

LifeTiles::LifeTiles(const Scene& scene)
    : scene_((check_composable(scene), scene)),
      laws_(scene.study()),
      torques_(laws_.torque.marched(torques_marched(scene.study().life))),
      speeds_(laws_.speed.marched(speeds_marched(scene.study().life))),
      sampler_(study_of_gearboxes(scene.study())),
      path_(path_grid(scene)),
      crack_(scene) {}

std::size_t LifeTiles::lanes() const {
    return static_cast<std::size_t>(scene_.study().numerics.lanes);
}

std::size_t LifeTiles::gap_count() const {
    const Life& life = scene_.study().life;
    return load_count() == 1 ? 0
                             : laws_.torque.between(torques_marched(life)).size() *
                                   laws_.speed.between(speeds_marched(life)).size();
}

InstanceInputs LifeTiles::inputs(const GearboxId& id) const {
    InstanceInputs inputs = sampler_.sample(id.group, id.index);
    inputs.fault_size = 0.0;
    return inputs;
}

double LifeTiles::depth(int step) const {
    return *scene_.study().life.last_depth_m * step / scene_.study().life.depth_steps;
}

std::vector<LifeTiles::Load> LifeTiles::loads() const {
    std::vector<Load> all;
    for (const double torque : torques_) {
        for (const double speed : speeds_) {
            all.push_back({torque, speed});
        }
    }
    return all;
}

std::vector<double> LifeTiles::shares(const Load& load) const {
    std::vector<double> all;
    for (const double torque : shares_of(torques_, load.torque)) {
        for (const double speed : shares_of(speeds_, load.speed)) {
            all.push_back(torque * speed);
        }
    }
    return all;
}

HealthyMarch LifeTiles::march(std::span<const GearboxId> ids, const Load& load) const {
    std::vector<InstanceInputs> all;
    for (const GearboxId& id : ids) {
        all.push_back(inputs(id));
        all.back().torque_N_m *= load.torque;
        all.back().fixed_shaft.load_torque_N_m *= load.torque;
        all.back().speed_rad_s *= load.speed;
    }
    return {scene_, path_, ids, std::move(all), static_cast<int>(lanes())};
}

}  // namespace gearpod::mc
