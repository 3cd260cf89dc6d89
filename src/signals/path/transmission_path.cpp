#include "signals/path/transmission_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Angles of a sensor per turn.
constexpr long kSensorAngles = 36'000;

long wrapped(long angle, long turn) {
    return (angle % turn + turn) % turn;
}

gears::PlanetPlaces equally_spaced(int planets) {
    return gears::planet_places({.planets = planets});
}

}  // namespace

PathGrid::PathGrid(const PathWindow& window, int planets, int phases, const SpanLayout& layout)
    : PathGrid(window, equally_spaced(planets), phases, layout) {}

PathGrid::PathGrid(const PathWindow& window, const gears::PlanetPlaces& planets, int phases,
                   const SpanLayout& layout, CarrierSense sense, const SensorPlace& sensor)
    : planets_(static_cast<int>(planets.place.size())),
      phases_(phases),
      positions_(layout.carrier_meshes) {
    if (planets_ < 1 || phases < 1 || positions_ < 1) {
        throw std::invalid_argument(
            "path grid: planets, phases and meshes per carrier turn must be positive");
    }
    // Carrier, planet and sensor angles are whole steps of a turn, so that the wrap is exact.
    const bool mirrored = sense == CarrierSense::negative;
    const long parts = sensor.angle_deg == 0.0 ? 1 : kSensorAngles;
    const long sensor_part =
        std::lround(sensor.angle_deg / 360.0 * kSensorAngles) * (mirrored ? -1 : 1);
    const long places = planets.places * parts;
    const long mesh = places * phases_;
    const long turn = mesh * positions_;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(turn);
    const bool turns = positions_ > 1;
    const long sensor_angle = wrapped(turn / kSensorAngles * sensor_part, turn);
    const auto position = [&](int n) {
        const long place = planets.place[static_cast<std::size_t>(n)] * parts;
        const long angle = turn / places * (mirrored ? (places - place) % places : place);
        return wrapped(angle - sensor_angle, turn);
    };
    // Planets a whole number of samples apart share their angles and window values.
    std::vector<double> known(static_cast<std::size_t>(turn / places), kUnknown);
    const auto weight = [&](long planet) {
        const double angle = step * static_cast<double>(planet);
        if (planet % places != 0) {
            return window.weight(angle);
        }
        double& value = known[static_cast<std::size_t>(planet / places)];
        if (std::isnan(value)) {
            value = window.weight(angle);
        }
        return value;
    };
    for (int p = 0; p < phases_; ++p) {
        for (int c = 0; c < positions_; ++c) {
            const long carrier = turns ? (static_cast<long>(c) * phases_ + p) * places : 0;
            const double angle = step * static_cast<double>(wrapped(carrier - sensor_angle, turn));
            const double sine = mirrored ? -std::sin(angle) : std::sin(angle),
                         cosine = std::cos(angle);
            sine_.push_back(sensor.tangential ? cosine : sine);
            cosine_.push_back(sensor.tangential ? -sine : cosine);
            for (int n = 0; n < planets_; ++n) {
                const long planet = (carrier + position(n)) % turn;
                window_.push_back(sensor.gain * weight(planet));
            }
        }
        for (int n = 0; n < planets_; ++n) {
            const long at_zero = ((turns ? static_cast<long>(p) * places : 0) + position(n)) % turn;
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
