// Phase grids whose steps follow the response: fine after a contact transition, where it rings, and
// coarse where it follows the stiffness quietly. Few distinct lengths, since integrators keep
// coefficients for each (PhaseGrid::lengths).
#pragma once

#include <functional>
#include <span>

#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Lengths in mesh periods. `phase` past the latest transition a step is at most
// max(first, growth * phase), and never more than `longest`.
struct Grading {
    double first = 0.0;
    double growth = 0.0;
    double longest = 0.0;
};

// The longest step allowed `since` the latest transition.
double longest_step(const Grading& grading, double since);

// Steps of `first` times a power of two from each transition to the next; the last one before a
// transition, or before the end of the mesh period, has the length that is left. Samples may lie
// inside steps. Throws std::invalid_argument for samples < 1 or a grading that is not positive.
PhaseGrid make_graded_grid(int samples, std::span<const double> transitions,
                           const Grading& grading);

// A node on every sample and transition; between two of them equal steps, so many that none is
// longer than longest_step(start, end) there, in numbers 1, 2, 3, 4, 6, 8, 12, ... . Throws
// std::invalid_argument for samples < 1 or a longest step that is not positive.
PhaseGrid make_divided_grid(int samples, std::span<const double> transitions,
                            const std::function<double(double, double)>& longest_step);

// The phase since the latest transition; without any, infinite.
double since_transition(std::span<const double> transitions, double phase);

}  // namespace gearpod::lockstep
