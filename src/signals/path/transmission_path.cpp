#include "signals/path/transmission_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

gears::PlanetPlaces equally_spaced(int planets) {
    return gears::planet_places({.planets = planets});
}

}  // namespace

PathGrid::PathGrid(const PathWindow& window, int planets, int phases, const SpanLayout& layout)
    : PathGrid(window, equally_spaced(planets), phases, layout) {}

PathGrid::PathGrid(const PathWindow& window, const gears::PlanetPlaces& planets, int phases,
                   const SpanLayout& layout, CarrierSense sense)
    : planets_(static_cast<int>(planets.place.size())),
      phases_(phases),
      positions_(layout.carrier_meshes) {
    if (planets_ < 1 || phases < 1 || positions_ < 1) {
        throw std::invalid_argument(
            "path grid: planets, phases and meshes per carrier turn must be positive");
    }
    // Carrier and planet angles are whole steps of a turn, so that the wrap is exact.
    const long places = planets.places;
    const long mesh = places * phases_;
    const long turn = mesh * positions_;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(turn);
    const bool turns = positions_ > 1;
    const bool mirrored = sense == CarrierSense::negative;
    const auto position = [&](int n) {
        const long place = planets.place[static_cast<std::size_t>(n)];
        return turn / places * (mirrored ? (places - place) % places : place);
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
            const double sine = std::sin(step * static_cast<double>(carrier));
            sine_.push_back(mirrored ? -sine : sine);
            cosine_.push_back(std::cos(step * static_cast<double>(carrier)));
            for (int n = 0; n < planets_; ++n) {
                const long planet = (carrier + position(n)) % turn;
                window_.push_back(weight(planet));
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
