// Which method marches the equations of motion (lockstep/integrators has them), and in what
// numbers.
#pragma once

namespace gearpod::lockstep {

// The names of integrators.def.
enum class Integrator {
#define GEARPOD_INTEGRATOR(NAME, ...) NAME,
#include "lockstep/plan/integrators.def"
#undef GEARPOD_INTEGRATOR
};

// What the motion is computed in within a mesh period; from one to the next it is double.
enum class Precision { double_precision, single_precision };

}  // namespace gearpod::lockstep
