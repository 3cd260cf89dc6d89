// Chooses the number of torques and speeds at which the gearboxes of lives are integrated.
#pragma once

#include "machine/no_value.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

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
// cannot be reached, the numbers of the least error are taken. Depends on the study only.
InterpolationChoice choose_interpolation(const TilePlan& tile, const LifePlan& plan);

}  // namespace gearpod::mc
