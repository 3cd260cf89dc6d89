// Measures the errors of interpolation between crack depths and between loads (InterpolationErrors)
// while gearboxes are integrated.
#pragma once

#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// All arguments must outlive the object.
class LifeTiles::Look {
  public:
    // `march` holds these gearboxes at the first load.
    Look(const LifeTiles& tiles, std::span<const GearboxId> ids, const HealthyMarch& march,
         std::span<InterpolationErrors> errors)
        : tiles_(tiles), ids_(ids), march_(march), errors_(errors) {}

    // Computes the largest error halfway between neighbouring loads.
    void between_loads(const Marched& healthy);
    // Computes the error at the middle of a depth step at the first load. Only the first and last
    // steps are evaluated.
    void between_depths(int step, const Marched& healthy, const Marched& low, const Marched& high);

  private:
    void at_load(const Load& load, const Marched& healthy);

    const LifeTiles& tiles_;
    const std::span<const GearboxId> ids_;
    const HealthyMarch& march_;
    const std::span<InterpolationErrors> errors_;
};

}  // namespace gearpod::mc
