#include "gears/planetary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gearpod::gears {

using std::numbers::pi;

namespace {

constexpr int kUnlimited = std::numeric_limits<int>::max();

// Largest number of equally spaced planets whose tip circles do not touch.
int max_planets(const PlanetDimensions& dimensions) {
    const double ratio = dimensions.tip_diameter / (2 * dimensions.centre_distance);
    if (ratio >= 1) {
        return 1;
    }
    const double most = std::ceil(pi / std::asin(ratio)) - 1;
    // Almost no tooth tips, or none: practically unlimited.
    return ratio > 0 && most < kUnlimited ? static_cast<int>(most) : kUnlimited;
}

// Reports more planets than can fit at any positions as one problem, instead of one for every pair
// that touches.
bool report_too_many(const PlanetaryTrain& train, const PlanetDimensions& dimensions,
                     std::vector<std::string>& problems) {
    const int most = max_planets(dimensions), n = train.planets;
    if (n <= most) {
        return false;
    }
    problems.push_back(fmt::format(
        "the tip circles of {} planets touch: axes {:.2f} modules apart, tip diameter "
        "{:.2f} modules (at most {} planets)",
        n, 2 * dimensions.centre_distance * std::sin(pi / n), dimensions.tip_diameter, most));
    return true;
}

PlanetDimensions standard_dimensions(const PlanetaryTrain& train, double addendum_coefficient) {
    return {0.5 * (train.sun_teeth + train.planet_teeth),
            train.planet_teeth + 2 * addendum_coefficient};
}

// Fractional part of teeth * step / steps, computed with integers.
double reduced_phase(int teeth, PlanetId planet, const PlanetPositions& planets) {
    const int step = planets.step.at(planet);
    const long long remainder = static_cast<long long>(teeth) * step % planets.steps;
    return static_cast<double>(remainder) / planets.steps;
}

// Mesh periods of a gear from planet 0 to the given planet, in the forward direction if `forward`,
// otherwise backward.
double tooth_delay(int teeth, PlanetId planet, const PlanetPositions& planets, bool forward) {
    const int step = planets.step.at(planet);
    const int passed = forward ? step : (planets.steps - step) % planets.steps;
    return static_cast<double>(static_cast<long long>(teeth) * passed) / planets.steps;
}

double signed_phase(double phase, bool negative) {
    return negative && phase != 0 ? -phase : phase;
}

void equal_spacing_problems(const PlanetaryTrain& train, const PlanetDimensions& dimensions,
                            std::vector<std::string>& problems) {
    const int teeth = train.sun_teeth + train.ring_teeth, n = train.planets;
    if (teeth % n != 0) {
        const int below = teeth / n * n;
        problems.push_back(
            fmt::format("(sun + ring) / planets = {} / {} is not an integer, so equally spaced "
                        "planets do not mesh (sun + ring = {} or {} would)",
                        teeth, n, below, below + n));
    }
    report_too_many(train, dimensions, problems);
}

double degrees(double angle_rad) {
    return angle_rad * 180 / pi;
}

// Largest deviation of a position from a valid step that counts as rounding, relative to the
// spacing of steps.
constexpr double kStepTolerance = 0.01;

void position_problems(const PlanetaryTrain& train, const PlanetDimensions& dimensions,
                       std::vector<std::string>& problems) {
    const auto& psi = train.positions_rad;
    if (static_cast<int>(psi.size()) != train.planets) {
        problems.push_back(fmt::format("{} planet positions are given for {} planets (one each)",
                                       psi.size(), train.planets));
        return;
    }
    if (psi[0] != 0) {
        problems.push_back(fmt::format(
            "planet 1 is at {:.4g} degrees (positions are counted from it: 0)", degrees(psi[0])));
    }
    for (std::size_t n = 1; n < psi.size(); ++n)
        if (!(psi[n] > psi[n - 1] && psi[n] < 2 * pi)) {
            problems.push_back(
                fmt::format("planet {} at {:.4g} degrees does not follow planet {} at {:.4g} "
                            "degrees (positions "
                            "ascend from 0 and stay below 360)",
                            n + 1, degrees(psi[n]), n, degrees(psi[n - 1])));
        }
    const int steps = train.sun_teeth + train.ring_teeth;
    for (std::size_t n = 0; n < psi.size(); ++n) {
        const double step = psi[n] * steps / (2 * pi);
        if (!(std::abs(step - std::round(step)) <= kStepTolerance)) {
            problems.push_back(fmt::format(
                "planet {} does not mesh at {:.6g} degrees, (sun + ring) x position / 360 = {:.4f} "
                "is not an integer ({:.6f} or {:.6f} degrees would do)",
                n + 1, degrees(psi[n]), step, std::floor(step) * 360 / steps,
                std::ceil(step) * 360 / steps));
        }
    }
    if (report_too_many(train, dimensions, problems)) {
        return;
    }
    const PlanetPositions planets = planet_positions(train);
    for (PlanetId n{0}; n < train.planets; ++n)
        for (PlanetId m{0}; m < n; ++m) {
            const double apart = planet_angle(planets, n) - planet_angle(planets, m);
            const double between_axes =
                2 * dimensions.centre_distance * std::abs(std::sin(apart / 2));
            if (between_axes <= dimensions.tip_diameter) {
                problems.push_back(fmt::format(
                    "the tip circles of planets {} and {} touch: axes {:.2f} modules apart, tip "
                    "diameter {:.2f} modules (move them apart)",
                    m + 1, n + 1, between_axes, dimensions.tip_diameter));
            }
        }
}

double& value_of(CentralMembers& members, Member member) {
    return member == Member::sun    ? members.sun
           : member == Member::ring ? members.ring
                                    : members.carrier;
}

}  // namespace

