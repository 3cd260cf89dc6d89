#include "signals/path/transmission_path.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "machine/no_value.hpp"

namespace gearpod::signals {
namespace {

constexpr std::array kWindows{
    // 8 % of the signal of the farthest planet remains. Liang (2016), Eq. 4.3.1.
    PathWindow{"hamming", [](double x_rad) { return 0.54 - 0.46 * std::cos(x_rad); },
               "0.54 - 0.46 cos x, Liang (2016), Eq. 4.3.1"},
    // Nothing of the signal of the farthest planet remains. Liang (2016), section 4.3, case 3 of
    // Fig. 4.10.
    PathWindow{"hann", [](double x_rad) { return 0.5 - 0.5 * std::cos(x_rad); }, "0.5 - 0.5 cos x"},
    // Every planet counts the same at every angle, as for a sensor that turns with the carrier.
    PathWindow{"rectangular", [](double /*x_rad*/) { return 1.0; }, "1: no loss with distance"},
};

// Angles of a sensor per turn.
constexpr long kSensorAngles = 36'000;

long wrapped(long angle, long turn) {
    return (angle % turn + turn) % turn;
}

gears::PlanetPositions equally_spaced(int planets) {
    return gears::planet_positions({.planets = planets});
}

// Components along the axis of a sensor, plus this part of those at right angles to it.
std::pair<double, double> with_cross_axis(std::pair<double, double> along,
                                          std::pair<double, double> across, double part) {
    return part == 0.0
               ? along
               : std::pair(along.first + part * across.first, along.second + part * across.second);
}

}  // namespace

std::span<const PathWindow> path_windows() {
    return kWindows;
}

const PathWindow& path_window(std::string_view name) {
    std::string known;
    for (const PathWindow& window : kWindows) {
        if (window.name == name) {
            return window;
        }
        known += fmt::format("{}{}", known.empty() ? "" : ", ", window.name);
    }
    throw std::invalid_argument(fmt::format("no path window \"{}\"; there are {}", name, known));
}

PathGrid::PathGrid(const PathWindow& window, int planets, int phases, const SpanLayout& layout)
    : PathGrid(window, equally_spaced(planets), phases, layout) {}

PathGrid::PathGrid(const gears::PlanetPositions& planets, int phases, const SpanLayout& layout)
    : planets_(static_cast<int>(planets.step.size())),
      phases_(phases),
      positions_(layout.carrier_meshes) {
    if (planets_ < 1 || phases < 1 || positions_ < 1) {
        throw std::invalid_argument(
            "path grid: planets, phases and meshes per carrier turn must be positive");
    }
}

PathGrid::PathGrid(const PathWindow& window, const gears::PlanetPositions& planets, int phases,
                   const SpanLayout& layout, CarrierSense sense, const SensorPosition& sensor)
    : PathGrid(planets, phases, layout) {
    const Turn turn = turn_of(planets, sense, sensor);
    // Planets a whole number of samples apart share their angles and window values.
    std::vector<double> known(static_cast<std::size_t>(turn.steps / turn.planet_steps), kNan);
    const auto weight = [&](int, long planet) {
        const double angle = turn.step_rad * static_cast<double>(planet);
        if (planet % turn.planet_steps != 0) {
            return sensor.gain * window.weight(angle);
        }
        double& value = known[static_cast<std::size_t>(planet / turn.planet_steps)];
        if (std::isnan(value)) {
            value = window.weight(angle);
        }
        return sensor.gain * value;
    };
    tabulate(planets, sense, turn, weight, [&](double angle) {
        const double sine = sense == CarrierSense::negative ? -std::sin(angle) : std::sin(angle),
                     cosine = std::cos(angle);
        const std::pair radial(sine, cosine), tangential(cosine, -sine);
        return sensor.tangential ? with_cross_axis(tangential, radial, sensor.cross_axis)
                                 : with_cross_axis(radial, tangential, sensor.cross_axis);
    });
}

PathGrid::PathGrid(const RingLoad& load, const gears::PlanetPositions& planets, int phases,
                   const SpanLayout& layout, CarrierSense sense, const SensorPosition& sensor)
    : PathGrid(planets, phases, layout) {
    const Turn turn = turn_of(planets, sense, sensor);
    const bool along_x = load.axis == RingLoad::Axis::x;
    const int n = load.nodal_diameters;
    const double share = n > 0 ? 1.0 / n : 0.0;
    const auto weight = [&](PlanetId planet, long position) {
        const double mirrored = turn.step_rad * static_cast<double>(position) - std::numbers::pi;
        const double angle = n * (sense == CarrierSense::negative ? -mirrored : mirrored);
        const double sine = std::sin(angle), cosine = std::cos(angle);
        // Weights of radial and tangential load at a radial and at a tangential sensor.
        const std::pair at_radial(cosine, -share * sine),
            at_tangential(share * sine, share * share * cosine);
        const auto [radial, tangential] =
            sensor.tangential ? with_cross_axis(at_tangential, at_radial, sensor.cross_axis)
                              : with_cross_axis(at_radial, at_tangential, sensor.cross_axis);
        const double psi = gears::planet_angle(planets, planet);
        return sensor.gain * (along_x ? radial * std::cos(psi) - tangential * std::sin(psi)
                                      : radial * std::sin(psi) + tangential * std::cos(psi));
    };
    tabulate(planets, sense, turn, weight,
             [&](double) { return along_x ? std::pair(1.0, 0.0) : std::pair(0.0, 1.0); });
}

PathGrid::PathGrid(const BearingSource& bearing, int phases, const SpanLayout& layout,
                   CarrierSense sense, const SensorPosition& sensor)
    : PathGrid(path_window("rectangular"), equally_spaced(1), phases, layout, sense, sensor) {
    first_source_ = bearing.source;
}

PathGrid::Turn PathGrid::turn_of(const gears::PlanetPositions& planets, CarrierSense sense,
                                 const SensorPosition& sensor) const {
    // Carrier, planet and sensor angles are whole steps of a turn, so that the wrap is exact.
    const long parts = sensor.angle_deg == 0.0 ? 1 : kSensorAngles;
    const long sensor_part = std::lround(sensor.angle_deg / 360.0 * kSensorAngles) *
                             (sense == CarrierSense::negative ? -1 : 1);
    Turn turn;
    turn.parts = parts;
    turn.planet_steps = planets.steps * parts;
    turn.steps = turn.planet_steps * phases_ * positions_;
    turn.step_rad = 2.0 * std::numbers::pi / static_cast<double>(turn.steps);
    turn.sensor = wrapped(turn.steps / kSensorAngles * sensor_part, turn.steps);
    return turn;
}

template <class Weight, class Direction>
void PathGrid::tabulate(const gears::PlanetPositions& planets, CarrierSense sense, const Turn& turn,
                        Weight weight, Direction direction) {
    const long planet_steps = turn.planet_steps, mesh = planet_steps * phases_;
    const auto position = [&](int n) {
        const long step = planets.step[static_cast<std::size_t>(n)] * turn.parts;
        const bool mirrored = sense == CarrierSense::negative;
        const long angle =
            turn.steps / planet_steps * (mirrored ? (planet_steps - step) % planet_steps : step);
        return wrapped(angle - turn.sensor, turn.steps);
    };
    const bool turns = positions_ > 1;
    for (int p = 0; p < phases_; ++p) {
        for (int c = 0; c < positions_; ++c) {
            const long carrier = turns ? (static_cast<long>(c) * phases_ + p) * planet_steps : 0;
            const auto [sine, cosine] = direction(
                turn.step_rad * static_cast<double>(wrapped(carrier - turn.sensor, turn.steps)));
            sine_.push_back(sine);
            cosine_.push_back(cosine);
            for (PlanetId n{0}; n < planets_; ++n) {
                window_.push_back(weight(n, (carrier + position(n)) % turn.steps));
            }
        }
        for (int n = 0; n < planets_; ++n) {
            const long at_zero =
                ((turns ? static_cast<long>(p) * planet_steps : 0) + position(n)) % turn.steps;
            const long half = positions_ / 2;
            const double odd = positions_ % 2 == 1 ? 0.5 : 0.0;
            fraction_.push_back(static_cast<double>(at_zero % mesh) / static_cast<double>(mesh) -
                                odd);
            const long centre = half - at_zero / mesh;
            centre_.push_back(static_cast<int>((centre + positions_) % positions_));
        }
    }
}

}  // namespace gearpod::signals
