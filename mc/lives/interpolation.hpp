// What interpolation takes, seen while the gearboxes are marched.
#pragma once

#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// All must outlive it.
class LifeTiles::Look {
  public:
    // `march`: of these gearboxes at the first of the loads.
    Look(const LifeTiles& tiles, std::span<const GearboxId> ids, const HealthyMarch& march,
         std::span<InterpolationErrors> errors)
        : tiles_(tiles), ids_(ids), march_(march), errors_(errors) {}

    // Between every two neighbouring loads, the largest.
    void between_loads(const Marched& healthy);
    // In the middle of a step of depth, at the first load; the first and the last step are looked
    // at.
    void between_depths(int step, const Marched& healthy, const Marched& low, const Marched& high);

  private:
    void at_load(const Load& load, const Marched& healthy);

    const LifeTiles& tiles_;
    const std::span<const GearboxId> ids_;
    const HealthyMarch& march_;
    const std::span<InterpolationErrors> errors_;
};

}  // namespace gearpod::mc
