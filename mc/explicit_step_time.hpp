// What a step of the classical Runge-Kutta method costs, also where nobody would march by it.
#pragma once

#include "mc/scene.hpp"

namespace gearpod::mc {

// Processor seconds of one thread, gearbox and step in a full tile: the least of some marches of a
// mesh period from rest, in which the motion may well grow without bound; that costs the same.
double explicit_step_s(const Scene& scene);

}  // namespace gearpod::mc
