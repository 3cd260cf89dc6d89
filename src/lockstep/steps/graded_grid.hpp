// Phase grids with steps adapted to the response: short after a contact transition, where it
// vibrates, and long where it follows the stiffness smoothly. They have few distinct lengths,
// because integrators store coefficients for each (PhaseGrid::lengths).
#pragma once

#include <span>

#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Step lengths in mesh periods. At a distance `phase` after the latest transition, a step is at
// most max(first, growth * phase), and never more than `longest`.
struct Grading {
    double first = 0.0;
    double growth = 0.0;
    double longest = 0.0;
};

// Longest step allowed at the distance `since` after the latest transition.
double longest_step(const Grading& grading, double since);

// Grid with steps of `first` times a power of two from each transition to the next. The last one
// before a transition, or before the end of the mesh period, has the remaining length. Samples may
// lie inside steps. Throws std::invalid_argument if samples < 1 or the grading is not positive.
PhaseGrid make_graded_grid(int samples, std::span<const double> transitions,
                           const Grading& grading);

// Phase since the latest transition; infinite without transitions.
double since_transition(std::span<const double> transitions, double phase);

}  // namespace gearpod::lockstep
