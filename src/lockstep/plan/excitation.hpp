// Time-varying excitation of W realizations: fluctuating torque, fluctuating speed, and gravity,
// whose direction rotates in the frame of a rotating carrier.
//
// A fluctuation is a relative variation x of mean 0: the torque (or speed) is the study's value
// times 1 + x. It is the sum of a sine and a random part. The random part is white noise at knots
// `1 / knots_per_s` apart, shaped by cubic B-splines. It has two continuous derivatives, so
// integrators keep their order. Its two-sided spectrum is
//   S(f) = rms^2 D sinc(f D)^8 / (151/315),   D = 1 / knots_per_s,   sinc(x) = sin(pi x) / (pi x),
// and its autocorrelation is the B-spline of order 8.
//
// Phases count mesh periods from the start of the first recorded one; they are negative during the
// run-in.
#pragma once

#include <optional>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// One fluctuation of W lanes. All arrays are [lane] unless noted; an empty part is absent.
struct Fluctuation {
    // Sine: x = amplitude sin(2 pi (turns_per_mesh phase + turns_per_s time + turns)). A speed
    // fluctuation must have turns_per_s 0.
    machine::AlignedVector amplitude, turns_per_mesh, turns_per_s, turns;
    // Random part: x at time t is the spline with these knots ([knot][lane]) at t knots_per_s +
    // first_knot. For a speed fluctuation, t is the time at the mean speed. Outside the knots x is
    // 0.
    machine::AlignedVector knots_per_s, first_knot, knot;
};

struct ConstantGravity {
    double acceleration_m_s2 = 9.80665;  // standard gravity
    double direction_rad = 0.0;          // from the housing's x axis
};

struct Gravity : ConstantGravity {
    double carrier_turns_per_mesh = 0.0;  // signed; x and y of a planetary train rotate with it
};

// Excitation of a gearbox at constant speed.
struct VaryingForces {
    std::optional<Fluctuation> torque;
    std::optional<Gravity> gravity;

    // True if every mesh period has the same forces as the first one.
    bool repeat() const { return !torque && (!gravity || gravity->carrier_turns_per_mesh == 0.0); }
};

// End of a shaft at a gearbox: the degree of freedom that turns with it, and the rotation of the
// shaft per motion there, rad/m. It is negative if the shaft's positive sense is opposite to that
// of the gearbox.
struct ShaftEnd {
    int degree = 0;
    double turn_per_m = 0.0;
};

// Largest number of shafts at a gearbox.
inline constexpr int kMostShafts = 4;

struct Excitation : VaryingForces {
    std::optional<Fluctuation> speed;
    // Used with `speed`: the degree of freedom at which the speed is imposed, and the train's
    // velocity along dynamics::rigid_rotation, [lane], m/s.
    int input_degree = 0;
    machine::AlignedVector rotation_m_s;
    // Shafts whose torques, N m, become known only during the integration (tile_integrators.hpp).
    std::vector<ShaftEnd> shafts;

    // True if every mesh period has the same excitation as the first one.
    bool repeats() const { return !speed && repeat(); }
};

}  // namespace gearpod::lockstep
