// A tile of W gearboxes without inertia: the static equilibrium K(phase) q = f at every sample. It
// remembers nothing, so that a mesh period depends only on the teeth that touch in it: one healthy
// record, and one for each mesh of the pattern in which a fault passes.
//
// Records hold the transmission error and, if asked for, the motion. They have no acceleration: a
// body that moves without inertia shakes no sensor.
#pragma once

#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

// Takes what run_tile takes. The free rigid rotation is left out. A lane whose load meets no
// stiffness (all teeth that could carry it broken) has no equilibrium: `diverged`, its records say
// NaN. One whose contacts open and close without end is `unsettled`. The centrifugal pull of the
// layout's inertial terms counts as a load.
template <int W>
TileResult run_quasi_static(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                            const FaultCurves& faults, const TileSettings& settings);

extern template TileResult run_quasi_static<1>(const MarchPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);
extern template TileResult run_quasi_static<4>(const MarchPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);
extern template TileResult run_quasi_static<8>(const MarchPlan&,
                                               std::span<const dynamics::GearboxInputs>,
                                               const FaultCurves&, const TileSettings&);

}  // namespace gearpod::lockstep
