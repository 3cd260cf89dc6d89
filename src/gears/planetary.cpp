#include "gears/planetary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::gears {

using std::numbers::pi;

namespace {

// Largest number of equally spaced planets whose tip circles stay apart.
int planets_with_room(const PlanetaryTrain& train, double addendum_coefficient) {
    const double ratio =
        (train.planet_teeth + 2 * addendum_coefficient) / (train.sun_teeth + train.planet_teeth);
    return ratio >= 1 ? 1 : static_cast<int>(std::ceil(pi / std::asin(ratio))) - 1;
}

// teeth * planet / planets without its whole part, computed on integers.
double reduced_phase(int teeth, int planet, int planets) {
    const long long remainder = static_cast<long long>(teeth) * planet % planets;
    return static_cast<double>(remainder) / planets;
}

double signed_phase(double phase, bool negative) {
    return negative && phase != 0 ? -phase : phase;
}

}  // namespace

std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           double addendum_coefficient) {
    std::vector<std::string> problems;
    const auto [s, p, r, n] = train;
    if (s < 1 || p < 1 || r < 1 || n < 1) {
        problems.push_back(fmt::format(
            "sun {}, planet {}, ring {} teeth and {} planets must be positive", s, p, r, n));
        return problems;
    }
    if (r != s + 2 * p)
        problems.push_back(
            fmt::format("the ring has {} teeth, sun + 2 planet is {} + 2 x {} = {} (the planets "
                        "fit between sun and ring only if they are equal)",
                        r, s, p, s + 2 * p));
    if ((s + r) % n != 0) {
        const int below = (s + r) / n * n;
        problems.push_back(
            fmt::format("(sun + ring) / planets = {} / {} is not an integer, so equally spaced "
                        "planets do not mesh (sun + ring = {} or {} would)",
                        s + r, n, below, below + n));
    }
    const double between_axes = (s + p) * std::sin(pi / n);
    const double tip_diameter = p + 2 * addendum_coefficient;
    if (n > 1 && between_axes <= tip_diameter)
        problems.push_back(fmt::format(
            "the tip circles of {} planets touch: axes {:.2f} modules apart, tip "
            "diameter {:.2f} modules (at most {} planets)",
            n, between_axes, tip_diameter, planets_with_room(train, addendum_coefficient)));
    return problems;
}

double sun_mesh_phase(const PlanetaryTrain& train, int planet, PlanetSense sense) {
    return signed_phase(reduced_phase(train.sun_teeth, planet, train.planets),
                        sense == PlanetSense::counter_clockwise);
}

double ring_mesh_phase(const PlanetaryTrain& train, int planet, PlanetSense sense) {
    return signed_phase(reduced_phase(train.ring_teeth, planet, train.planets),
                        sense == PlanetSense::clockwise);
}

double ring_to_sun_phase(const PlanetaryTrain& train) {
    // The sun pushes a planet tooth's trailing flank, the planet pushes the ring with its leading
    // flanks. On the pitch circle leading flanks lie half a pitch (one tooth thickness) ahead of
    // trailing ones, and the two pitch points lie half the circumference, Z_p / 2 pitches, apart.
    // With a trailing flank at the sun's pitch point the leading flanks miss the ring's by 1/2 -
    // Z_p / 2 pitches: nothing for odd Z_p, half a pitch for even Z_p.
    return train.planet_teeth % 2 == 0 ? 0.5 : 0.0;
}

Speeds train_speeds(const PlanetaryTrain& train, FixedMember fixed, Member given, double speed) {
    const double s = train.sun_teeth, p = train.planet_teeth, r = train.ring_teeth;
    const bool stands = (fixed == FixedMember::ring && given == Member::ring) ||
                        (fixed == FixedMember::sun && given == Member::sun) ||
                        (fixed == FixedMember::carrier && given == Member::carrier);
    if (stands)
        throw std::invalid_argument(
            "the speed of the fixed member is given (it is 0: give another one)");
    // Relative to the carrier sun and ring turn as -Z_r : Z_s. Take their speeds there for a unit
    // tooth speed.
    const double sun = 1 / s, ring = -1 / r, planet = -1 / p;
    const double carrier = fixed == FixedMember::ring  ? -ring
                           : fixed == FixedMember::sun ? -sun
                                                       : 0;
    const Speeds unit{sun + carrier, planet + carrier, ring + carrier, carrier};
    const double reference = given == Member::sun    ? unit.sun
                             : given == Member::ring ? unit.ring
                                                     : unit.carrier;
    const double scale = speed / reference;
    return {scale * unit.sun, scale * unit.planet, scale * unit.ring, scale * unit.carrier};
}

double mesh_frequency(const PlanetaryTrain& train, const Speeds& speeds) {
    return train.sun_teeth * std::abs(speeds.sun - speeds.carrier);
}

std::optional<int> meshes_per_carrier_turn(const PlanetaryTrain& train, FixedMember fixed) {
    switch (fixed) {
        case FixedMember::ring:
            return train.ring_teeth;
        case FixedMember::sun:
            return train.sun_teeth;
        case FixedMember::carrier:
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace gearpod::gears
