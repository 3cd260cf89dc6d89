// Arithmetic operations of a step as gearbox.hpp and Boost.odeint spell it.
#pragma once

namespace gearpod::peers {

// Of one gearbox, a fused multiply-add as two: four times the rates, and odeint's sums of 1, 2, 3
// and 4 products for its stages and its end. At most: a compiler may find operations in common.
double rk4_flop(bool motion_only);

}  // namespace gearpod::peers
