// What drives W gearboxes unevenly: torque and speed that fluctuate, and gravity, whose direction
// turns in the frame of a turning carrier.
//
// A fluctuation is a relative variation x of mean 0: the torque is that of the study times 1 + x,
// the speed likewise. It has a sine and a random part. The random part is white noise of knots
// `1 / knots_per_s` apart, shaped by cubic B-splines: it has two continuous derivatives, so that
// integrators keep their order, its two-sided spectrum is
//   S(f) = rms^2 D sinc(f D)^8 / (151/315),   D = 1 / knots_per_s,   sinc(x) = sin(pi x) / (pi x),
// and its autocorrelation the B-spline of order 8.
//
// Phases count mesh periods from the first recorded one; before it (run-in) they are negative.
#pragma once

#include <optional>

#include "dynamics/gearbox.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// D of noise whose spectrum has fallen to half at `half_power_Hz`: sinc(0.2275...)^8 = 1/2.
double knots_per_s(double half_power_Hz);
// Standard deviation of knots for noise of rms 1: the mean square of cubic B-splines is 151/315.
double knot_deviation();

// [lane] each; an empty part is absent.
struct Fluctuation {
    // x = amplitude sin(2 pi (turns_per_mesh phase + turns_per_s time + turns)); of speed, only
    // with turns_per_s 0.
    machine::AlignedVector amplitude, turns_per_mesh, turns_per_s, turns;
    // x at time t is the spline with these knots ([knot][lane]) at t knots_per_s + first_knot;
    // of speed, t counts as if the speed were steady. Beyond the knots it is 0.
    machine::AlignedVector knots_per_s, first_knot, knot;
};

struct Gravity {
    double acceleration_m_s2 = 9.80665;   // standard gravity
    double direction_rad = 0.0;           // from the housing's x
    double carrier_turns_per_mesh = 0.0;  // signed; x and y of a planetary train turn with it
};

struct Excitation {
    std::optional<Fluctuation> torque, speed;
    std::optional<Gravity> gravity;
    // For `speed`: the degree of freedom that drives the train, and how fast the train turns along
    // dynamics::rigid_rotation, [lane], m/s.
    int driving = 0;
    machine::AlignedVector turning_m_s;

    // Every mesh period is like the first.
    bool repeats() const {
        return !torque && !speed && (!gravity || gravity->carrier_turns_per_mesh == 0.0);
    }
};

// Throws std::invalid_argument for an excitation that does not repeat while only an orbit is
// marched (march_meshes 0).
void check_excitation(const Excitation* excitation, int march_meshes);

}  // namespace gearpod::lockstep
