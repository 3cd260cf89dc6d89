// Coefficients of one step of the sensor's low-pass filter, by the method that integrates the
// motion, for the kernels (sensor_filter.hpp).
#pragma once

#include <span>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/integrator.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// Coefficients [kFilterCoefficients] of a step of `h` seconds for the cutoff `w` rad/s.
void filter_step(Integrator integrator, double w, double h,
                 double (&coefficients)[kFilterCoefficients]);

// Coefficients of a tile whose lanes have the given mesh periods (s), for steps of the given
// lengths (mesh periods): [step kind][kFilterCoefficients][lane].
machine::AlignedVector filter_coefficients(Integrator integrator, double w,
                                           std::span<const double> lengths,
                                           std::span<const double> mesh_periods);

}  // namespace gearpod::lockstep
