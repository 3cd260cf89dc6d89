// Properties of an integrator, as static members of its struct in addition to Stages and step():
//
//   kName          name in study files
//   kOrder         of its error where the stiffness is smooth
//   kStageNodes    positions within a step at which it needs the stiffness, ascending; 0 means the
//                  right limit there, 1 the left limit
//   kStepsInBand   steps per period of the sensor's band edge at which the signal is correct to
//                  0.1 % (for an implicit method also the motion); the low-pass filter of an
//                  explicit method tolerates half as many
//   kCost          of a step
//   kDiagonal      implicit methods: factor of a stage's own slope, times the step
//   growth(z)      explicit methods whose stages all use q' = v: factor by which a step multiplies
//                  a mode, z = h lambda, from which the limit of stable steps follows
//   stable_step(m) other explicit methods: longest step (s) for which no decaying mode of the
//                  matrices m grows
//   kLeastMargin   optional, explicit methods: smallest margin of the number of steps over that of
//                  the stability limit; kStepMargin for methods that damp motion near the limit
//   kScalesMass    optional: true for methods that may give fast modes more inertia
//                  (plan/mode_inertia.hpp)
//   filter(s)      a step of the sensor's low-pass filter by the same method (sensor_filter.hpp)
#pragma once

namespace gearpod::lockstep {

// Cost of one step of one gearbox in a full tile, relative to one step of rk4, by the gearbox's
// model. The values are ratios measured by the command `accuracy` on an AVX-512 core. They are
// constants, so that a study makes the same choice on every machine.
struct StepCost {
    double planetary = 1.0, rotations = 1.0, fixed_shaft = 1.0;
};

// Margin of the number of steps over that of the stability limit.
inline constexpr double kStepMargin = 1.2;

template <class Method>
inline constexpr bool kImplicit = requires {
    Method::kDiagonal;
};

}  // namespace gearpod::lockstep
