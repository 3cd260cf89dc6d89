// Which member of a planetary train stands, which one drives: directions of speed and torque, and
// the transmission error. Sources: Park et al. (2016), Table I and Eq. 8; Willis' equation.
//
// The gearbox models let the sun's torque act in the positive sense, and with it the ring's, and
// the carrier's in the negative one: those torques press the same flanks together whoever drives. A
// member that drives turns with its torque, one that is driven turns against it. So the sun or the
// ring drive in the positive sense and the carrier in the negative one: a train driven by the
// carrier is the mirror image of the real one that turns in the positive sense on its other flanks.
// Reflection turns positions psi_n into -psi_n and speeds, torques and pressure angle into their
// opposites, and leaves every deflection, frequency and phase as it is.
#pragma once

#include "gears/planetary.hpp"

namespace gearpod::gears {

// Park's working conditions, by (fixed, input): 1 (sun, ring), 2 (sun, carrier), 3 (ring, sun),
// 4 (ring, carrier), 5 (carrier, sun), 6 (carrier, ring).
struct PowerFlow {
    FixedMember fixed = FixedMember::ring;
    Member input = Member::sun;
};

// The member that is neither fixed nor the input.
Member output_member(const PowerFlow& flow);

// All speeds, signed as above, from the magnitude of one member's. Throws std::invalid_argument if
// that member is the fixed one.
Speeds driven_speeds(const PlanetaryTrain& train, const PowerFlow& flow, Member given,
                     double magnitude);

// One value for each central member.
struct Members {
    double carrier = 0;
    double ring = 0;
    double sun = 0;
};

// External torques in balance, T_s : T_r : T_c = Z_s : Z_r : -(Z_s + Z_r), from the magnitude of
// one. The fixed member's is its support's reaction.
Members balanced_torques(const PlanetaryTrain& train, Member given, double magnitude);

// Transmission error as weights of the members' rotations: the output's less the input's times
// their ratio of speeds (Park et al., Eq. 8). Zero for the train turning as a rigid mechanism.
Members transmission_error_weights(const PlanetaryTrain& train, const PowerFlow& flow);

}  // namespace gearpod::gears
