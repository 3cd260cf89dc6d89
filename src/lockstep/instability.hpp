// Why a gearbox does not come to rest on an orbit: its own physics, or the step.
#pragma once

#include "lockstep/march.hpp"

namespace gearpod::lockstep {

// turning_frame: with every mesh at its mean stiffness a motion grows; only the inertial terms can
// make it, above a critical speed of the carrier. parametric: steady stiffness would be stable, its
// change with the mesh phase makes a motion grow (parametric resonance). step: the gearbox is as it
// should be, but the explicit method's step is too long for it. none: nothing of all that.
enum class Instability { none, turning_frame, parametric, step };

// Growth of the fastest growing motion from one mesh period to the next, the rigid rotation
// removed as the march removes it: the largest |Floquet multiplier| of the healthy gearbox. The
// stiffness is constant in each of `pieces` or more parts of the mesh period, at its mean there;
// pieces = 1 means steady stiffness.
double growth_per_mesh(const MarchPlan& plan, const dynamics::GearboxInputs& inputs, int pieces);

// A growth of less than 1e-5 a mesh period counts as none. Meshes that separate are judged by
// steady stiffness alone: what their contact loses bounds a parametric resonance.
Instability find_instability(const MarchPlan& plan, const dynamics::GearboxInputs& inputs);

}  // namespace gearpod::lockstep
