// Measures the errors of interpolation between crack depths and between loads (InterpolationErrors)
// while gearboxes are integrated.
#pragma once

#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// All arguments must outlive the object.
class LifeTiles::InterpolationCheck {
  public:
    // `solution` holds these gearboxes at the first load.
    InterpolationCheck(const LifeTiles& tiles, std::span<const Realization> gearboxes,
                       const HealthySolution& solution, std::span<InterpolationErrors> errors)
        : tiles_(tiles), gearboxes_(gearboxes), solution_(solution), errors_(errors) {}

    // Computes the largest error halfway between neighbouring loads.
    void between_loads(const SignalsByLoad& healthy);
    // Computes the error at the middle of a depth step at the first load. Only the step in which
    // the crack begins to grow and the last step are evaluated.
    void between_depths(int step, const SignalsByLoad& healthy, const SignalsByLoad& low,
                        const SignalsByLoad& high);

  private:
    void at_load(const Load& load, const SignalsByLoad& healthy);

    const LifeTiles& tiles_;
    const std::span<const Realization> gearboxes_;
    const HealthySolution& solution_;
    const std::span<InterpolationErrors> errors_;
};

}  // namespace gearpod::mc