PlanetPositions planet_positions(const PlanetaryTrain& train) {
    PlanetPositions planets;
    if (train.positions_rad.empty()) {
        planets.steps = train.planets;
        for (int n = 0; n < train.planets; ++n) {
            planets.step.push_back(n);
        }
        return planets;
    }
    planets.steps = train.sun_teeth + train.ring_teeth;
    for (const double psi : train.positions_rad) {
        const auto step = std::llround(psi * planets.steps / (2 * pi)) % planets.steps;
        planets.step.push_back(static_cast<int>((step + planets.steps) % planets.steps));
    }
    return planets;
}

double planet_angle(const PlanetPositions& positions, PlanetId planet) {
    return 2 * pi * positions.step.at(planet) / positions.steps;
}

std::vector<double> nearest_positions(const PlanetaryTrain& train) {
    const int steps = train.sun_teeth + train.ring_teeth, n = train.planets;
    std::vector<double> positions;
    for (PlanetId planet{0}; planet < n; ++planet) {
        const int step = (2 * planet * steps + n) / (2 * n);  // rounded, halves up
        positions.push_back(2 * pi * step / steps);
    }
    return positions;
}

std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           double addendum_coefficient) {
    const int s = train.sun_teeth, p = train.planet_teeth, r = train.ring_teeth;
    auto problems = assembly_problems(train, standard_dimensions(train, addendum_coefficient));
    if (s >= 1 && p >= 1 && r >= 1 && train.planets >= 1 && r != s + 2 * p) {
        problems.insert(
            problems.begin(),
            fmt::format("the ring has {} teeth, sun + 2 planet is {} + 2 x {} = {} (the planets "
                        "fit between sun and ring only if they are equal, or with profile shift)",
                        r, s, p, s + 2 * p));
    }
    return problems;
}

std::vector<std::string> assembly_problems(const PlanetaryTrain& train,
                                           const PlanetDimensions& dimensions) {
    std::vector<std::string> problems;
    const int s = train.sun_teeth, p = train.planet_teeth, r = train.ring_teeth, n = train.planets;
    if (s < 1 || p < 1 || r < 1 || n < 1) {
        problems.push_back(fmt::format(
            "sun {}, planet {}, ring {} teeth and {} planets must be positive", s, p, r, n));
        return problems;
    }
    if (train.positions_rad.empty()) {
        equal_spacing_problems(train, dimensions, problems);
    } else {
        position_problems(train, dimensions, problems);
    }
    return problems;
}

double sun_mesh_phase(const PlanetaryTrain& train, PlanetId planet, PlanetSense sense) {
    return signed_phase(reduced_phase(train.sun_teeth, planet, planet_positions(train)),
                        sense == PlanetSense::counter_clockwise);
}

double ring_mesh_phase(const PlanetaryTrain& train, PlanetId planet, PlanetSense sense) {
    return signed_phase(reduced_phase(train.ring_teeth, planet, planet_positions(train)),
                        sense == PlanetSense::clockwise);
}

double sun_tooth_delay(const PlanetaryTrain& train, PlanetId planet, PlanetSense sense) {
    return tooth_delay(train.sun_teeth, planet, planet_positions(train),
                       sense == PlanetSense::clockwise);
}

double ring_tooth_delay(const PlanetaryTrain& train, PlanetId planet, PlanetSense sense) {
    return tooth_delay(train.ring_teeth, planet, planet_positions(train),
                       sense == PlanetSense::counter_clockwise);
}

