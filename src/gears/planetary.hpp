// A planetary train: assembly, planet positions, mesh phases and speeds.
// Sources: Liang (2016), section 2.3 and Table 2.2, after Parker and Lin (2004); Park et al.
// (2016), Eqs. 1 and 5; Kahraman (1994) for the mesh frequency. Planets count from 0; planet n sits
// at psi_n, by default 2 pi n / N, counted in the sense in which positive rotations turn. Phases
// are in mesh periods.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gears/gear.hpp"

namespace gearpod::gears {

struct PlanetaryTrain {
    int sun_teeth = 0;
    int planet_teeth = 0;
    int ring_teeth = 0;
    int planets = 0;
    // psi_n, rad, ascending from psi_0 = 0; empty: equally spaced. A planet fits only at whole
    // multiples of 2 pi / (Z_s + Z_r); positions count as the multiple next to them.
    std::vector<double> positions_rad = {};
};

// Where the planets sit, exactly: planet n at place[n] / places of a turn.
struct PlanetPlaces {
    std::vector<int> place;
    int places = 1;
};
PlanetPlaces planet_places(const PlanetaryTrain& train);
// psi_n, rad.
double planet_angle(const PlanetPlaces& places, int planet);

enum class FixedMember { ring, sun, carrier };
enum class Member { sun, ring, carrier };
// Sense in which the planets turn relative to the carrier; it decides in which order the planets
// reach a mesh phase.
enum class PlanetSense { clockwise, counter_clockwise };

// The places next to equal spacing, N of them: positions_rad of a train whose planets cannot be
// spaced equally. Of two that are as near the later one, so that planets of even number stay
// opposite each other where they can.
std::vector<double> nearest_positions(const PlanetaryTrain& train);

// How far planets' axes lie from the train's, and their tip diameter, in modules.
struct PlanetRoom {
    double centre_distance = 0, tip_diameter = 0;
};

// What keeps the train from being assembled, one sentence each, with the numbers and what would be
// right. Without a room the teeth are standard ones of that addendum: the ring must have Z_s + 2
// Z_p. With one, whether they mesh at that centre distance is for mesh_problems() to say.
std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           double addendum_coefficient = 1);
std::vector<std::string> assembly_problems(const PlanetaryTrain& train, const PlanetRoom& room);

// Pair n's stiffness is pair 0's at t - gamma T_m (Liang, Eqs. 2.3.3-2.3.4). Reduced to (-1, 1) by
// whole mesh periods, sign as in the formula: +Z_s psi_n / 2 pi and -Z_r psi_n / 2 pi for clockwise
// planets, opposite for counter-clockwise.
double sun_mesh_phase(const PlanetaryTrain& train, int planet,
                      PlanetSense sense = PlanetSense::clockwise);
double ring_mesh_phase(const PlanetaryTrain& train, int planet,
                       PlanetSense sense = PlanetSense::clockwise);
// Mesh periods, 0 <= delay < teeth, from a sun or ring tooth's contact with planet 0 to the same
// tooth's contact with planet `planet`. Without its whole part it is the mesh phase.
double sun_tooth_delay(const PlanetaryTrain& train, int planet,
                       PlanetSense sense = PlanetSense::clockwise);
double ring_tooth_delay(const PlanetaryTrain& train, int planet,
                        PlanetSense sense = PlanetSense::clockwise);
// How much later than its sun mesh a planet's ring mesh is at its pitch point: 0 or 1/2.
double ring_to_sun_phase(const PlanetaryTrain& train);
// The same of shifted teeth, which work at these pressure angles; 0 <= phase < 1.
double ring_to_sun_phase(const PlanetaryTrain& train, const Gear& planet, double sun_angle_rad,
                         double ring_angle_rad, PlanetSense sense);

// Angular speeds in the fixed frame, in any one unit; planet is the planet's own absolute spin.
struct Speeds {
    double sun = 0;
    double planet = 0;
    double ring = 0;
    double carrier = 0;
};

// The sun overtakes the carrier and turns the planets clockwise, or falls behind it.
PlanetSense planet_sense(const Speeds& speeds);

// All speeds from one of them (Willis). Throws std::invalid_argument if the given member is the
// fixed one.
Speeds train_speeds(const PlanetaryTrain& train, FixedMember fixed, Member given, double speed);

// Meshes per unit of time (speeds in turns) or radians of mesh phase (speeds in radians): Z_s |W_s
// - W_c|, which is Liang (2016), Eq. 2.3.9 for each fixed member.
double mesh_frequency(const PlanetaryTrain& train, const Speeds& speeds);

// Z_r with the ring fixed, Z_s with the sun fixed, none if the carrier stands.
std::optional<int> meshes_per_carrier_turn(const PlanetaryTrain& train, FixedMember fixed);

}  // namespace gearpod::gears
