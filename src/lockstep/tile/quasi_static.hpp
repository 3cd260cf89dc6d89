// Quasi-static tile: W gearboxes without inertia, in static equilibrium K(phase) q = f at every
// sample. It has no memory, so a mesh period depends only on the teeth engaged in it. There is one
// healthy record, and one for each mesh period of the pattern in which a fault passes.
//
// Records hold the transmission error and, if requested, the motion. They have no acceleration,
// because a model without inertia has no vibration to measure.
#pragma once

#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

// Takes the same arguments as run_tile. The free rigid rotation is omitted. A lane whose load meets
// no stiffness (all teeth that could carry it are broken) has no equilibrium: it is `diverged` and
// its records are NaN. A lane whose contacts keep opening and closing is `not_converged`. The
// centrifugal force of the layout's inertial terms counts as a load.
template <int W>
TileResult run_quasi_static(const IntegrationPlan& plan,
                            std::span<const dynamics::GearboxInputs> inputs,
                            const FaultCurves& faults, const TileSettings& settings);

extern template TileResult run_quasi_static<1>(const IntegrationPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);
extern template TileResult run_quasi_static<4>(const IntegrationPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);
extern template TileResult run_quasi_static<8>(const IntegrationPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);

}  // namespace gearpod::lockstep
