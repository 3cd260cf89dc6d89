// Planetary gear train: assembly, planet positions, mesh phases and speeds. Sources: Liang (2016),
// section 2.3 and Table 2.2, after Parker and Lin (2004); Park et al. (2016), Eqs. 1 and 5;
// Kahraman (1994) for the mesh frequency. Planets count from 0. Planet n is at psi_n, by default 2
// pi n / N, positive in the sense of positive rotations. Phases are in mesh periods.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gears/gear.hpp"
#include "machine/ids.hpp"

namespace gearpod::gears {

struct PlanetaryTrain {
    int sun_teeth = 0;
    int planet_teeth = 0;
    int ring_teeth = 0;
    int planets = 0;
    // psi_n, rad, ascending from psi_0 = 0; empty: equally spaced. A planet fits only at multiples
    // of 2 pi / (Z_s + Z_r); positions are rounded to the nearest multiple.
    std::vector<double> positions_rad = {};
};

// Exact planet positions: planet n is at step[n] of `steps` equal steps of a revolution.
struct PlanetPositions {
    std::vector<int> step;
    int steps = 1;
};
PlanetPositions planet_positions(const PlanetaryTrain& train);
// psi_n, rad.
double planet_angle(const PlanetPositions& positions, PlanetId planet);

// Sense of the planets' rotation relative to the carrier. It determines the order in which the
// planets reach a mesh phase.
enum class PlanetSense { clockwise, counter_clockwise };

// Valid positions nearest to equal spacing of the N planets, to be used as positions_rad if equal
// spacing is impossible. Ties go to the later position, so that an even number of planets stay
// opposite each other if possible.
std::vector<double> nearest_positions(const PlanetaryTrain& train);

// Distance between the planets' axes and the train's axis, and the planets' tip diameter, in
// modules.
struct PlanetDimensions {
    double centre_distance = 0, tip_diameter = 0;
};

// Reasons why the train cannot be assembled, one sentence each, with numbers and a remedy. Without
// `dimensions`, the teeth are standard ones of that addendum, and the ring must have Z_s + 2 Z_p
// teeth. With it, mesh_problems() checks whether the teeth mesh at that centre distance.
std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           double addendum_coefficient = 1);
std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           const PlanetDimensions& dimensions);

// Mesh phase gamma: pair n's stiffness is pair 0's at t - gamma T_m (Liang, Eqs. 2.3.3-2.3.4). It
// is reduced to (-1, 1) by whole mesh periods. The sign is that of the formula: +Z_s psi_n / 2 pi
// and -Z_r psi_n / 2 pi for clockwise planets, opposite for counter-clockwise.
double sun_mesh_phase(const PlanetaryTrain& train, PlanetId planet,
                      PlanetSense sense = PlanetSense::clockwise);
double ring_mesh_phase(const PlanetaryTrain& train, PlanetId planet,
                       PlanetSense sense = PlanetSense::clockwise);
// Mesh periods, 0 <= delay < teeth, from a sun or ring tooth's contact with planet 0 to the same
// tooth's contact with planet `planet`. The fractional part is the mesh phase.
double sun_tooth_delay(const PlanetaryTrain& train, PlanetId planet,
                       PlanetSense sense = PlanetSense::clockwise);
double ring_tooth_delay(const PlanetaryTrain& train, PlanetId planet,
                        PlanetSense sense = PlanetSense::clockwise);
// Delay of a planet's ring mesh relative to its sun mesh, from pitch point to pitch point: 0 or
// 1/2.
double ring_to_sun_phase(const PlanetaryTrain& train);
// Same for shifted teeth with these working pressure angles; 0 <= phase < 1.
double ring_to_sun_phase(const PlanetaryTrain& train, const Gear& planet, double sun_angle_rad,
                         double ring_angle_rad, PlanetSense sense);

// Angular speeds in the fixed frame, in any one unit; planet is the planet's absolute rotation.
struct Speeds {
    double sun = 0;
    double planet = 0;
    double ring = 0;
    double carrier = 0;
};

inline double speed_of(const Speeds& speeds, Member member) {
    return member == Member::sun    ? speeds.sun
           : member == Member::ring ? speeds.ring
                                    : speeds.carrier;
}

// Clockwise if the sun turns faster than the carrier, otherwise counter-clockwise.
PlanetSense planet_sense(const Speeds& speeds);

// All speeds from one of them (Willis). Throws std::invalid_argument if the given member is the
// fixed one.
Speeds train_speeds(const PlanetaryTrain& train, Member fixed, Member given, double speed);

// Meshes per unit of time (speeds in turns) or radians of mesh phase (speeds in radians): Z_s |W_s
// - W_c|, which equals Liang (2016), Eq. 2.3.9 for each fixed member.
double mesh_frequency(const PlanetaryTrain& train, const Speeds& speeds);

// Z_r with the ring fixed, Z_s with the sun fixed, nothing with the carrier fixed.
std::optional<int> meshes_per_carrier_turn(const PlanetaryTrain& train, Member fixed);

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
