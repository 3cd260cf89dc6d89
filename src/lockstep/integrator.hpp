// Which method marches the equations of motion.
#pragma once

namespace gearpod::lockstep {

// rk4: the classical explicit Runge-Kutta method of order 4.
enum class Integrator { rk4 };

}  // namespace gearpod::lockstep
