// Number of arithmetic operations of a step as written in gearbox.hpp and Boost.odeint.
#pragma once

namespace gearpod::peers {

// Operations for one realization, with a fused multiply-add as two: four times the rates, and
// odeint's sums of 1, 2, 3 and 4 products for its stages and its end. An upper bound: a compiler
// may find common subexpressions.
double rk4_flop(bool motion_only);

}  // namespace gearpod::peers
