// Low-pass of the sensor, integrated beside the motion: 4th-order Butterworth, two sections in
// series,
//   x'' + b1 w x' + w^2 x = w^2 input,   y'' + b2 w y' + w^2 y = w^2 x,   w = 2 pi f_cutoff,
// b = 2 cos(pi/8), 2 cos(3 pi/8). One step of the integrator is linear in the state (x, x', y, y')
// and in the input at up to six stages; its coefficients are computed once per step length
// and gearbox.
#pragma once

namespace gearpod::lockstep {

inline constexpr int kFilterStates = 4;  // x, x', y, y'; y is the output
inline constexpr int kFilterOutput = 2;
inline constexpr double kFilterDamping[] = {1.8477590650225735, 0.7653668647301797};  // b1, b2

// Positions in one step's coefficients: the transition matrix without its zero block, then the
// columns of the input at the stages (newmark: start, none, end; generalized_alpha: the same, by its
// lag earlier; central_difference: the middle alone), 0 for those that a method does not have.
inline constexpr int kFilterXX = 0;      // 2 x 2: x, x' from x, x'
inline constexpr int kFilterYX = 4;      // 2 x 2: y, y' from x, x'
inline constexpr int kFilterYY = 8;      // 2 x 2: y, y' from y, y'
inline constexpr int kFilterInput = 12;  // kFilterInputs x 4
inline constexpr int kFilterInputs = 6;
inline constexpr int kFilterCoefficients = kFilterInput + kFilterInputs * kFilterStates;

}  // namespace gearpod::lockstep
