// What an integrator says of itself, as static members of its struct beside Stages and step():
//
//   kName          as study files say it
//   kOrder         of its error where the stiffness is smooth
//   kStageNodes    positions within a step at which it needs the stiffness, ascending; 0 means the
//                  right limit there, 1 the left limit
//   kStepsInBand   steps in a period of the sensor's band edge with which the signal is right to
//                  0.1 % (an implicit method's motion as well); an explicit method's low-pass
//                  stands half as many
//   kCost          of a step
//   kSpan          of an implicit method: how far the acceleration of a stage carries
//   growth(z)      of an explicit method whose stages all see q' = v: what a step multiplies a mode
//                  by, z = h lambda; one without it steps on the middles as central differences do
//   filter(s)      a step of the sensor's low-pass by the same method (filter_system.hpp)
#pragma once

namespace gearpod::lockstep {

// The velocity is carried by so much of a step, the position by so much of its square.
struct ImplicitSpan {
    double velocity = 0.0, position = 0.0;
};

// Cost of one step of one gearbox in a full tile, in the time that one step of rk4 takes, by the
// gearbox's motion: the ratios that the command `accuracy` measures, as they were on an AVX-512
// core. Numbers and no clock, so that a study makes the same choice on every machine.
struct StepCost {
    double planetary = 1.0, rotations = 1.0, fixed_shaft = 1.0;
};

template <class Method>
inline constexpr bool kImplicit = requires {
    Method::kSpan;
};

}  // namespace gearpod::lockstep
