// Differences between the planets of one gearbox.
#pragma once

#include <array>
#include <functional>

#include "dynamics/planetary.hpp"
#include "mc/scene/input_values.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

using Planets = std::array<dynamics::PlanetDeviations, dynamics::kMaxPlanets>;

// Planets as given in the study; identical if nothing is given.
Planets given_planets(const Study& study);

// Adds the random deviations. Uses five standard normal variates per planet from both sources,
// whatever the study contains; positions of pins follow from `normal_of_pins`.
void add_random_planets(const InputValues& values, std::function<double()> normal,
                        std::function<double()> normal_of_pins, Planets& planets);

}  // namespace gearpod::mc
