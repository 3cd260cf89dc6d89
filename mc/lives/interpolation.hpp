// Measures the errors of interpolation between crack depths and between loads (InterpolationErrors)
// while gearboxes are integrated.
#pragma once

#include <string>

#include "machine/no_value.hpp"
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

// Chooses the number of torques and speeds at which the gearboxes of lives are integrated.

// Largest number of integrated loads (torques times speeds) that is chosen.
inline constexpr std::size_t kMostLoads = 34;
// Number of pilots: the first gearboxes with a crack, whether or not the study has as many.
inline constexpr std::uint64_t kInterpolationPilots = 8;

struct InterpolationChoice {
    LifePlan plan;  // with the numbers of torques and speeds
    // Sum of the errors along torque and speed, each the largest over the pilots: rms over the
    // span, relative to the change made by the smallest crack of interest at the gearbox's own
    // load. 0 if nothing is interpolated between loads; NaN if no pilot was integrated.
    double error = kNan;
    int loads = 0;  // number of loads at which the pilots were integrated
};

// Raises the numbers that are not given from two until the error is at most the tolerance; if that
// cannot be reached, the numbers of the least error are taken. Depends on the study only. Throws
// SceneError if it has no lives.
InterpolationChoice choose_interpolation(const Scene& scene);

}  // namespace gearpod::mc
