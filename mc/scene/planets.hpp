// How the planets of one gearbox differ.
#pragma once

#include <array>
#include <functional>

#include "dynamics/planetary.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// See dynamics::PlanetOwn.
struct PlanetInstance {
    double bearing_stiffness, bearing_damping, mass;
    double pin_x_m, pin_y_m;
};
using Planets = std::array<PlanetInstance, dynamics::kMaxPlanets>;

// As the study gives them; all alike without.
Planets given_planets(const Study& study);

// Adds what is drawn: five standard normal numbers a planet, whatever the study asks for. The
// study's scatters are those of this gearbox.
void draw_planets(const Study& study, std::function<double()> normal, Planets& planets);

}  // namespace gearpod::mc