double ring_to_sun_phase(const PlanetaryTrain& train) {
    // The sun pushes a planet tooth's trailing flank, and the planet pushes the ring with its
    // leading flanks. On the pitch circle, leading flanks are half a pitch (one tooth thickness)
    // ahead of trailing ones. The two pitch points are half the circumference, Z_p / 2 pitches,
    // apart. With a trailing flank at the sun's pitch point, the leading flanks are 1/2 - Z_p / 2
    // pitches from the ring's. That is a whole number of pitches for odd Z_p, and half a pitch off
    // for even Z_p.
    return train.planet_teeth % 2 == 0 ? 0.5 : 0.0;
}

// The sun touches a tooth's trailing flank on the line between the axes when the tooth's middle is
// half its thickness past that line. The ring touches the leading flank when the middle is half its
// thickness before it. The thicknesses are those on the working circles of the sun and ring meshes.
// Standard teeth are half a pitch thick on both.
double ring_to_sun_phase(const PlanetaryTrain& train, const Gear& planet, double sun_angle_rad,
                         double ring_angle_rad, PlanetSense sense) {
    const double a = planet.pressure_angle_rad;
    const double thicker = (4 * planet.profile_shift * std::tan(a) +
                            planet.teeth * ((involute(a) - involute(sun_angle_rad)) +
                                            (involute(a) - involute(ring_angle_rad)))) /
                           (2 * pi);
    const double later = sense == PlanetSense::clockwise ? -thicker : thicker;
    const double phase = ring_to_sun_phase(train) + later;
    return phase - std::floor(phase);
}

PlanetSense planet_sense(const Speeds& speeds) {
    return speeds.sun > speeds.carrier ? PlanetSense::clockwise : PlanetSense::counter_clockwise;
}

Speeds train_speeds(const PlanetaryTrain& train, Member fixed, Member given, double speed) {
    const double s = train.sun_teeth, p = train.planet_teeth, r = train.ring_teeth;
    if (given == fixed) {
        throw std::invalid_argument(
            "the speed of the fixed member is given (it is 0: give another one)");
    }
    // Relative to the carrier, sun and ring rotate as -Z_r : Z_s. These are their speeds for a unit
    // tooth speed.
    const double sun = 1 / s, ring = -1 / r, planet = -1 / p;
    const double carrier = fixed == Member::ring ? -ring : fixed == Member::sun ? -sun : 0;
    const Speeds unit{sun + carrier, planet + carrier, ring + carrier, carrier};
    const double scale = speed / speed_of(unit, given);
    return {scale * unit.sun, scale * unit.planet, scale * unit.ring, scale * unit.carrier};
}

double mesh_frequency(const PlanetaryTrain& train, const Speeds& speeds) {
    return train.sun_teeth * std::abs(speeds.sun - speeds.carrier);
}

std::optional<int> meshes_per_carrier_turn(const PlanetaryTrain& train, Member fixed) {
    return fixed == Member::ring  ? std::optional(train.ring_teeth)
           : fixed == Member::sun ? std::optional(train.sun_teeth)
                                  : std::nullopt;
}

Member output_member(const PowerFlow& flow) {
    for (const Member member : {Member::sun, Member::ring})
        if (member != flow.input && member != flow.fixed)
            return member;
    return Member::carrier;
}

Speeds signed_speeds(const PlanetaryTrain& train, const PowerFlow& flow, Member given,
                     double magnitude) {
    const Speeds s = train_speeds(train, flow.fixed, given, magnitude);
    const bool with_torque = (speed_of(s, flow.input) >= 0) == (flow.input != Member::carrier);
    return with_torque ? s : Speeds{-s.sun, -s.planet, -s.ring, -s.carrier};
}

CentralMembers balanced_torques(const PlanetaryTrain& train, Member given, double magnitude) {
    const double s = train.sun_teeth, r = train.ring_teeth;
    CentralMembers torques{-(s + r), r, s};
    const double per_tooth = magnitude / std::abs(value_of(torques, given));
    return {per_tooth * torques.carrier, per_tooth * torques.ring, per_tooth * torques.sun};
}

CentralMembers transmission_error_weights(const PlanetaryTrain& train, const PowerFlow& flow) {
    const Speeds s = train_speeds(train, flow.fixed, flow.input, 1);
    const Member output = output_member(flow);
    CentralMembers weights;
    value_of(weights, output) = 1;
    value_of(weights, flow.input) = -speed_of(s, output);
    return weights;
}

}  // namespace gearpod::gears
