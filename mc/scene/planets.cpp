#include "mc/scene/planets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace gearpod::mc {
namespace {

double angle_of(const Gearbox& gearbox, std::size_t planet) {
    return gearbox.planet_positions_rad.empty()
               ? 2.0 * std::numbers::pi * static_cast<double>(planet) / gearbox.planets
               : gearbox.planet_positions_rad[planet];
}

void move_pin(double angle, double tangential_m, double radial_m,
              dynamics::PlanetDeviations& planet) {
    const double c = std::cos(angle), s = std::sin(angle);
    planet.pin_x_m += radial_m * c - tangential_m * s;
    planet.pin_y_m += radial_m * s + tangential_m * c;
}

double of_planet(const std::vector<double>& list, std::size_t planet, double otherwise) {
    return planet < list.size() ? list[planet] : otherwise;
}

}  // namespace

Planets given_planets(const Study& study) {
    const PlanetDifferences& given = study.planets;
    Planets planets;
    for (std::size_t n = 0; n < planets.size(); ++n) {
        planets[n] = {of_planet(given.bearing_stiffness, n, 1.0),
                      of_planet(given.bearing_damping, n, 1.0), of_planet(given.mass, n, 1.0), 0.0,
                      0.0};
        if (!given.pin_tangential_m.empty() || !given.pin_radial_m.empty()) {
            move_pin(angle_of(study.gearbox, n), of_planet(given.pin_tangential_m, n, 0.0),
                     of_planet(given.pin_radial_m, n, 0.0), planets[n]);
        }
    }
    return planets;
}

void add_random_planets(const InputValues& values, std::function<double()> normal,
                        std::function<double()> normal_of_pins, Planets& planets) {
    const Study& study = values.study();
    const PlanetDifferences& drawn = study.planets;
    const double tangential_m = values.of(drawn.pin_tangential_rms_m),
                 radial_m = values.of(drawn.pin_radial_rms_m),
                 stiffness = values.of(drawn.bearing_stiffness_scatter),
                 damping = values.of(drawn.bearing_damping_scatter),
                 mass = values.of(drawn.mass_scatter);
    for (std::size_t n = 0; n < static_cast<std::size_t>(study.gearbox.planets); ++n) {
        std::array<double, 5> own{}, of_pins{};
        std::ranges::generate(own, std::ref(normal));
        std::ranges::generate(of_pins, std::ref(normal_of_pins));
        move_pin(angle_of(study.gearbox, n), tangential_m * of_pins[0], radial_m * of_pins[1],
                 planets[n]);
        planets[n].bearing_stiffness *= std::exp(stiffness * own[2]);
        planets[n].bearing_damping *= std::exp(damping * own[3]);
        planets[n].mass *= std::exp(mass * own[4]);
    }
}

}  // namespace gearpod::mc
