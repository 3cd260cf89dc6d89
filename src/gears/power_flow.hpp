// Power flow through a planetary train: directions of speed and torque for each choice of fixed and
// input member, and the transmission error. Sources: Park et al. (2016), Table I and Eq. 8; Willis'
// equation.
//
// The gearbox models apply the torques of sun and ring in the positive sense, and that of the
// carrier in the negative one. These torques load the same flanks for any input member. An input
// member rotates with its torque, an output member against it. The sun or the ring therefore drive
// in the positive sense, the carrier in the negative one. A train driven by the carrier is the
// mirror image of the real one, which turns in the positive sense on its other flanks. Reflection
// negates positions psi_n, speeds, torques and pressure angle, and leaves every deflection,
// frequency and phase unchanged.
#pragma once

#include "gears/planetary.hpp"

namespace gearpod::gears {

// Park's working conditions, by (fixed, input): 1 (sun, ring), 2 (sun, carrier), 3 (ring, sun), 4
// (ring, carrier), 5 (carrier, sun), 6 (carrier, ring).
struct PowerFlow {
    Member fixed = Member::ring;
    Member input = Member::sun;
};

// Member that is neither fixed nor the input.
Member output_member(const PowerFlow& flow);

// All speeds, signed as above, from the magnitude of one member's speed. Throws
// std::invalid_argument if that member is the fixed one.
Speeds signed_speeds(const PlanetaryTrain& train, const PowerFlow& flow, Member given,
                     double magnitude);

// One value for each central member.
struct CentralMembers {
    double carrier = 0;
    double ring = 0;
    double sun = 0;
};

// External torques in balance, T_s : T_r : T_c = Z_s : Z_r : -(Z_s + Z_r), from the magnitude of
// one of them. That of the fixed member is the reaction of its support.
CentralMembers balanced_torques(const PlanetaryTrain& train, Member given, double magnitude);

// Transmission error as weights of the members' rotations: the output's rotation minus the input's
// times their speed ratio (Park et al., Eq. 8). It is zero if the train turns as a rigid mechanism.
CentralMembers transmission_error_weights(const PlanetaryTrain& train, const PowerFlow& flow);

}  // namespace gearpod::gears
