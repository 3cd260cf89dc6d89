#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

LifeTiles::LifeTiles(const Scene& scene, LifePlan plan)
    : scene_(scene),
      plan_(std::move(plan)),
      torques_(plan_.distributions.torque, plan_.torques),
      speeds_(plan_.distributions.speed, plan_.speeds),
      crack_(plan_) {}

std::size_t LifeTiles::lanes() const {
    return static_cast<std::size_t>(plan_.campaign.ensemble.lanes);
}

std::size_t LifeTiles::gap_count() const {
    const bool interpolates = torques_.interpolates() || speeds_.interpolates();
    return load_count() == 1 || !interpolates
               ? 0
               : torques_.between().size() * speeds_.between().size();
}

Realization LifeTiles::draw(const GearboxId& id) const {
    Realization gearbox = plan_.sampler->draw(id);
    gearbox.inputs.fault_size = 0.0;
    return gearbox;
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
    for (Realization& gearbox : all) {
        gearbox.inputs.torque_N_m *= load.torque;
        gearbox.inputs.fixed_shaft.load_torque_N_m *= load.torque;
        gearbox.inputs.speed_rad_s *= load.speed;
    }
    return {scene_, std::move(all), static_cast<int>(lanes())};
}

}  // namespace gearpod::mc
