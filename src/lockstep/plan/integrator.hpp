// Integration method of the equations of motion (implemented in lockstep/integrators) and its
// floating-point precision.
#pragma once

namespace gearpod::lockstep {

// Integrators, as listed in integrators.def.
enum class Integrator {
#define GEARPOD_INTEGRATOR(NAME, ...) NAME,
#include "lockstep/plan/integrators.def"
#undef GEARPOD_INTEGRATOR
};

// Integrators that the program takes by itself: the explicit one, or the implicit one for gearboxes
// that are too stiff for it. Costs and stability limits are stated relative to the explicit one.
inline constexpr Integrator kUsualExplicit = Integrator::rk4;
inline constexpr Integrator kUsualImplicit = Integrator::sdirk3;

// Precision of the motion within a mesh period. Between mesh periods it is always double.
enum class Precision { double_precision, single_precision };

}  // namespace gearpod::lockstep
